// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <cambium/levelset/level_set.hpp>
#include <cambium/time/rk4.hpp>

namespace cambium {

/// Lagrangian advection of a level set by long steps: particles that will arrive on the nodes of the new band are
/// followed back to where they come from, and take phi from there with kernel K.
template <class K = Lambda<4, 4>, template <class, class> class S = RK4>
class Backward {
 public:
  struct Params {
    int substeps = 1;
    int every = 1;
  };
  explicit Backward(const Params& params = {}) : params_(params) {}

  template <class Reinit, int D, class T, class V, class E = OpenMP>
  void step(LevelSet<Reinit, D, T>& level_set, V&& velocity, double t, double dt, const E& execution = {}) {
    Column<D, T> front = near_nodes(level_set.band());
    follow<D, T>(front, velocity, t, dt, execution);
    const Lattice<D>& lattice = level_set.lattice();
    const double h = lattice.spacing();
    const double radius = static_cast<double>(level_set.band().half_width()) / h;
    const NarrowBand<T, D> old = level_set.band();
    // lists of front points by block
    const Index<D> grid = old.values().block_grid();
    std::vector<std::vector<Vec<D, T>>> bins(static_cast<std::size_t>(product(grid)));
    level_set.replace(
        [&](detail::BlockMarks<D>& marks) {
          for (std::size_t p = 0; p < front[0].size(); ++p) {
            Index<D> low, high;
            std::ptrdiff_t bin = 0, pitch = 1;
            Vec<D, T> u;
            for (int d = 0; d < D; ++d) {
              u[d] = static_cast<T>((front[d][p] - lattice.box().lo[d]) / h);
              low[d] = static_cast<std::ptrdiff_t>(std::ceil(u[d] - radius));
              high[d] = static_cast<std::ptrdiff_t>(std::floor(u[d] + radius));
              const auto blk = std::clamp<std::ptrdiff_t>(
                  static_cast<std::ptrdiff_t>(std::floor(u[d])) / BlockShape<D>::extent, 0, grid[d] - 1);
              bin += blk * pitch;
              pitch *= grid[d];
            }
            marks.mark(low, high);
            bins[static_cast<std::size_t>(bin)].push_back(u);
          }
        },
        [&](NarrowBand<T, D>& band, std::size_t b, std::size_t) {
          detail::NearestCandidates<T, D> nearest;
          nearest.reset(static_cast<T>(radius));
          const Index<D> mine = band.values().block_index(b);
          const std::ptrdiff_t r = static_cast<std::ptrdiff_t>(radius) / BlockShape<D>::extent + 1;
          for (std::ptrdiff_t k = 0; k < std::pow(2 * r + 1, D); ++k) {
            std::ptrdiff_t rest = k, bin = 0, pitch = 1;
            bool ok = true;
            for (int d = 0; d < D; ++d) {
              const std::ptrdiff_t x = mine[d] + rest % (2 * r + 1) - r;
              rest /= 2 * r + 1;
              ok &= x >= 0 && x < grid[d];
              bin += x * pitch;
              pitch *= grid[d];
            }
            if (!ok) continue;
            for (Vec<D, T> u : bins[static_cast<std::size_t>(bin)]) {
              for (int d = 0; d < D; ++d) u[d] -= static_cast<T>(mine[d] * BlockShape<D>::extent);
              nearest.offer(u, 0);
            }
          }
          trace_block(old, band, b, nearest, velocity, t, dt);
        },
        execution);
    if (++count_ % params_.every == 0)
      level_set.reinitialise(execution);
    else
      level_set.trim();
  }

 private:
  template <int D, class T>
  using Column = std::array<AlignedVector<T>, D>;

  template <class T, int D>
  static Column<D, T> near_nodes(const NarrowBand<T, D>& band) {
    Column<D, T> result;
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        if (!(std::abs(band.values().block(b)[i]) <= static_cast<T>(band.spacing()))) continue;
        const Index<D> node = band.values().node(b, i);
        if (!band.lattice().contains(node)) continue;
        const Vec<D> x = band.lattice().position(node);
        for (int d = 0; d < D; ++d) result[d].push_back(static_cast<T>(x[d]));
      }
    }
    return result;
  }
  /// dx/ds = +-u: forward from t to t + dt, or backward from t + dt to t.
  template <int D, class T, class V, class E>
  void follow(Column<D, T>& x, V&& velocity, double t, double dt, const E& execution, bool back = false) const {
    std::array<T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = x[d].data();
    Columns<D, T> state(first, x[0].size());
    S<Columns<D, T>, E> stepper(state, execution);
    const double sub = dt / params_.substeps;
    for (int s = 0; s < params_.substeps; ++s) {
      stepper.step(state, s * sub, sub, [&](const auto& at, double tau, auto&& rate) {
        const double time = back ? t + dt - tau : t + tau;
        for_each(execution, at.size(), [&](std::size_t p) {
          const Vec<D, T> u = velocity(at[p], time);
          rate.set(p, back ? -u : u);
        });
      });
    }
  }
  template <class T, int D, class V>
  void trace_block(const NarrowBand<T, D>& old, NarrowBand<T, D>& band, std::size_t b,
                   const detail::NearestCandidates<T, D>& nearest, V&& velocity, double t, double dt) const {
    const auto phi = band.values().block(b);
    std::fill(phi.begin(), phi.end(), std::numeric_limits<T>::quiet_NaN());
    Column<D, T> x;
    std::vector<std::size_t> node;
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const Index<D> at = band.values().node(b, i);
      if (!band.lattice().contains(at)) continue;
      if (!nearest.found(i) && !(i == 0)) continue;
      const Vec<D> position = band.lattice().position(at);
      for (int d = 0; d < D; ++d) x[d].push_back(static_cast<T>(position[d]));
      node.push_back(i);
    }
    if (node.empty()) return;
    follow<D, T>(x, velocity, t, dt, Serial{}, true);
    Index<D> low = Index<D>::constant(1 << 30), high = Index<D>::constant(-(1 << 30));
    const T inverse = static_cast<T>(1.0 / band.spacing());
    for (std::size_t p = 0; p < node.size(); ++p) {
      for (int d = 0; d < D; ++d) {
        x[d][p] = (x[d][p] - static_cast<T>(band.lattice().box().lo[d])) * inverse;
        const auto cell = static_cast<std::ptrdiff_t>(std::floor(x[d][p]));
        low[d] = std::min(low[d], cell - Taps<K>::before - 1);
        high[d] = std::max(high[d], cell + Taps<K>::support);
      }
    }
    Patch<T, D> patch;
    patch.read(old, low, high - low + Index<D>::constant(1));
    for (std::size_t p = 0; p < node.size(); ++p) {
      Vec<D, T> u;
      for (int d = 0; d < D; ++d) u[d] = x[d][p] - static_cast<T>(low[d]);
      phi[node[p]] = Interpolant<K, T, D>::value(patch.data(), patch.stride(), u);
    }
  }

  Params params_;
  int count_ = 0;
};

}  // namespace cambium
