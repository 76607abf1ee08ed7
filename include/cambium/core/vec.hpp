// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <ostream>
#include <type_traits>

namespace cambium {

/// A small vector of D components; an aggregate, so `Vec<2>{1.0, 2.0}` and constexpr use work.
template <int D, class T = double>
struct Vec {
  static_assert(D >= 1, "cambium::Vec: the dimension must be at least 1");
  using value_type = T;
  static constexpr int dimension = D;

  T component[D]{};

  constexpr T& operator[](int d) { return component[d]; }
  constexpr const T& operator[](int d) const { return component[d]; }

  /// The vector whose components are all `value`.
  static constexpr Vec constant(T value) {
    Vec result;
    for (int d = 0; d < D; ++d) result[d] = value;
    return result;
  }
  /// The vector along `axis` with length `length`.
  static constexpr Vec unit(int axis, T length = T(1)) {
    Vec result;
    result[axis] = length;
    return result;
  }

  constexpr Vec& operator+=(const Vec& other) {
    for (int d = 0; d < D; ++d) component[d] += other[d];
    return *this;
  }
  constexpr Vec& operator-=(const Vec& other) {
    for (int d = 0; d < D; ++d) component[d] -= other[d];
    return *this;
  }
  constexpr Vec& operator*=(T factor) {
    for (int d = 0; d < D; ++d) component[d] *= factor;
    return *this;
  }
  constexpr Vec& operator/=(T divisor) {
    for (int d = 0; d < D; ++d) component[d] /= divisor;
    return *this;
  }

  friend constexpr Vec operator+(Vec a, const Vec& b) { return a += b; }
  friend constexpr Vec operator-(Vec a, const Vec& b) { return a -= b; }
  friend constexpr Vec operator-(Vec a) { return a *= T(-1); }
  friend constexpr Vec operator*(Vec a, T factor) { return a *= factor; }
  friend constexpr Vec operator*(T factor, Vec a) { return a *= factor; }
  friend constexpr Vec operator/(Vec a, T divisor) { return a /= divisor; }
  friend constexpr bool operator==(const Vec&, const Vec&) = default;

  friend std::ostream& operator<<(std::ostream& out, const Vec& v) {
    out << '(';
    for (int d = 0; d < D; ++d) out << (d ? ", " : "") << v[d];
    return out << ')';
  }
};

/// Integer coordinates of a node, cell or block.
template <int D>
using Index = Vec<D, std::ptrdiff_t>;

template <int D, class T>
constexpr T dot(const Vec<D, T>& a, const Vec<D, T>& b) {
  T sum{};
  for (int d = 0; d < D; ++d) sum += a[d] * b[d];
  return sum;
}

template <class T>
constexpr Vec<3, T> cross(const Vec<3, T>& a, const Vec<3, T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <int D, class T>
T norm(const Vec<D, T>& a) {
  return std::sqrt(dot(a, a));
}

/// Product of all components: volume of an extent, number of nodes of a shape.
template <int D, class T>
constexpr T product(const Vec<D, T>& a) {
  T result(1);
  for (int d = 0; d < D; ++d) result *= a[d];
  return result;
}

template <class V>
inline constexpr bool is_vec = false;
template <int D, class T>
inline constexpr bool is_vec<Vec<D, T>> = true;

/// Scalar type and number of components of a field or attribute value: T itself, or Vec<C, T>.
template <class V>
struct Components {
  static_assert(std::is_arithmetic_v<V>, "cambium: a value is a float, a double, an integer, or a Vec of them");
  using Scalar = V;
  static constexpr int count = 1;
};
template <int C, class T>
struct Components<Vec<C, T>> {
  using Scalar = T;
  static constexpr int count = C;
};

template <class V>
using ScalarOf = typename Components<V>::Scalar;

/// Component `c` of a scalar or vector value.
template <class V>
constexpr auto& component(V& value, int c) {
  if constexpr (is_vec<std::remove_const_t<V>>) {
    return value[c];
  } else {
    (void)c;
    return value;
  }
}

}  // namespace cambium
