// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/edge_coupling.hpp>
#include <cambium/poisson/even_convolution.hpp>

namespace cambium::detail {

/// Potential that charges on the faces of a box make on all its faces, in space: between parallel faces by convolution
/// in the plane, one with the sum and one with the difference of the kernel at distances 0 and N; between others by
/// EdgeCoupling.
template <class T, Execution E>
class BoundaryPotential {
 public:
  /// \param kernel  K at offsets 0, ..., cells along each axis, axis 0 fastest
  BoundaryPotential(const Index<3>& cells, const AlignedVector<double>& kernel, const E& execution) {
    for (int d = 0; d < 3; ++d) {
      const int p = d == 0 ? 1 : 0, q = d == 2 ? 1 : 2;
      const auto across = slice(cells, kernel, d);
      for (int side = 0; side < 2; ++side) {
        parallel_.emplace_back(Index<2>{cells[p], cells[q]}, across[static_cast<std::size_t>(side)], execution);
      }
    }
    std::vector<std::pair<Index<3>, std::vector<typename EdgeCoupling<T, E>::Pair>>> groups;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        if (a == b) continue;
        const Index<3> lengths{cells[a], cells[b], cells[3 - a - b]};
        auto group = groups.begin();
        while (group != groups.end() && !(group->first == lengths)) ++group;
        if (group == groups.end()) group = groups.insert(group, {lengths, {}});
        group->second.push_back({a, b});
      }
    }
    for (const auto& [lengths, pairs] : groups) coupling_.emplace_back(cells, pairs, kernel, execution);
  }

  /// potentials := what the charges make at every node of the faces.
  void operator()(Faces<T>& charges, Faces<T>& potentials) {
    for (std::size_t d = 0; d < 3; ++d) {
      Face<T>&low = charges[d][0], &high = charges[d][1];
      Face<T>&u_low = potentials[d][0], &u_high = potentials[d][1];
      const std::size_t width = low.width;
      parallel_[2 * d](
          [&](std::size_t q, std::size_t, T* x) {
            for (std::size_t p = 0; p < width; ++p) x[p] = *low.at(p, q) + *high.at(p, q);
          },
          [&](std::size_t q, std::size_t, const T* x) { std::copy_n(x, width, u_low.at(0, q)); });
      parallel_[2 * d + 1](
          [&](std::size_t q, std::size_t, T* x) {
            for (std::size_t p = 0; p < width; ++p) x[p] = *low.at(p, q) - *high.at(p, q);
          },
          [&](std::size_t q, std::size_t, const T* x) {
            for (std::size_t p = 0; p < width; ++p) {
              const T sum = *u_low.at(p, q);
              *u_low.at(p, q) = sum + x[p];
              *u_high.at(p, q) = sum - x[p];
            }
          });
    }
    for (auto& coupling : coupling_) coupling.add(charges, potentials);
  }

 private:
  /// Halves of the sum and of the difference of the kernel at distances 0 and N along axis d.
  static std::array<AlignedVector<double>, 2> slice(const Index<3>& cells, const AlignedVector<double>& kernel, int d) {
    std::array<AlignedVector<double>, 2> result;
    Index<3> count = cells + Index<3>::constant(1);
    const Index<3> pitch{1, count[0], count[0] * count[1]};
    count[d] = 1;
    for (std::ptrdiff_t i = 0; i < product(count); ++i) {
      const Index<3> n{i % count[0], i / count[0] % count[1], i / (count[0] * count[1])};
      const double near = kernel[static_cast<std::size_t>(dot(n, pitch))];
      const double far = kernel[static_cast<std::size_t>(dot(n, pitch) + cells[d] * pitch[d])];
      result[0].push_back(0.5 * (near + far));
      result[1].push_back(0.5 * (near - far));
    }
    return result;
  }

  std::vector<EvenConvolution<2, T, E>> parallel_;
  std::vector<EdgeCoupling<T, E>> coupling_;
};

}  // namespace cambium::detail
