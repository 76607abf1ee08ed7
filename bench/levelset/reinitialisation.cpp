// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/reinitialisation.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "openvdb/openvdb.hpp"
#include "support/command.hpp"

template class bench::ReinitScene<2>;
#if !BENCH_SMOKE
template class bench::ReinitScene<3>;
#endif

namespace bench {
namespace {

constexpr const char* list_of_fields = "/fields.json";
constexpr const char* list_of_distances = "/scikit_fmm.json";

std::vector<double> read_doubles(const std::string& path, std::size_t count) {
  std::vector<double> values(count);
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(double)));
  if (!in) throw std::runtime_error("cannot read " + std::to_string(count) + " numbers from " + path);
  return values;
}

/// What scikit-fmm made of the scene, if it was asked.
template <int D>
void enter_scikit_fmm(ReinitScene<D>& scene, const std::string& folder) {
  std::ifstream in(folder + list_of_distances);
  if (folder.empty() || !in) return;
  const auto cells = scene.lattice().nodes()[0] - 1;
  for (const auto& entry : nlohmann::json::parse(in)) {
    if (entry["dimension"] != D || entry["cells"] != cells) continue;
    const auto phi = read_doubles(folder + "/" + entry["file"].template get<std::string>(), scene.lattice().size());
    const auto name = "scikit-fmm, order " + std::to_string(entry["order"].template get<int>());
    scene.enter("scikit-fmm", name, dense_band(scene.lattice(), scene.half_width_length(), phi),
                entry["nodes"].template get<std::size_t>(), entry["seconds"].template get<double>());
  }
}

#if WITH_OPENVDB
void enter_openvdb(ReinitScene<3>& scene) {
  const auto& nodes = scene.lattice().nodes();
  const vdb::Values start{{nodes[0], nodes[1], nodes[2]}, scene.lattice().spacing(), scene.badly_scaled_in_band()};
  for (const vdb::Scheme scheme : {vdb::Scheme::first, vdb::Scheme::hjweno5}) {
    for (const int iterations : {3, 10, 30}) {
      const std::string kind = scheme == vdb::Scheme::first ? "first order" : "HJWENO5";
      const std::string name = "OpenVDB " + kind + ", " + std::to_string(iterations) + " iterations";
      if (!scene.wanted(name)) continue;
      const auto made = vdb::normalise(start, scene.half_width_length(), scheme, iterations);
      scene.enter("OpenVDB", name, dense_band(scene.lattice(), scene.half_width_length(), made.values.phi), made.nodes,
                  made.seconds);
    }
  }
}
#endif

template <int D>
void run(std::ptrdiff_t cells, const Options& options, Rows& rows) {
  ReinitScene<D> scene(cells, options, rows);
  run_every_reinitialisation(scene);
  enter_scikit_fmm(scene, options.fields);
#if WITH_OPENVDB
  if constexpr (D == 3) enter_openvdb(scene);
#endif
}

template <int D>
void write_field(std::ptrdiff_t cells, const Options& options, nlohmann::json& list) {
  Rows rows;
  const std::vector<double> phi = ReinitScene<D>(cells, options, rows).badly_scaled();
  const std::string name = std::to_string(D) + "d_" + std::to_string(cells);
  std::ofstream file(options.fields + "/" + name, std::ios::binary);
  file.write(reinterpret_cast<const char*>(phi.data()), static_cast<std::streamsize>(phi.size() * sizeof(double)));
  if (!file.flush()) throw std::runtime_error("cannot write " + name + " in " + options.fields + ": is the disk full?");
  list.push_back({{"file", name}, {"dimension", D}, {"cells", cells}});
}

}  // namespace

void run_reinitialisations(const Options& options, Rows& rows) {
  for (const std::ptrdiff_t cells : options.cells_2d) run<2>(cells, options, rows);
#if !BENCH_SMOKE
  for (const std::ptrdiff_t cells : options.cells_3d) run<3>(cells, options, rows);
#endif
}

void write_fields(const Options& options) {
  std::filesystem::create_directories(options.fields);
  nlohmann::json list = nlohmann::json::array();
  for (const std::ptrdiff_t cells : options.cells_2d) write_field<2>(cells, options, list);
#if !BENCH_SMOKE
  for (const std::ptrdiff_t cells : options.cells_3d) write_field<3>(cells, options, list);
#endif
  write_json(options.fields + list_of_fields, list);
}

}  // namespace bench
