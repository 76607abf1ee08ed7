// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>

#include <cambium/simd/pack.hpp>

namespace cambium {

namespace detail {

template <class V>
struct LaneType {
  using type = V;
};
template <class T, std::size_t N>
struct LaneType<simd::Pack<T, N>> {
  using type = T;
};

/// A number in the type of V, all lanes of it if V is a pack.
template <class V>
V constant(double value) {
  return V(static_cast<typename LaneType<V>::type>(value));
}

/// The one of smaller size if both have the same sign, else 0.
template <class V>
V minmod(const V& a, const V& b) {
  using std::max;
  using std::min;
  const V zero = constant<V>(0.0);
  return max(zero, min(a, b)) + min(zero, max(a, b));
}

}  // namespace detail

/// One-sided derivatives of the kind that Hamilton-Jacobi equations need. A scheme S has
///   S::order                       of the derivative where the function is smooth
///   S::reach                       nodes that it takes on either side
///   S::one_sided(d, step)          the derivative in spacings from 2 reach - 1 differences of neighbouring nodes,
///                                  d[0], d[step], ..., numbers or packs of them
/// With d[k] = f[i - reach + k + 1] - f[i - reach + k], one_sided(d, 1) is biased to the left of node i and
/// one_sided(d + 2 reach - 1, -1) to its right.
struct Upwind1 {
  static constexpr int order = 1;
  static constexpr std::ptrdiff_t reach = 1;

  template <class V>
  static V one_sided(const V* d, std::ptrdiff_t) {
    return d[0];
  }
};

/// Essentially non-oscillatory, second order: of the two second differences the smaller (Shu & Osher 1989).
struct ENO2 {
  static constexpr int order = 2;
  static constexpr std::ptrdiff_t reach = 2;

  template <class V>
  static V one_sided(const V* d, std::ptrdiff_t step) {
    return d[step] + detail::constant<V>(0.5) * detail::minmod(d[step] - d[0], d[2 * step] - d[step]);
  }
};

/// Weighted essentially non-oscillatory, third order (Jiang & Peng 2000, section 2.1).
struct WENO3 {
  static constexpr int order = 3;
  static constexpr std::ptrdiff_t reach = 2;

  template <class V>
  static V one_sided(const V* d, std::ptrdiff_t step) {
    using std::max;
    const V &a = d[0], &b = d[step], &c = d[2 * step];
    const V behind = b - a;
    const V ahead = c - b;
    // Differences may have any scale: smoothness is relative to the largest of them.
    const V largest = max(a * a, max(b * b, c * c));
    const V scale = detail::constant<V>(1.0) / (largest + detail::constant<V>(1e-30));
    const V rough_behind = behind * behind * scale + detail::constant<V>(1e-6);
    const V rough_ahead = ahead * ahead * scale + detail::constant<V>(1e-6);
    const V square_ahead = rough_ahead * rough_ahead;
    const V weight = square_ahead / (square_ahead + detail::constant<V>(2.0) * rough_behind * rough_behind);
    return detail::constant<V>(0.5) * (b + c - weight * (ahead - behind));
  }
};

/// Weighted essentially non-oscillatory, fifth order (Jiang & Peng 2000, eq. 2.11-2.13).
struct WENO5 {
  static constexpr int order = 5;
  static constexpr std::ptrdiff_t reach = 3;

  template <class V>
  static V one_sided(const V* d, std::ptrdiff_t step) {
    using std::max;
    const auto number = [](double value) { return detail::constant<V>(value); };
    const V &a = d[0], &b = d[step], &c = d[2 * step], &e = d[3 * step], &f = d[4 * step];
    const auto smoothness = [&](const V& second, const V& first) {
      return number(13.0 / 12.0) * second * second + number(0.25) * first * first;
    };
    // NodeDifferences may have any scale: smoothness is relative to the largest of them.
    const V largest = max(max(a * a, b * b), max(c * c, max(e * e, f * f)));
    const V scale = number(1.0) / (largest + number(1e-30));
    const auto square = [&](const V& s) {
      const V relative = s * scale + number(1e-6);
      return relative * relative;
    };
    const V left = square(smoothness(a - number(2.0) * b + c, a - number(4.0) * b + number(3.0) * c));
    const V middle = square(smoothness(b - number(2.0) * c + e, b - e));
    const V right = square(smoothness(c - number(2.0) * e + f, number(3.0) * c - number(4.0) * e + f));
    const V w_left = number(0.1) * middle * right;
    const V w_middle = number(0.6) * left * right;
    const V w_right = number(0.3) * left * middle;
    const V sum = w_left * (number(2.0) * a - number(7.0) * b + number(11.0) * c) +
                  w_middle * (number(5.0) * c - b + number(2.0) * e) +
                  w_right * (number(2.0) * c + number(5.0) * e - f);
    return sum / (number(6.0) * (w_left + w_middle + w_right));
  }
};

namespace detail {

/// NodeDifferences of neighbouring nodes around a node, along one axis.
template <class Scheme, class V>
class NodeDifferences {
 public:
  static constexpr std::ptrdiff_t count = 2 * Scheme::reach;

  /// \param value  value(k) is f at the node k steps away
  template <std::invocable<std::ptrdiff_t> F>
  explicit NodeDifferences(const F& value) {
    V last = value(-Scheme::reach);
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      const V next = value(k + 1 - Scheme::reach);
      d_[k] = next - last;
      last = next;
    }
  }
  V left() const { return Scheme::one_sided(d_, 1); }
  V right() const { return Scheme::one_sided(d_ + count - 1, -1); }
  /// The left derivative in the lanes where `from_left` is 1, the right one where it is 0.
  V upwind(const V& from_left) const {
    V d[count - 1];
    for (std::ptrdiff_t k = 0; k + 1 < count; ++k) {
      d[k] = where_equal(from_left, constant<V>(1.0), d_[k], d_[count - 1 - k]);
    }
    return Scheme::one_sided(d, 1);
  }

 private:
  V d_[count];
};

/// Nodes of a row of a block that are worked on together.
inline constexpr std::size_t row_lanes = 8;

/// f at N nodes in a row, one after another along axis 0, and at their neighbours along one axis.
template <class Scheme, std::size_t N, class T>
NodeDifferences<Scheme, simd::Pack<T, N>> row_differences(const T* at, std::ptrdiff_t stride) {
  return NodeDifferences<Scheme, simd::Pack<T, N>>(
      [&](std::ptrdiff_t k) { return simd::Pack<T, N>::load(at + k * stride); });
}
template <class Scheme, class T>
NodeDifferences<Scheme, T> node_differences(const T* at, std::ptrdiff_t stride) {
  return NodeDifferences<Scheme, T>([&](std::ptrdiff_t k) { return at[k * stride]; });
}

/// The square of the part of a one-sided derivative pair that brings information from the zero set (Godunov 1959; Rouy
/// & Tourin 1992); `sign` of phi at the node: 1, -1, or 0 for none.
template <class V>
V godunov_square(const V& left, const V& right, const V& sign) {
  using std::max;
  const V steepest = max(constant<V>(0.0), max(sign * left, constant<V>(0.0) - sign * right));
  return steepest * steepest;
}

}  // namespace detail

}  // namespace cambium
