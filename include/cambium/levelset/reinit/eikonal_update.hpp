// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace cambium::detail {

/// Upwind difference along one axis: coefficient (u - origin)^2 stands for the square of the derivative (spacing 1).
template <class T>
struct EikonalAxis {
  T first;        ///< value of the neighbour: the axis counts only if u is above it. Infinite if there is none
  T origin;       ///< the same for a difference of first order, (4 first - second) / 3 for one of second order
  T coefficient;  ///< 1 or 9/4

  /// Of second order if the second neighbour is known (not NaN) and not above the first.
  static EikonalAxis upwind(T first, T second) {
    const bool second_order = second <= first;
    return {first, second_order ? first + (first - second) * T(1.0 / 3.0) : first, second_order ? T(2.25) : T(1)};
  }
};

/// sum of coefficient (u - origin)^2 - 1 = a (u - base)^2 - 2 b (u - base) + c, the axes added one by one.
template <class T>
struct EikonalSum {
  T base{};  ///< any value near the origins, to keep rounding small
  T a{};
  T b{};
  T c = T(-1);

  void add(const EikonalAxis<T>& axis) {
    const T origin = axis.origin - base;
    const T weighted = axis.coefficient * origin;
    a += axis.coefficient;
    b += weighted;
    c += weighted * origin;
  }
  /// Larger u where the sum is 0; NaN if there is none.
  T root() const { return base + (b + std::sqrt(b * b - a * c)) / a; }
};

/// Square root of what is positive or not needed: a negative argument would cost a call.
template <class T>
T root_of(T square) {
  return std::sqrt(square > T(0) ? square : T(0));
}

/// The value u >= first of all axes that count, with the sum over these = 1 (Godunov's scheme). Axes are taken in
/// ascending order; a difference of second order without such a solution is replaced by that of first order.
template <class T, std::size_t D>
T solve_eikonal(std::array<EikonalAxis<T>, D>& axes) {
  for (std::size_t k = 1; k < D; ++k) {
    for (std::size_t j = k; j > 0 && axes[j].first < axes[j - 1].first; --j) std::swap(axes[j], axes[j - 1]);
  }
  EikonalSum<T> sum{axes[0].first};
  sum.add(axes[0]);
  T u = sum.root();
  for (std::size_t k = 1; k < D && u > axes[k].first; ++k) {
    EikonalSum<T> with = sum;
    with.add(axes[k]);
    if (!(with.root() >= axes[k].first)) {
      with = sum;
      with.add({axes[k].first, axes[k].first, T(1)});
      if (!(with.root() >= axes[k].first)) break;
    }
    sum = with;
    u = sum.root();
  }
  return u;
}

/// The same for differences of first order, from the values of the neighbours in any order (infinite if there is none);
/// without branches, as iterations that visit nodes again and again want it.
template <class T, std::size_t D>
T solve_eikonal_first_order(std::array<T, D> a) {
  static_assert(D == 2 || D == 3);
  const auto sort = [](T& p, T& q) {
    const T low = p < q ? p : q;
    q = p < q ? q : p;
    p = low;
  };
  sort(a[0], a[1]);
  if constexpr (D == 3) {
    sort(a[1], a[2]);
    sort(a[0], a[1]);
  }
  const T second = a[1] - a[0];
  const T u = second < T(1) ? T(0.5) * (second + root_of(T(2) - second * second)) : T(1);
  if constexpr (D == 2) return a[0] + u;
  const T third = a[D - 1] - a[0];
  const T sum = second + third;
  const T square = sum * sum - T(3) * (second * second + third * third - T(1));
  return a[0] + (third < u ? (sum + root_of(square)) * static_cast<T>(1.0 / 3.0) : u);
}

}  // namespace cambium::detail
