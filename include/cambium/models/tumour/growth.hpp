// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/closest_points.hpp>
#include <cambium/levelset/geometry/at_closest_points.hpp>
#include <cambium/models/tumour/centred_source.hpp>
#include <cambium/models/tumour/interface_source.hpp>
#include <cambium/models/tumour/parameters.hpp>
#include <cambium/models/tumour/sides.hpp>

namespace cambium {

/// Seconds on the wall that the parts of steps have taken so far.
struct TumourTimes {
  double geometry = 0.0;  ///< closest points if the reinitialisation leaves none, normals, curvature
  double nutrient = 0.0;
  double pressure = 0.0;  ///< with the speed that follows from it
  double implicit = 0.0;  ///< solving for the stiff part of the surface tension
  double motion = 0.0;    ///< moving phi and making it a distance again

  double total() const { return geometry + nutrient + pressure + implicit + motion; }
};

namespace detail {

/// Saves or restores the state of a policy's method that has one.
template <class Part, class Archive>
void visit_part(Part& part, Archive& archive) {
  if constexpr (requires { Part::visit(part, archive); }) Part::visit(part, archive);
}

/// Adds what a scope takes to a number of seconds.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_;
};

/// From the interface to its speed: geometry, nutrient, pressure, V = -dp/dn at the closest point of every node of the
/// band (NaN at nodes without one).
template <int D, class Nutrient, class Outside, class Core, class Filter>
class TumourGrowth {
 public:
  using Kernel = Lambda<4, 4>;
  /// The curvature's error varies from node to node, and so does what the jump conditions make of it: with Lambda44
  /// long waves in free space felt 4 to 7% less tension than there is at h = R / 10, with Lambda64 0.2 to 1.3%. In
  /// space the corners of its stencil are cut off by the band; they weigh 1e-5.
  using CurvatureKernel = Lambda<6, 4>;
  using Band = NarrowBand<double, D>;
  using Points = ClosestPoints<Kernel, double, D>;
  using Values = Field<double, D, Sparse>;
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  TumourGrowth(const Lattice<D>& lattice, double half_width, const TumourParameters& parameters,
               const OpenMP& execution)
      : parameters_(parameters),
        execution_(execution),
        geometry_(lattice),
        nutrient_(lattice, execution),
        outside_(lattice, half_width + 1.0, execution),
        filter_(lattice),
        c_(lattice, 1.0),
        p_(lattice),
        source_(lattice),
        centred_(lattice),
        drop_(lattice),
        speed_(lattice, unknown) {}

  /// Where interfaces meet, kinks have no curvature: it counts up to 1 / h, the tightest curve that the lattice holds.
  /// \param elapsed  since the nutrient of the last accept(); infinite for one at rest, 0 for that itself
  template <class L>
  void evaluate(const L& level_set, double elapsed) {
    {
      const Stopwatch watch(times_.geometry);
      find_geometry(level_set);
    }
    const Band& band = level_set.band();
    {
      const Stopwatch watch(times_.nutrient);
      nutrient_.solve(band, elapsed, c_);
    }
    const Stopwatch watch(times_.pressure);
    find_source(band);
    take_blocks(drop_, band);
    start_speed(band, speed_);
    const double bound = 1.0 / band.spacing();
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        drop_.block(b)[i] = parameters_.tension * std::clamp(geometry_.mean.block(b)[i], -bound, bound);
      }
    }
    outside_.attach(band, *points_, geometry_);
    outside_.solve(source_, drop_, InterfaceSource<D>{parameters_, c_}, p_, speed_);
    filter_(band, speed_, execution_);
  }
  void accept() { nutrient_.accept(c_); }

  /// Saves or restores what evaluate() found and what it starts from, see SnapshotWriter.
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive("nutrient", self.c_);
    archive("pressure", self.p_);
    archive("speed", self.speed_);
    visit_part(self.nutrient_, archive);
    visit_part(self.outside_, archive);
    archive("seconds.geometry", self.times_.geometry);
    archive("seconds.nutrient", self.times_.nutrient);
    archive("seconds.pressure", self.times_.pressure);
    archive("seconds.implicit", self.times_.implicit);
    archive("seconds.motion", self.times_.motion);
  }
  /// After restoring: takes the interface that it was evaluated at.
  template <class L>
  void attach(const L& level_set) {
    require_same_blocks(speed_, level_set.band(), "the saved speed");
    find_geometry(level_set);
    outside_.attach(level_set.band(), *points_, geometry_);
  }

  /// gamma times the speed that a drop of the pressure with short waves causes, over their wave number.
  double tension_mobility() const { return Outside::mobility * parameters_.tension; }
  /// Closest point of node i of block b, which must have one.
  Vec<D> closest_point(const Band& band, std::size_t b, std::size_t i) const {
    return band.lattice().position(band.values().node(b, i)) + points_->offset(b, i) * band.spacing();
  }
  /// Gives a field the blocks of the band, 0 where there is a closest point and NaN elsewhere.
  void start_speed(const Band& band, Values& speed) const {
    take_blocks(speed, band);
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) speed.block(b)[i] = points_->found(b, i) ? 0.0 : unknown;
    }
  }

  const TumourParameters& parameters() const { return parameters_; }
  const Field<double, D>& nutrient() const { return c_; }
  const Field<double, D>& pressure() const { return p_; }
  const Values& speed() const { return speed_; }
  const BandGeometry<double, D>& geometry() const { return geometry_; }
  const Points& points() const { return *points_; }
  TumourTimes& times() { return times_; }
  const TumourTimes& times() const { return times_; }
  std::size_t unresolved() const { return outside_.unresolved(); }

 private:
  template <class L>
  void find_geometry(const L& level_set) {
    const Band& band = level_set.band();
    if constexpr (requires {
                    { level_set.method().points() } -> std::same_as<const Points&>;
                  }) {
      points_ = &level_set.method().points();
    } else {
      own_points_.find(band, static_cast<double>(band.half_width()), execution_);
      points_ = &own_points_;
    }
    curvature_(band, *points_, geometry_, execution_);
  }
  void find_source(const Band& band) {
    const auto find_plain = [&](Field<double, D>& plain) {
      for_each_side(band, execution_, [&](std::size_t i, bool inside) {
        plain[i] = inside ? Core::source(parameters_, c_, band, i) : unknown;
      });
    };
    centred_.find(execution_, find_plain, source_);
  }

  TumourParameters parameters_;
  OpenMP execution_;
  TumourTimes times_;
  Points own_points_;
  const Points* points_ = nullptr;
  typename AtClosestPoints<CurvatureKernel>::template Method<double, D> curvature_;
  BandGeometry<double, D> geometry_;
  typename Nutrient::template Method<D> nutrient_;
  typename Outside::template Method<D, Kernel> outside_;
  typename Filter::template Method<D> filter_;
  Field<double, D> c_, p_, source_;
  CentredSource<D> centred_;
  Values drop_, speed_;
};

}  // namespace detail
}  // namespace cambium
