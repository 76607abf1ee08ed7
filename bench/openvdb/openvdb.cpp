// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "openvdb/openvdb.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetAdvect.h>
#include <openvdb/tools/LevelSetTracker.h>
#include <openvdb/tools/Prune.h>
#include <tbb/global_control.h>

#include "levelset/deformation.hpp"
#include "support/clock.hpp"
#include "support/median.hpp"

namespace bench::vdb {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

/// A type of its own has trackers instantiated here, for this processor, and not taken from the library as packaged.
struct Interrupter : openvdb::util::NullInterrupter {};
using Tracker = openvdb::tools::LevelSetTracker<FloatGrid, Interrupter>;

/// One thread, and the library made ready.
class Session {
 public:
  Session() { openvdb::initialize(); }

 private:
  tbb::global_control control_{tbb::global_control::max_allowed_parallelism, 1};
};

template <class F>
void for_each_node(const Values& values, F&& f) {
  std::size_t at = 0;
  for (std::ptrdiff_t z = 0; z < values.nodes[2]; ++z) {
    for (std::ptrdiff_t y = 0; y < values.nodes[1]; ++y) {
      for (std::ptrdiff_t x = 0; x < values.nodes[0]; ++x, ++at) {
        f(at, Coord(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)));
      }
    }
  }
}

/// Voxels whose values are finite and below `cut` are active.
FloatGrid::Ptr make_grid(const Values& values, double half_width, double cut) {
  const auto background = static_cast<float>(half_width);
  auto grid = FloatGrid::create(background);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(values.spacing));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto access = grid->getAccessor();
  for_each_node(values, [&](std::size_t at, const Coord& node) {
    const double phi = values.phi[at];
    if (std::abs(phi) < cut) {
      access.setValueOn(node, static_cast<float>(phi));
    } else if (phi < 0.0) {
      access.setValueOff(node, -background);
    }
  });
  openvdb::tools::pruneLevelSet(grid->tree());
  return grid;
}

/// Values of voxels that are not active are infinite.
Values read(const FloatGrid& grid, const Values& like) {
  Values values{like.nodes, like.spacing, std::vector<double>(like.phi.size())};
  const auto access = grid.getConstAccessor();
  for_each_node(like, [&](std::size_t at, const Coord& node) {
    const double phi = static_cast<double>(access.getValue(node));
    values.phi[at] = access.isValueOn(node) ? phi : std::copysign(std::numeric_limits<double>::infinity(), phi);
  });
  return values;
}

/// The same in a band of six voxels: OpenVDB's own way to widen it leaves what is there as it is.
Values read_widened(const FloatGrid& grid, const Values& like) {
  const auto copy = grid.deepCopy();
  Tracker tracker(*copy);
  tracker.resize(6);
  return read(*copy, like);
}

/// The velocity at a time that the driver sets.
class Field {
 public:
  using ValueType = float;
  using VectorType = openvdb::Vec3f;

  Field(const openvdb::math::Transform& transform, const double& time) : transform_(&transform), time_(&time) {}
  const openvdb::math::Transform& transform() const { return *transform_; }
  VectorType operator()(const openvdb::Vec3d& x, float) const {
    const auto u = Deformation::velocity({x[0], x[1], x[2]}, *time_);
    return {static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2])};
  }
  VectorType operator()(const Coord& node, float time) const {
    return (*this)(transform_->indexToWorld(node.asVec3d()), time);
  }

 private:
  const openvdb::math::Transform* transform_;
  const double* time_;
};

/// Largest step from t on, up to `most`, that is one step for LevelSetAdvection: |u| dt <= h / sqrt(3).
double longest_step(const FloatGrid& grid, double t, double most) {
  double fastest = 0.0;
  for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel) {
    const auto x = grid.indexToWorld(voxel.getCoord());
    fastest = std::max(fastest, norm(Deformation::pattern({x[0], x[1], x[2]})));
  }
  const double limit = 0.999 * grid.voxelSize()[0] / std::sqrt(3.0) / fastest;
  const auto fits = [&](double dt) {
    const double here = std::abs(Deformation::strength(t));
    return dt * std::max(here, std::abs(Deformation::strength(t + dt))) <= limit;
  };
  if (fits(most)) return most;
  double low = 0.0, high = most;
  for (int k = 0; k < 40; ++k) (fits(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  return low;
}

}  // namespace

Advected advect_deformation(const Values& start) {
  const Session session;
  const double width = static_cast<double>(openvdb::LEVEL_SET_HALF_WIDTH) * start.spacing;
  const auto grid = make_grid(start, width, width);
  double time = 0.0;
  const Field field(grid->transform(), time);
  openvdb::tools::LevelSetAdvection<FloatGrid, Field, Interrupter> advection(*grid, field);
  advection.setSpatialScheme(openvdb::math::HJWENO5_BIAS);
  advection.setTemporalScheme(openvdb::math::TVD_RK3);
  Advected result{};
  double t = 0.0;
  for (const double target : {0.5 * Deformation::period, Deformation::period}) {
    while (t < target) {
      const double dt = longest_step(*grid, t, target - t);
      time = t + 0.5 * dt;
      const double begin = cpu_seconds();
      result.steps += advection.advect(0.0F, static_cast<float>(dt));
      result.seconds += cpu_seconds() - begin;
      t = dt == target - t ? target : t + dt;
    }
    (target < Deformation::period ? result.half : result.end) = read_widened(*grid, start);
  }
  return result;
}

Normalised normalise(const Values& start, double half_width, Scheme scheme, int iterations) {
  const Session session;
  constexpr std::size_t calls = 3;
  Normalised result{};
  std::vector<double> seconds;
  for (std::size_t call = 0; call < calls; ++call) {
    const auto grid = make_grid(start, half_width, std::numeric_limits<double>::infinity());
    Tracker tracker(*grid);
    tracker.setSpatialScheme(scheme == Scheme::first ? openvdb::math::FIRST_BIAS : openvdb::math::HJWENO5_BIAS);
    tracker.setTemporalScheme(openvdb::math::TVD_RK3);
    tracker.setNormCount(iterations);
    const double begin = cpu_seconds();
    tracker.normalize();
    seconds.push_back(cpu_seconds() - begin);
    result.nodes = grid->activeVoxelCount();
    if (call + 1 == calls) result.values = read(*grid, start);
  }
  result.seconds = median(seconds);
  return result;
}

}  // namespace bench::vdb
