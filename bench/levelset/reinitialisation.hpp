// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/geometry/at_closest_points.hpp>
#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/levelset/geometry/ridge_aware.hpp>
#include <cambium/levelset/reinitialisation.hpp>

#include "levelset/dense_band.hpp"
#include "levelset/ellipsoid.hpp"
#include "levelset/options.hpp"
#include "support/clock.hpp"
#include "support/median.hpp"

namespace bench {

/// A badly scaled ellipsoid on one lattice, and what reinitialisations make of it.
template <int D>
class ReinitScene {
 public:
  using Band = cambium::NarrowBand<double, D>;
  using Geometry = cambium::BandGeometry<double, D>;

  ReinitScene(std::ptrdiff_t cells, const Options& options, Rows& rows)
      : lattice_(cambium::Lattice<D>::bounded_box(cambium::Box<D>::cube(), cells)),
        start_(lattice_, half_width * lattice_.spacing()),
        options_(options),
        rows_(rows) {
    for (std::size_t k = 0; k < lattice_.size(); ++k) exact_.push_back(body_(lattice_.position(lattice_.node(k))));
    fill_start();
  }

  const cambium::Lattice<D>& lattice() const { return lattice_; }
  /// The badly scaled phi of all nodes.
  std::vector<double> badly_scaled() const {
    std::vector<double> phi(lattice_.size());
    for (std::size_t k = 0; k < phi.size(); ++k) phi[k] = badly_scaled(lattice_.node(k));
    return phi;
  }
  /// The same, infinite at nodes out of the band.
  std::vector<double> badly_scaled_in_band() const {
    std::vector<double> phi = badly_scaled();
    for (std::size_t k = 0; k < phi.size(); ++k) {
      const double distance = exact_[k].distance;
      if (std::abs(distance) >= half_width_length()) phi[k] = std::copysign(infinite, distance);
    }
    return phi;
  }
  double half_width_length() const { return half_width * lattice_.spacing(); }
  bool wanted(const std::string& name) const { return name.find(options_.only) != std::string::npos; }

  /// Measures reinitialisation R.
  template <class R>
  void run(const char* family, const char* name, const typename R::Params& params = {}) {
    if (!wanted(name)) return;
    typename R::template Method<double, D> method{params};
    Band band = start_;
    method(band, cambium::Serial{});  // has the buffers made
    std::vector<double> seconds;
    cambium::ReinitReport report;
    for (int call = 0; call < 3; ++call) {
      band = start_;
      const double begin = cpu_seconds();
      report = method(band, cambium::Serial{});
      seconds.push_back(cpu_seconds() - begin);
    }
    enter(family, name, band, report.nodes, median(seconds));
  }
  /// Enters what somebody else made of it.
  void enter(const char* family, const std::string& name, const Band& band, std::size_t nodes, double seconds) {
    nlohmann::json row{{"family", family},
                       {"method", name},
                       {"dimension", D},
                       {"cells", lattice_.nodes()[0] - 1},
                       {"nodes", nodes},
                       {"seconds", seconds},
                       {"ns_per_node", 1e9 * seconds / static_cast<double>(nodes)},
                       {"distance", distance_error(band)}};
    row["curvature"]["centred 2"] = level_error<cambium::CentredDifferences<2>>(band);
    row["curvature"]["centred 4"] = level_error<cambium::CentredDifferences<4>>(band);
    row["curvature"]["ridge-aware"] = level_error<cambium::RidgeAware>(band);
    row["curvature"]["closest points"] = surface_error(band);
    print(row);
    rows_.push_back(row);
  }

 private:
  static constexpr double half_width = 6.0;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Largest and mean error over some nodes.
  struct Error {
    double largest = 0.0;
    double sum = 0.0;
    std::size_t count = 0;

    void add(double error) {
      largest = std::max(largest, std::abs(error));
      sum += std::abs(error);
      ++count;
    }
    nlohmann::json row() const { return {{"max", largest}, {"mean", sum / static_cast<double>(count)}}; }
  };

  double badly_scaled(const cambium::Index<D>& node) const {
    return body_.badly_scaled(lattice_.position(node), exact_[lattice_.number(node)].distance);
  }
  /// Blocks with nodes up to five spacings beyond the band, as reinitialisations may ask for.
  void fill_start() {
    for (std::size_t k = 0; k < lattice_.size(); ++k) {
      if (std::abs(exact_[k].distance) >= (half_width + 5.0) * lattice_.spacing()) continue;
      start_.values().activate(start_.values().block_of(lattice_.node(k)));
    }
    for (std::size_t b = 0; b < start_.blocks(); ++b) {
      for (std::size_t i = 0; i < start_.volume; ++i) {
        start_.values().block(b)[i] = badly_scaled(start_.inside(start_.values().node(b, i)));
      }
    }
    start_.find_far_sides();
  }

  /// Calls f(b, i, exact) for the nodes of a band within so many spacings of the interface.
  template <class F>
  void for_each_near(const Band& band, double within, F&& f) const {
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        const auto node = band.values().node(b, i);
        if (!lattice_.contains(node)) continue;
        const auto& exact = exact_[lattice_.number(node)];
        if (std::abs(exact.distance) < within * lattice_.spacing()) f(b, i, exact);
      }
    }
  }
  nlohmann::json distance_error(const Band& band) const {
    Error error;
    for_each_near(band, 2.0, [&](std::size_t b, std::size_t i, const auto& exact) {
      error.add((band.values().block(b)[i] - exact.distance) / lattice_.spacing());
    });
    return error.row();
  }
  /// Relative error of the curvature of level surfaces at the nodes next to the interface.
  template <class G>
  nlohmann::json level_error(const Band& band) const {
    typename G::template Method<double, D> method;
    Geometry geometry(lattice_);
    method(band, geometry, cambium::Serial{});
    Error error;
    for_each_near(band, 1.0, [&](std::size_t b, std::size_t i, const auto& exact) {
      error.add(geometry.mean.block(b)[i] / exact.of_level - 1.0);
    });
    return error.row();
  }
  /// That of the interface at the closest points of the same nodes.
  nlohmann::json surface_error(const Band& band) const {
    typename cambium::AtClosestPoints<>::Method<double, D> method;
    Geometry geometry(lattice_);
    method(band, geometry, cambium::Serial{});
    Error error;
    for_each_near(band, 1.0, [&](std::size_t b, std::size_t i, const auto& exact) {
      error.add(geometry.mean.block(b)[i] / exact.of_surface - 1.0);
    });
    return error.row();
  }
  static void print(const nlohmann::json& row) {
    std::printf("%dD %4d %-34s %8.0f ns %9.1e h %9.1e h, curvature", D, row["cells"].get<int>(),
                row["method"].get<std::string>().c_str(), row["ns_per_node"].get<double>(),
                row["distance"]["max"].get<double>(), row["distance"]["mean"].get<double>());
    for (const auto& error : row["curvature"]) std::printf(" %8.1e", error["max"].get<double>());
    std::printf("\n");
    std::fflush(stdout);
  }

  Body<D> body_;
  cambium::Lattice<D> lattice_;
  std::vector<typename Body<D>::Point> exact_;
  Band start_;
  const Options& options_;
  Rows& rows_;
};

extern template class ReinitScene<2>;
extern template class ReinitScene<3>;

/// Runs every reinitialisation there is; defined in every_reinitialisation.hpp, or in smoke.cpp with few of them.
template <int D>
void run_every_reinitialisation(ReinitScene<D>& scene);

}  // namespace bench
