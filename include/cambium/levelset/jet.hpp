// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <cambium/core/vec.hpp>
#include <cambium/kernels/taps.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium {

/// Value, gradient and second derivatives of a function at a point, in spacings: hessian[d][e] is symmetric.
template <class T, int D>
struct Jet {
  T value{};
  Vec<D, T> gradient{};
  std::array<Vec<D, T>, D> hessian{};
};

namespace detail {

/// Weights of the taps of kernel K and of their first two derivatives along one axis.
template <class K, class T>
class TapJet {
 public:
  static_assert(Taps<K>::polynomial, "cambium: jets need a kernel that is a polynomial between its break points");
  static constexpr std::size_t lanes = K::support <= 4 ? 4 : K::support <= 8 ? 8 : 16;
  using Lanes = simd::Pack<T, lanes>;

  /// \param g  offset from the middle of the stencil, in spacings
  explicit TapJet(T g) {
    const Lanes at(g);
    Lanes sum[3] = {Lanes(T(0)), Lanes(T(0)), Lanes(T(0))};
    for (int j = Taps<K>::degree; j >= 0; --j) {
      sum[2] = fma(sum[2], at, sum[1]);
      sum[1] = fma(sum[1], at, sum[0]);
      sum[0] = fma(sum[0], at, Lanes::load_aligned(table.value[j].data()));
    }
    for (int m = 0; m < 3; ++m) lanes_[m] = m == 2 ? sum[m] + sum[m] : sum[m];  // Horner leaves f'' / 2
    for (int m = 0; m < 3; ++m) lanes_[m].store_aligned(tap_[m].data());
  }
  /// The taps themselves.
  static Lanes weights(T g) {
    const Lanes at(g);
    Lanes sum(T(0));
    for (int j = Taps<K>::degree; j >= 0; --j) sum = fma(sum, at, Lanes::load_aligned(table.value[j].data()));
    return sum;
  }
  /// All taps of derivative m.
  const Lanes& all(int m) const { return lanes_[m]; }
  T tap(int m, int k) const { return tap_[m][k]; }

 private:
  struct Table {
    alignas(64) std::array<std::array<T, lanes>, Taps<K>::degree + 1> value{};
  };
  static constexpr Table table = [] {
    Table result{};
    for (int j = 0; j <= Taps<K>::degree; ++j) {
      for (int k = 0; k < K::support; ++k) result.value[j][k] = static_cast<T>(Taps<K>::coefficients.value[j][k]);
    }
    return result;
  }();

  Lanes lanes_[3];
  alignas(64) std::array<std::array<T, lanes>, 3> tap_;
};

}  // namespace detail

/// The function that kernel K interpolates from values on a lattice, f(u) = sum_i f_i W(u - i), with its derivatives.
///
/// K reproduces polynomials of degree K::moments, so that derivatives of order m <= K::continuity have order
/// K::moments + 1 - m.
template <class K, class T, int D>
struct Interpolant {
  static_assert(D == 2 || D == 3);
  /// Nodes that a stencil takes before and behind the cell of a point.
  static constexpr std::ptrdiff_t before = Taps<K>::before;
  static constexpr std::ptrdiff_t behind = K::support - 1 - Taps<K>::before;

  /// True if the stencil of point u lies in an array of `edge` nodes along each axis.
  static bool inside(const Index<D>& edge, const Vec<D, T>& u) {
    constexpr auto low = static_cast<T>(before) - static_cast<T>(Taps<K>::shift);
    constexpr auto high = static_cast<T>(behind) + static_cast<T>(Taps<K>::shift);
    bool result = true;
    for (int d = 0; d < D; ++d) result &= u[d] >= low && u[d] < static_cast<T>(edge[d]) - high;
    return result;
  }
  /// Value and derivatives.
  /// \param values  of the lattice with the strides `stride` (stride[0] = 1); readable one vector beyond the stencil
  /// \param u       point in spacings from the first of them
  static Jet<T, D> jet(const T* values, const Index<D>& stride, const Vec<D, T>& u) {
    Vec<D, T> g;
    const std::ptrdiff_t first = locate(stride, u, g);
    const Axis x(g[0]);
    const Axis y(g[1]);
    const Plane plane = [&] {
      if constexpr (D == 2) {
        return plane_of(values + first, stride[1], y);
      } else {
        return plane_of(values + first, stride, y, Axis(g[2]));
      }
    }();
    return contract(plane, x);
  }
  /// Value alone; arguments as for jet().
  static T value(const T* values, const Index<D>& stride, const Vec<D, T>& u) {
    Vec<D, T> g;
    const T* row = values + locate(stride, u, g);
    alignas(64) T tap[D][Axis::lanes];
    for (int d = 0; d < D; ++d) Axis::weights(g[d]).store_aligned(tap[d]);
    Lanes total(T(0));
    for (int k = 0; k < (D == 3 ? K::support : 1); ++k) {
      Lanes plane(T(0));
      for (int j = 0; j < K::support; ++j) {
        plane = fma(Lanes::load(row + k * stride[D - 1] * (D == 3) + j * stride[1]), Lanes(tap[1][j]), plane);
      }
      total = D == 3 ? fma(plane, Lanes(tap[D - 1][k]), total) : plane;
    }
    return sum(total * Lanes::load_aligned(tap[0]));
  }

 private:
  using Axis = detail::TapJet<K, T>;
  using Lanes = typename Axis::Lanes;
  /// sum[m][l]: derivative m along axis 1 and l along axis 2, m + l <= 2.
  struct Plane {
    Lanes sum[3][3];
  };

  /// Offsets of u from the middle of its stencil. \return entry of the first node of the stencil
  static std::ptrdiff_t locate(const Index<D>& stride, const Vec<D, T>& u, Vec<D, T>& g) {
    std::ptrdiff_t first = 0;
    for (int d = 0; d < D; ++d) {
      const T shifted = u[d] + static_cast<T>(Taps<K>::shift);
      const T cell = std::floor(shifted);
      g[d] = shifted - cell - T(0.5);
      first += (static_cast<std::ptrdiff_t>(cell) - before) * stride[d];
    }
    return first;
  }
  static Plane plane_of(const T* row, std::ptrdiff_t pitch, const Axis& y) {
    Plane plane;
    for (int m = 0; m < 3; ++m) plane.sum[m][0] = Lanes(T(0));
    for (int j = 0; j < K::support; ++j) {
      const Lanes values = Lanes::load(row + j * pitch);
      for (int m = 0; m < 3; ++m) plane.sum[m][0] = fma(values, Lanes(y.tap(m, j)), plane.sum[m][0]);
    }
    return plane;
  }
  static Plane plane_of(const T* first, const Index<D>& stride, const Axis& y, const Axis& z) {
    Plane plane;
    for (auto& sums : plane.sum) {
      for (auto& sum : sums) sum = Lanes(T(0));
    }
    for (int j = 0; j < K::support; ++j) {
      const T* row = first + j * stride[1];
      Lanes along[3] = {Lanes(T(0)), Lanes(T(0)), Lanes(T(0))};
      for (int k = 0; k < K::support; ++k, row += stride[D - 1]) {
        const Lanes values = Lanes::load(row);
        for (int l = 0; l < 3; ++l) along[l] = fma(values, Lanes(z.tap(l, k)), along[l]);
      }
      for (int m = 0; m < 3; ++m) {
        const Lanes weight(y.tap(m, j));
        for (int l = 0; m + l < 3; ++l) plane.sum[m][l] = fma(along[l], weight, plane.sum[m][l]);
      }
    }
    return plane;
  }
  static Jet<T, D> contract(const Plane& plane, const Axis& x) {
    const auto at = [&](int n, int m, int l) { return sum(x.all(n) * plane.sum[m][l]); };
    Jet<T, D> jet;
    jet.value = at(0, 0, 0);
    jet.gradient[0] = at(1, 0, 0);
    jet.gradient[1] = at(0, 1, 0);
    jet.hessian[0][0] = at(2, 0, 0);
    jet.hessian[0][1] = jet.hessian[1][0] = at(1, 1, 0);
    jet.hessian[1][1] = at(0, 2, 0);
    if constexpr (D == 3) {
      jet.gradient[2] = at(0, 0, 1);
      jet.hessian[0][2] = jet.hessian[2][0] = at(1, 0, 1);
      jet.hessian[1][2] = jet.hessian[2][1] = at(0, 1, 1);
      jet.hessian[2][2] = at(0, 0, 2);
    }
    return jet;
  }
};

}  // namespace cambium
