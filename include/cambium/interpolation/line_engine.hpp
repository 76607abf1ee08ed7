// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include <cambium/interpolation/closure.hpp>
#include <cambium/interpolation/row_order.hpp>

namespace cambium::detail {

/// P2M and M2P in one dimension: taps are one unaligned vector along the only axis. Runs of 1024 cells are worked on by
/// one thread each into lines of their own, which are added in order.
template <class K, class T, class P, int C>
class LineEngine {
 public:
  explicit LineEngine(const Lattice<1>& lattice)
      : lattice_(lattice), x_(lattice, 0), locator_(lattice, 0), cells_(cells_along<K>(lattice, 0)) {
    taps_.rotate(0);
  }

  const Lattice<1>& lattice() const { return lattice_; }

  template <Execution E>
  void p2m(const std::array<const P*, 1>& x, const std::array<const T*, C>& strength, const RowOrder& order, T* mesh,
           const E& execution) {
    lines_.assign(order.rows() * C * pitch, T(0));
    for_each_piece(execution, order.rows(), 1, [&](std::size_t r, std::size_t) {
      const auto [begin, end] = order.row(r);
      for (std::size_t p = begin; p < end; ++p) {
        const auto [cell, g] = locator_(x[0][p]);
        const Lanes weight = taps_(static_cast<T>(g));
        for (int c = 0; c < C; ++c) {
          T* node = line(r, c) + (cell - static_cast<std::ptrdiff_t>(r * run));
          fma(weight, Lanes(strength[c][p]), Lanes::load(node)).store(node);
        }
      }
    });
    std::fill_n(mesh, static_cast<std::size_t>(x_.nodes()) * C, T(0));
    for (std::size_t r = 0; r < order.rows(); ++r) {
      for_each_node(r, [&](std::ptrdiff_t i, std::ptrdiff_t node) {
        x_(node, [&](std::ptrdiff_t to, double w) {
          for (int c = 0; c < C; ++c) mesh[to * C + c] += static_cast<T>(w) * line(r, c)[i];
        });
      });
    }
  }

  template <Execution E>
  void m2p(const std::array<const P*, 1>& x, const std::array<T*, C>& value, const RowOrder& order, const T* mesh,
           const E& execution) {
    lines_.assign(order.rows() * C * pitch, T(0));
    for_each_piece(execution, order.rows(), 1, [&](std::size_t r, std::size_t) {
      for_each_node(r, [&](std::ptrdiff_t i, std::ptrdiff_t node) {
        x_(node, [&](std::ptrdiff_t from, double w) {
          for (int c = 0; c < C; ++c) line(r, c)[i] += static_cast<T>(w) * mesh[from * C + c];
        });
      });
      const auto [begin, end] = order.row(r);
      for (std::size_t p = begin; p < end; ++p) {
        const auto [cell, g] = locator_(x[0][p]);
        const Lanes weight = taps_(static_cast<T>(g));
        const std::ptrdiff_t first = cell - static_cast<std::ptrdiff_t>(r * run);
        for (int c = 0; c < C; ++c) value[c][p] = sum(weight * Lanes::load(line(r, c) + first));
      }
    });
  }

 private:
  static constexpr std::size_t run = 1024;
  static constexpr std::size_t pitch = run + 2 * tap_lanes<K>;
  using Lanes = simd::Pack<T, tap_lanes<K>>;

  T* line(std::size_t r, int c) { return lines_.data() + (r * C + static_cast<std::size_t>(c)) * pitch; }
  /// Calls f(entry of the line, node) for all nodes under the cells of run r.
  template <class F>
  void for_each_node(std::size_t r, F&& f) const {
    const auto first = static_cast<std::ptrdiff_t>(r * run);
    const std::ptrdiff_t count = std::min<std::ptrdiff_t>(run, cells_ - first);
    for (std::ptrdiff_t i = 0; i < count + K::support - 1; ++i) f(i, first + i - Taps<K>::before);
  }

  Lattice<1> lattice_;
  Closure<K> x_;
  AxisLocator<K, P> locator_;
  std::ptrdiff_t cells_;
  RotatedTaps<K, T> taps_;
  AlignedVector<T> lines_;
};

}  // namespace cambium::detail
