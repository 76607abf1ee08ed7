// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include <cambium/io/npy.hpp>

#include "checkpoint.hpp"
#include "files.hpp"
#include "interface_pressure.hpp"
#include "options.hpp"
#include "series.hpp"
#include "vtk_files.hpp"

namespace tumour {

/// What a run leaves in its folder: series.csv row by row, interfaces and fields at some times, report.json.
template <class T>
class Record {
 public:
  static constexpr int dimension = T::dimension;

  /// \param saved  what the run goes on from, or null
  Record(const Options& options, const std::string& configuration, const Checkpoint* saved)
      : folder_(options.out), configuration_(configuration) {
    std::filesystem::create_directories(folder_ / "pictures");
    write_whole(folder_ / "options.ini", configuration);
    if (saved) {
      series_ = saved->series;
      report_ = nlohmann::json::parse(saved->report);
      return;
    }
    report_["options"] = configuration;
    report_["dim"] = dimension;
    report_["box"] = options.box;
    report_["cells"] = options.cells;
    report_["scene"] = options.scene;
    report_["frames"] = nlohmann::json::array();
    series_ =
        "step,t,dt,bound,iterations,volume,area,least_curvature,greatest_curvature,inside_components,"
        "interface_components,necrotic_volume,gain,expected_volume,imbalance,unresolved\n";
  }

  void add(const Row<dimension>& row, int step) {
    const auto& m = row.measures;
    char line[512];
    std::snprintf(line, sizeof line, "%d,%.12g,%.6g,%s,%d,%.12g,%.12g,%.9g,%.9g,%zu,%zu,%.9g,%.9g,%.12g,%.3e,%zu\n",
                  step, row.time, row.step.dt, cambium::name(row.step.bound), row.step.iterations, m.volume, m.area,
                  m.least_curvature, m.greatest_curvature, m.inside_components, m.interface_components,
                  row.budget.necrotic, row.budget.gain, row.expected, row.imbalance(), row.step.unresolved);
    series_ += line;
  }
  /// Interface and fields as they are, named after the time.
  void picture(const T& tumour, const Row<dimension>& row) {
    const std::string name = label(tumour.time());
    const auto surface = cambium::extract_surface(tumour.level_set().band());
    const std::vector<Named> data{{"pressure", pressure_on(tumour, surface)}, {"curvature", surface.curvatures}};
    if constexpr (dimension == 2) {
      write_curves(folder_ / ("interface_t" + name + ".csv"), surface, data);
    } else {
      write_surface(folder_ / ("interface_t" + name + ".vtp"), surface, data);
      write_drawing(name, surface, data[0].values);
    }
    write_nodes(tumour, name);
    report_["frames"].push_back({{"t", tumour.time()},
                                 {"name", name},
                                 {"volume", row.measures.volume},
                                 {"area", row.measures.area},
                                 {"parts", row.measures.inside_components},
                                 {"interfaces", row.measures.interface_components},
                                 {"necrotic_volume", row.budget.necrotic},
                                 {"imbalance", row.imbalance()}});
    save();
  }
  /// Everything so far, with how the run stands.
  void finish(const T& tumour, const std::string& ended, int steps, double seconds) {
    const auto& times = tumour.times();
    report_["ended"] = ended;
    report_["t"] = tumour.time();
    report_["steps"] = steps;
    report_["seconds"] = seconds;
    report_["parts"] = {{"geometry", times.geometry},
                        {"nutrient", times.nutrient},
                        {"pressure", times.pressure},
                        {"implicit", times.implicit},
                        {"motion", times.motion}};
    save();
  }
  /// Everything so far, to go on from. \throws cambium::FileError; the last checkpoint is there as it was
  void checkpoint(cambium::Snapshot state) const {
    write_checkpoint(folder_ / "checkpoint.h5", {configuration_, series_, report_.dump(), std::move(state)});
  }
  void save() const {
    write_whole(folder_ / "series.csv", series_);
    write_whole(folder_ / "report.json", report_.dump(2) + "\n");
  }
  const nlohmann::json& report() const { return report_; }

 private:
  static std::string label(double time) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", time);
    return text;
  }
  /// phi, nutrient and pressure for ParaView, and the nutrient in the middle plane for the drawing.
  void write_nodes(const T& tumour, const std::string& name) const {
    const auto& lattice = tumour.lattice();
    const auto& band = tumour.level_set().band();
    std::vector<Named> fields{{"phi", {}}, {"nutrient", {}}, {"pressure", {}}};
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      fields[0].values.push_back(band(lattice.node(i)));
      fields[1].values.push_back(tumour.nutrient()[i]);
      fields[2].values.push_back(tumour.pressure()[i]);
    }
    write_fields<dimension>(folder_ / ("fields_t" + name + ".vti"), lattice, fields);
    const auto across = static_cast<std::size_t>(lattice.nodes()[0]);
    const std::size_t plane = dimension == 2 ? lattice.size() : across * across;
    const std::size_t first = dimension == 2 ? 0 : static_cast<std::size_t>(lattice.nodes()[2] / 2) * plane;
    const std::size_t shape[2] = {plane / across, across};
    for (const Named& field : fields) {
      cambium::write_npy<double>(folder_ / "pictures" / (field.name + "_t" + name + ".npy"),
                                 std::span(field.values).subspan(first, plane), shape);
    }
  }
  void write_drawing(const std::string& name, const cambium::Surface<dimension>& surface,
                     const std::vector<double>& pressure) const {
    std::vector<double> vertices;
    std::vector<std::uint32_t> triangles;
    for (const auto& x : surface.vertices) vertices.insert(vertices.end(), x.component, x.component + dimension);
    for (const auto& e : surface.elements) triangles.insert(triangles.end(), e.begin(), e.end());
    const auto place = [&](const char* what) { return folder_ / "pictures" / (what + ("_t" + name + ".npy")); };
    const std::size_t many[2] = {surface.vertices.size(), dimension}, faces[2] = {surface.elements.size(), dimension};
    cambium::write_npy<double>(place("vertices"), vertices, many);
    cambium::write_npy<std::uint32_t>(place("triangles"), triangles, faces);
    cambium::write_npy<double>(place("surface"), pressure, std::span(many, 1));
  }

  std::filesystem::path folder_;
  std::string configuration_, series_;
  nlohmann::json report_;
};

}  // namespace tumour
