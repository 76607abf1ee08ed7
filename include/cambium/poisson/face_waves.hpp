// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/box_transform.hpp>
#include <cambium/poisson/second_order.hpp>

namespace cambium::detail {

template <int N>
std::array<Boundary, N> all_dirichlet() {
  std::array<Boundary, N> result;
  result.fill(Boundary::dirichlet);
  return result;
}

/// What the waves of a box with zero values and its faces do to each other in FreeSpacePoisson: the solution leaves
/// charges at the faces, and values on the faces change the solution. Both as waves, along the faces and in the box.
template <class T, Execution E>
class FaceWaves {
 public:
  using Box3 = BoxTransform<3, T, E>;
  using Box2 = BoxTransform<2, T, E>;

  FaceWaves(const Index<3>& cells, const Box3& box, const E& execution)
      : execution_(execution), sizes_(box.sizes()), pitch_(box.pitch(2)) {
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      const auto size = static_cast<std::size_t>(sizes_[d]);
      for (std::size_t k = 0; k < size; ++k) {
        const double theta = box.line(d).phase(k);
        symbol_[axis].push_back(static_cast<T>(SecondOrder::second(theta)));
        beside_[axis][0].push_back(static_cast<T>(std::sin(theta)));
        beside_[axis][1].push_back(static_cast<T>(k % 2 == 0 ? std::sin(theta) : -std::sin(theta)));
      }
      while (symbol_[axis].size() % lines != 0) {
        symbol_[axis].push_back(T(1));
        for (auto& table : beside_[axis]) table.push_back(T(0));
      }
      const Index<2> sides{cells[d == 0 ? 1 : 0], cells[d == 2 ? 1 : 2]};
      for (int side = 0; side < 2; ++side) face_.emplace_back(all_dirichlet<2>(), sides, execution);
    }
    const std::size_t blocks = symbol_[0].size() / lines;
    partial_.resize(blocks * 2 * static_cast<std::size_t>(sizes_[1] * sizes_[2]));
  }

  /// The waves along a face across axis d.
  Box2& face(int d, int side) { return face_[static_cast<std::size_t>(2 * d + side)]; }
  /// Before leave_charges() of a new solution.
  void clear() {
    for (int d = 1; d < 3; ++d) {
      for (int side = 0; side < 2; ++side) face(d, side).clear();
    }
  }

  /// Divides by the symbol and sums up what the waves make next to the faces, as waves along these.
  void leave_charges(const Index<3>& m, T* waves) {
    const auto j = static_cast<std::size_t>(m[1]);
    const auto block = static_cast<std::size_t>(m[0]) / lines;
    const auto planes = static_cast<std::size_t>(sizes_[2]);
    T* const partial = partial_.data() + 2 * planes * (block * static_cast<std::size_t>(sizes_[1]) + j);
    const std::array<Lanes, 2> along{Lanes(*beside(1, 0, m[1])), Lanes(*beside(1, 1, m[1]))};
    Lanes sums[2][2], symbol[2], weight[2][2];
    for (std::size_t half = 0; half < 2; ++half) {
      const auto i = m[0] + static_cast<std::ptrdiff_t>(half * width);
      symbol[half] = Lanes::load_aligned(symbol_[0].data() + i) + Lanes(symbol_[1][j]);
      for (int side = 0; side < 2; ++side) {
        weight[side][half] = Lanes::load_aligned(beside(0, side, i));
        sums[side][half] = Lanes(T(0));
      }
    }
    for (std::size_t k = 0; k < planes; ++k) {
      T* const row = waves + k * pitch_;
      Lanes x[2];
      for (std::size_t half = 0; half < 2; ++half) {
        x[half] = Lanes::load_aligned(row + half * width) / (symbol[half] + Lanes(symbol_[2][k]));
        x[half].store_aligned(row + half * width);
      }
      for (int side = 0; side < 2; ++side) {
        partial[2 * k + static_cast<std::size_t>(side)] = sum(fma(weight[side][0], x[0], weight[side][1] * x[1]));
        T* const across_1 = face(1, side).at({m[0], static_cast<std::ptrdiff_t>(k)});
        const Lanes factor(*beside(2, side, static_cast<std::ptrdiff_t>(k)));
        for (std::size_t half = 0; half < 2; ++half) {
          sums[side][half] = fma(factor, x[half], sums[side][half]);
          fma(along[static_cast<std::size_t>(side)], x[half], Lanes::load_aligned(across_1 + half * width))
              .store_aligned(across_1 + half * width);
        }
      }
    }
    for (int side = 0; side < 2; ++side) {
      T* const across_2 = face(2, side).at({m[0], m[1]});
      for (std::size_t half = 0; half < 2; ++half) sums[side][half].store_aligned(across_2 + half * width);
    }
  }
  /// The charges across axis 0 are sums over tiles, in their order.
  void add_partial_charges() {
    const auto rows = static_cast<std::size_t>(sizes_[1]), planes = static_cast<std::size_t>(sizes_[2]);
    const std::size_t blocks = symbol_[0].size() / lines;
    for_each_piece(execution_, planes, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t k = begin; k < end; ++k) {
          for (int side = 0; side < 2; ++side) {
            T sum = T(0);
            for (std::size_t block = 0; block < blocks; ++block) {
              sum += partial_[2 * (planes * (block * rows + j) + k) + static_cast<std::size_t>(side)];
            }
            *face(0, side).at({static_cast<std::ptrdiff_t>(j), static_cast<std::ptrdiff_t>(k)}) = sum;
          }
        }
      }
    });
  }

  /// Adds the solution whose values on the faces are given and whose differences vanish.
  void add_values(const Index<3>& m, T* waves) {
    const auto j = static_cast<std::size_t>(m[1]);
    Lanes symbol[2], across_0[2][2], across_2[2][2];
    for (std::size_t half = 0; half < 2; ++half) {
      const auto i = m[0] + static_cast<std::ptrdiff_t>(half * width);
      symbol[half] = Lanes::load_aligned(symbol_[0].data() + i) + Lanes(symbol_[1][j]);
      for (int side = 0; side < 2; ++side) {
        across_0[side][half] = Lanes::load_aligned(beside(0, side, i));
        across_2[side][half] = Lanes::load_aligned(face(2, side).at({i, m[1]}));
      }
    }
    const std::array<Lanes, 2> along{Lanes(*beside(1, 0, m[1])), Lanes(*beside(1, 1, m[1]))};
    for (std::ptrdiff_t k = 0; k < sizes_[2]; ++k) {
      T* const row = waves + static_cast<std::size_t>(k) * pitch_;
      for (std::size_t half = 0; half < 2; ++half) {
        Lanes sum(T(0));
        for (int side = 0; side < 2; ++side) {
          const T* const across_1 = face(1, side).at({m[0], k}) + half * width;
          sum = fma(across_0[side][half], Lanes(*face(0, side).at({m[1], k})), sum);
          sum = fma(along[static_cast<std::size_t>(side)], Lanes::load_aligned(across_1), sum);
          sum = fma(Lanes(*beside(2, side, k)), across_2[side][half], sum);
        }
        const Lanes x = Lanes::load_aligned(row + half * width);
        const Lanes denominator = symbol[half] + Lanes(symbol_[2][static_cast<std::size_t>(k)]);
        (x + sum / denominator).store_aligned(row + half * width);
      }
    }
  }

 private:
  using Lanes = typename Box3::Line::Lanes;
  static constexpr std::size_t lines = Box3::lines;
  static constexpr std::size_t width = Box3::Line::width;

  const T* beside(int d, int side, std::ptrdiff_t k) const {
    return beside_[static_cast<std::size_t>(d)][static_cast<std::size_t>(side)].data() + k;
  }

  E execution_;
  Index<3> sizes_;
  std::size_t pitch_;
  std::vector<Box2> face_;
  std::array<AlignedVector<T>, 3> symbol_;
  std::array<std::array<AlignedVector<T>, 2>, 3> beside_;
  AlignedVector<T> partial_;
};

}  // namespace cambium::detail
