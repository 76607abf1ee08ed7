// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <cambium/interpolation/interpolator.hpp>
#include <cambium/interpolation/place_particles.hpp>
#include <cambium/interpolation/remesh_params.hpp>
#include <cambium/interpolation/split_pass.hpp>

namespace cambium::detail {

/// The passes of a split remeshing of C strength components, last axis first, and their arrays.
template <class K, class T, class P, int D, int C>
class SplitPlan {
 public:
  explicit SplitPlan(const Lattice<D>& lattice)
      : engine{lattice}, first_(lattice, D - 1), second_(lattice, D > 1 ? D - 2 : 0), third_(lattice, 0) {
    for (auto& array : displacement_) array.resize(lattice.size());
    for (auto& array : buffer_) array.resize(lattice.size());
    for (auto& array : result_) array.resize(lattice.size());
  }

  /// Displacements in spacings of particles from their nodes, along the shortest way on periodic axes.
  /// \throws PositionError for a particle that is not finite or outside a bounded box
  template <Execution E>
  void find_displacements(Columns<D, const P> x, const E& execution) {
    const Lattice<D>& lattice = engine.on;
    for_each_piece(execution, x.size(), 4096, [&](std::size_t begin, std::size_t end) {
      Index<D> node = lattice.node(begin);
      for (std::size_t p = begin; p < end; ++p) {
        for (int d = 0; d < D; ++d)
          displacement_[d][p] = static_cast<T>(displacement(lattice, x.column(d)[p], d, node[d]));
        int d = 0;
        while (d < D && ++node[d] == lattice.nodes()[d]) node[d++] = 0;
      }
      for (std::size_t p = begin; p < end; ++p) check(lattice, x, p);
    });
  }

  template <class... V>
  void read(const Particles<D, P>& particles, Attribute<V>... strengths) {
    int next = 0;
    const auto take = [&](const auto& columns) {
      for (int c = 0; c < columns.count; ++c) strength_[next++] = columns.column(c).data();
    };
    (take(columns_of(particles[strengths])), ...);
  }

  template <Execution E>
  void run(const E& execution) {
    std::array<const T*, C + D - 1> in{};
    std::array<T*, C + D - 1> out{};
    for (int c = 0; c < C; ++c) in[c] = strength_[c];
    for (int d = 0; d + 1 < D; ++d) in[C + d] = displacement_[d].data();
    for (std::size_t m = 0; m < out.size(); ++m) out[m] = buffer_[m].data();
    if constexpr (D == 1) {
      first_(displacement_[0].data(), in, results(), execution);
    } else if constexpr (D == 2) {
      first_(displacement_[1].data(), in, out, execution);
      second_(out[C], strengths(out), results(), execution);
    } else {
      first_(displacement_[2].data(), in, out, execution);
      std::array<const T*, C + 1> carried{};
      std::array<T*, C + 1> next{};
      for (int m = 0; m <= C; ++m) carried[m] = out[m];
      for (int c = 0; c < C; ++c) next[c] = result_[c].data();
      next[C] = displacement_[0].data();
      second_(out[C + 1], carried, next, execution);
      std::array<const T*, C> last{};
      for (int c = 0; c < C; ++c) last[c] = next[c];
      std::array<T*, C> final{};
      for (int c = 0; c < C; ++c) final[c] = buffer_[c].data();
      third_(next[C], last, final, execution);
      for (int c = 0; c < C; ++c) std::swap(buffer_[c], result_[c]);
    }
  }

  template <Execution E, class... V>
  RemeshReport<V...> write(Particles<D, P>& particles, const E& execution, Attribute<V>... strengths) {
    const Lattice<D>& lattice = engine.on;
    if (particles.names().size() != sizeof...(V)) {
      particles.resize(0);
      particles.resize(lattice.size());
    }
    for_each_piece(execution, lattice.size(), 4096, [&](std::size_t begin, std::size_t end) {
      place_positions(particles.positions(), lattice, begin, begin, end, [](std::size_t) { return true; });
    });
    int next = 0;
    const auto give = [&](const auto& columns) {
      for (int c = 0; c < columns.count; ++c, ++next) {
        const auto column = columns.column(c);
        for_each_piece(execution, lattice.size(), 4096, [&](std::size_t begin, std::size_t end) {
          std::copy(result_[next].begin() + static_cast<std::ptrdiff_t>(begin),
                    result_[next].begin() + static_cast<std::ptrdiff_t>(end),
                    column.begin() + static_cast<std::ptrdiff_t>(begin));
        });
      }
    };
    (give(columns_of(particles[strengths])), ...);
    RemeshReport<V...> report;
    report.created = lattice.size();
    return report;
  }

  OnLattice<D> engine;

 private:
  static double displacement(const Lattice<D>& lattice, double x, int d, std::ptrdiff_t node) {
    double u = (x - lattice.box().lo[d]) / lattice.spacing() - static_cast<double>(node);
    if (lattice.periodic(d)) {
      const auto n = static_cast<double>(lattice.nodes()[d]);
      u -= n * std::round(u / n);
    }
    return u;
  }
  static void check(const Lattice<D>& lattice, Columns<D, const P> x, std::size_t p) {
    require_inside(lattice.domain(), x[p], p);
  }
  std::array<T*, C> results() {
    std::array<T*, C> result{};
    for (int c = 0; c < C; ++c) result[c] = result_[c].data();
    return result;
  }
  static std::array<const T*, C> strengths(const std::array<T*, C + D - 1>& all) {
    std::array<const T*, C> result{};
    for (int c = 0; c < C; ++c) result[c] = all[c];
    return result;
  }

  SplitPass<K, T, C, D - 1> first_;
  SplitPass<K, T, C, D == 3 ? 1 : 0> second_;
  SplitPass<K, T, C, 0> third_;
  std::array<const T*, C> strength_{};
  std::array<AlignedVector<T>, D> displacement_;
  std::array<AlignedVector<T>, C + D - 1> buffer_;
  std::array<AlignedVector<T>, C> result_;
};

}  // namespace cambium::detail
