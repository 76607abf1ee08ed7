// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <utility>

#include <cambium/core/aligned.hpp>
#include <cambium/core/lattice.hpp>

namespace cambium {

/// A number for every node on each of the 2 D faces of a lattice: outward derivatives for Neumann conditions, say. A
/// node on an edge has one number for each of its faces.
template <int D, class T = double>
class FaceValues {
 public:
  explicit FaceValues(const Lattice<D>& lattice, T value = T(0)) : lattice_(lattice) {
    for (int d = 0; d < D; ++d) {
      for (auto& face : faces_[d]) face.assign(lattice.size() / static_cast<std::size_t>(lattice.nodes()[d]), value);
    }
  }

  const Lattice<D>& lattice() const { return lattice_; }

  /// The number of `node` on the lower (side 0) or upper (side 1) face across `axis`; node[axis] is not looked at.
  T& operator()(int axis, int side, const Index<D>& node) { return faces_[axis][side][number(axis, node)]; }
  const T& operator()(int axis, int side, const Index<D>& node) const { return faces_[axis][side][number(axis, node)]; }

  /// Sets every number to f(axis, side, position of the node); the outward normal is -1 (side 0) or 1 along the axis.
  template <class F>
  FaceValues& sample(F&& f) {
    for (int axis = 0; axis < D; ++axis) {
      for (int side = 0; side < 2; ++side) {
        Index<D> end = lattice_.nodes();
        end[axis] = 1;
        for (std::ptrdiff_t i = 0; i < product(end); ++i) {
          Index<D> node;
          for (auto [d, rest] = std::pair{0, i}; d < D; rest /= end[d], ++d) node[d] = rest % end[d];
          if (side == 1) node[axis] = lattice_.nodes()[axis] - 1;
          (*this)(axis, side, node) = f(axis, side, lattice_.position(node));
        }
      }
    }
    return *this;
  }

 private:
  std::size_t number(int axis, const Index<D>& node) const {
    std::ptrdiff_t n = 0;
    for (int d = D - 1; d >= 0; --d) n = d == axis ? n : n * lattice_.nodes()[d] + node[d];
    return static_cast<std::size_t>(n);
  }

  Lattice<D> lattice_;
  std::array<std::array<AlignedVector<T>, 2>, D> faces_;
};

}  // namespace cambium
