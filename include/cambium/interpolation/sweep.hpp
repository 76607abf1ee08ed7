// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include <cambium/interpolation/window.hpp>
#include <cambium/simd/lane.hpp>

namespace cambium::detail {

/// Moves a window through a box of cells, plane by plane along the last axis, in two or three dimensions.
///
/// Row order: `row_of(cell)` gives the range of particles whose cell along axes 1, ..., D - 1 is `cell` (axis 0 of
/// `cell` is the box's first). All arrays are in that order.
template <class K, class T, class P, int D, int C>
class Sweep {
 public:
  static constexpr std::size_t lanes = tap_lanes<K>;
  static constexpr std::size_t support = K::support;
  using Block = TapBlock<K, T, P, D>;

  explicit Sweep(const Lattice<D>& lattice) : block_(lattice) {}

  /// P2M. Padded plane p is complete when sink.begin(p), sink.row(p, r, c, line) for every padded row r in ascending
  /// order and component c (entry i at line[i]), and sink.end(p) are called; planes come in ascending order.
  template <class RowOf, class Sink>
  void spread(const CellBox<D>& box, const std::array<const P*, D>& x, const std::array<const T*, C>& strength,
              RowOf&& row_of, Sink&& sink) {
    window_.reset(box.count);
    line_.resize(window_.columns());
    const auto planes = static_cast<std::size_t>(box.count[D - 1]);
    for (std::size_t s = 0; s < planes + support - 1; ++s) {
      last_.rotate(s);
      sink.begin(s);
      for (std::size_t r = 0; r < window_.rows(); ++r) {
        if (s < planes && has_particles(box, r)) spread_row(cell_at(box, s, r), r, x, strength, row_of);
        emit(s, r, sink);
      }
      sink.end(s);
    }
  }

  /// M2P. source(p, r, c, line) fills padded row r of plane p of component c (entry i at line[i]).
  template <class RowOf, class Source>
  void collect(const CellBox<D>& box, const std::array<const P*, D>& x, const std::array<T*, C>& value, RowOf&& row_of,
               Source&& source) {
    window_.reset(box.count);
    line_.resize(window_.columns());
    for (std::size_t p = 0; p + 1 < support; ++p) {
      for (std::size_t r = 0; r < window_.rows(); ++r) fill(p, r, source);
    }
    const auto planes = static_cast<std::size_t>(box.count[D - 1]);
    for (std::size_t s = 0; s < planes; ++s) {
      last_.rotate(s);
      const std::size_t ahead = std::min(support, window_.rows());
      for (std::size_t r = 0; r < ahead; ++r) fill(s + support - 1, r, source);
      for (std::size_t r = 0; has_particles(box, r); ++r) {
        if (r + ahead < window_.rows()) fill(s + support - 1, r + ahead, source);
        collect_row(cell_at(box, s, r), r, x, value, row_of);
      }
    }
  }

 private:
  static bool has_particles(const CellBox<D>& box, std::size_t r) {
    return D == 2 ? r == 0 : r < static_cast<std::size_t>(box.count[1]);
  }
  static Index<D> cell_at(const CellBox<D>& box, std::size_t plane, std::size_t row) {
    Index<D> cell = box.first;
    cell[D - 1] += static_cast<std::ptrdiff_t>(plane);
    if constexpr (D == 3) cell[1] += static_cast<std::ptrdiff_t>(row);
    return cell;
  }
  /// Calls work(begin, count) for the particles of a row of cells in blocks, located.
  template <class RowOf, class F>
  void for_each_block(const Index<D>& cell, const std::array<const P*, D>& x, RowOf&& row_of, F&& work) {
    const auto [begin, end] = row_of(cell);
    for (std::size_t b = begin; b < end; b += Block::capacity) {
      const std::size_t count = std::min<std::size_t>(Block::capacity, end - b);
      std::array<const P*, D> at;
      for (int d = 0; d < D; ++d) at[d] = x[d] + b;
      block_.locate(at, count, cell);
      work(b, count);
    }
  }
  template <class RowOf>
  void spread_row(const Index<D>& cell, std::size_t r, const std::array<const P*, D>& x,
                  const std::array<const T*, C>& strength, RowOf&& row_of) {
    const Spread<K, T, P, D, C> spread(block_, last_, static_cast<std::ptrdiff_t>(window_.pitch()));
    std::array<T*, C> row;
    for (int c = 0; c < C; ++c) row[c] = window_.row(c, r);
    for_each_block(cell, x, row_of, [&](std::size_t begin, std::size_t count) {
      std::array<const T*, C> q;
      for (int c = 0; c < C; ++c) q[c] = strength[c] + begin;
      spread(q, count, row);
    });
  }
  template <class RowOf>
  void collect_row(const Index<D>& cell, std::size_t r, const std::array<const P*, D>& x,
                   const std::array<T*, C>& value, RowOf&& row_of) {
    const Collect<K, T, P, D, C> collect(block_, last_, static_cast<std::ptrdiff_t>(window_.pitch()));
    std::array<const T*, C> row;
    for (int c = 0; c < C; ++c) row[c] = window_.row(c, r);
    for_each_block(cell, x, row_of, [&](std::size_t begin, std::size_t count) {
      std::array<T*, C> q;
      for (int c = 0; c < C; ++c) q[c] = value[c] + begin;
      collect(q, count, row);
    });
  }
  /// Hands a complete row to the sink and clears its lane for the plane that enters the window.
  template <class Sink>
  void emit(std::size_t plane, std::size_t r, Sink&& sink) {
    for (int c = 0; c < C; ++c) {
      simd::take_lane<lanes>(window_.row(c, r), plane % lanes, window_.columns(), line_.data());
      sink.row(plane, r, c, line_.data());
    }
  }
  template <class Source>
  void fill(std::size_t plane, std::size_t r, Source&& source) {
    for (int c = 0; c < C; ++c) {
      source(plane, r, c, line_.data());
      simd::put_lane<lanes>(line_.data(), plane % lanes, window_.columns(), window_.row(c, r));
    }
  }

  Window<K, T, D, C> window_;
  AlignedVector<T> line_;
  LastTaps<K, T> last_;
  Block block_;
};

}  // namespace cambium::detail
