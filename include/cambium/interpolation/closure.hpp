// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include <cambium/core/aligned.hpp>
#include <cambium/core/lattice.hpp>
#include <cambium/interpolation/tap_block.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// What the nodes of a stencil that lie beyond the lattice along one axis stand for.
///
/// Periodic: the wrapped node. Bounded: the extrapolation of the kernel's moment degree from the nodes at the face. P2M
/// gives the strength of such a node to those it stands for, M2P reads their combination, so that the two stay adjoint;
/// extrapolation is exact for polynomials up to the kernel's moments, so that moments are conserved up to the face.
template <class K>
class Closure {
 public:
  template <int D>
  Closure(const Lattice<D>& lattice, int axis) : nodes_(lattice.nodes()[axis]), periodic_(lattice.periodic(axis)) {}

  std::ptrdiff_t nodes() const { return nodes_; }
  bool periodic() const { return periodic_; }
  bool inside(std::ptrdiff_t i) const { return i >= 0 && i < nodes_; }

  /// Calls f(node, weight) for the nodes that node i (at most one period beyond) stands for.
  template <class F>
  void operator()(std::ptrdiff_t i, F&& f) const {
    if (inside(i)) {
      f(i, 1.0);
    } else if (periodic_) {
      f(i < 0 ? i + nodes_ : i - nodes_, 1.0);
    } else {
      const std::ptrdiff_t outside = i < 0 ? i : nodes_ - 1 - i;
      for (int j = 0; j <= K::moments; ++j) {
        f(i < 0 ? j : nodes_ - 1 - j, extrapolation_weight(static_cast<int>(outside), j, K::moments));
      }
    }
  }

 private:
  std::ptrdiff_t nodes_;
  bool periodic_;
};

/// Rows of a padded plane of interleaved components, closed along axis 0 (and 1 in 3D), written into a plane of the
/// lattice or read from one.
template <class K, class T, int D, int C>
class PlaneCloser {
 public:
  static constexpr std::ptrdiff_t before = Taps<K>::before;

  explicit PlaneCloser(const Lattice<D>& lattice)
      : x_(lattice, 0),
        y_(lattice, D == 3 ? 1 : 0),
        columns_(cells_along<K>(lattice, 0) + K::support - 1),
        stash_(static_cast<std::size_t>(D == 3 ? before * columns_ * C : 0)) {}

  /// Number of values in a plane of the lattice.
  std::size_t plane_size() const { return static_cast<std::size_t>(row_size() * (D == 3 ? y_.nodes() : 1)); }

  /// Tells that padded row r is about to be put: the memory it goes to is fetched meanwhile, as stores do not make the
  /// processor fetch ahead.
  void expect(const T* plane, std::size_t r) const {
    const std::ptrdiff_t y = static_cast<std::ptrdiff_t>(r) - (D == 3 ? before : 0);
    if (y >= 0 && y < (D == 3 ? y_.nodes() : 1)) simd::fetch_for_writing(plane + y * row_size(), row_size());
  }
  /// Takes padded row r of component c, rows coming in ascending order: entry i at line[i].
  void put(T* plane, std::size_t r, int c, const T* line) {
    if constexpr (D == 2) {
      store(plane + c, line);
    } else {
      const std::ptrdiff_t y = static_cast<std::ptrdiff_t>(r) - before;
      if (y < 0) {
        T* kept = stash_.data() + (static_cast<std::ptrdiff_t>(r) * C + c) * columns_;
        std::copy_n(line, columns_, kept);
      } else if (y_.inside(y)) {
        store(plane + y * row_size() + c, line);
      } else {
        y_(y, [&](std::ptrdiff_t to, double w) { add(plane + to * row_size() + c, line, static_cast<T>(w)); });
      }
    }
  }
  /// After the last row of a plane: gives the rows before the first one to those they stand for.
  void finish(T* plane) {
    if constexpr (D == 3) {
      for (std::ptrdiff_t r = 0; r < before; ++r) {
        for (int c = 0; c < C; ++c) {
          const T* kept = stash_.data() + (r * C + c) * columns_;
          y_(r - before,
             [&](std::ptrdiff_t to, double w) { add(plane + to * row_size() + c, kept, static_cast<T>(w)); });
        }
      }
    }
  }

  /// Calls f(row, weight) for the rows of a plane that padded row r stands for.
  template <class F>
  void for_each_row(const T* plane, std::size_t r, F&& f) const {
    if constexpr (D == 2) {
      f(plane, 1.0);
    } else {
      y_(static_cast<std::ptrdiff_t>(r) - before,
         [&](std::ptrdiff_t from, double w) { f(plane + from * row_size(), w); });
    }
  }
  /// Copies component c of a row of the lattice into a padded line: entry i at line[i].
  void get(const T* row, int c, T* line) const {
    const std::ptrdiff_t n = x_.nodes();
    const T* from = row + c;
    for (std::ptrdiff_t i = 0; i < n; ++i) line[i + before] = from[i * C];
    for_each_end([&](std::ptrdiff_t i) {
      T sum(0);
      x_(i, [&](std::ptrdiff_t node, double w) { sum += static_cast<T>(w) * from[node * C]; });
      line[i + before] = sum;
    });
  }
  std::ptrdiff_t row_size() const { return x_.nodes() * C; }

 private:
  void store(T* out, const T* line) const {
    const std::ptrdiff_t n = x_.nodes();
    for (std::ptrdiff_t i = 0; i < n; ++i) out[i * C] = line[i + before];
    add_ends(out, line, T(1));
  }
  void add(T* out, const T* line, T weight) const {
    const std::ptrdiff_t n = x_.nodes();
    for (std::ptrdiff_t i = 0; i < n; ++i) out[i * C] += weight * line[i + before];
    add_ends(out, line, weight);
  }
  void add_ends(T* out, const T* line, T weight) const {
    for_each_end([&](std::ptrdiff_t i) {
      const T value = weight * line[i + before];
      x_(i, [&](std::ptrdiff_t node, double w) { out[node * C] += static_cast<T>(w) * value; });
    });
  }
  /// Calls f for every node of a padded row that is beyond the lattice.
  template <class F>
  void for_each_end(F&& f) const {
    for (std::ptrdiff_t i = -before; i < 0; ++i) f(i);
    for (std::ptrdiff_t i = x_.nodes(); i < columns_ - before; ++i) f(i);
  }

  Closure<K> x_;
  Closure<K> y_;
  std::ptrdiff_t columns_;
  AlignedVector<T> stash_;
};

}  // namespace cambium::detail
