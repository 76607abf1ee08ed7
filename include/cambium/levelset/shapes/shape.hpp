// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include <cambium/core/box.hpp>
#include <cambium/core/error.hpp>

namespace cambium {

/// A function of the position that says how fast it can change: |f(x)| <= F::lipschitz * (distance from x to the zero
/// set), so that a ball of radius |f(x)| / F::lipschitz around x has no interface in it.
template <class F, int D>
concept BoundedSlope = requires(const F& f, const Vec<D>& x) {
  { f(x) } -> std::convertible_to<double>;
  { F::lipschitz } -> std::convertible_to<double>;
};

/// What a level set can be built from, and what shapes are composed of:
///   double shape(const Vec<D>& x)           negative inside, zero on the surface, defined everywhere
///   static constexpr double lipschitz       bound of its slope; 1 for distances and lower bounds of them
///   static constexpr int dimension          D
///   Box<D> shape.bounds()                   a box that the shape does not leave; faces may be infinite
template <class S>
concept Shape = BoundedSlope<S, S::dimension> && requires(const S& shape) {
  { shape.bounds() } -> std::same_as<Box<S::dimension>>;
};

/// Checks S at compile time, one readable message for each requirement.
template <class S>
constexpr void check_shape() {
  static_assert(
      requires { S::dimension; }, "cambium: a shape says its dimension: static constexpr int dimension");
  static_assert(
      requires { S::lipschitz; },
      "cambium: a shape bounds its slope: static constexpr double lipschitz (1 for a distance)");
  static_assert(Shape<S>, "cambium: a shape is called with a position, shape(x) < 0 inside, and has Box<D> bounds()");
}

namespace detail {

/// \throws ValueError unless `length` is positive and finite; `what` names it
inline double positive_length(double length, const char* what) {
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw ValueError(message(what, " is ", length, ": it must be a positive, finite length"));
  }
  return length;
}

/// \throws ValueError unless all components are finite
template <int D>
const Vec<D>& finite(const Vec<D>& x, const char* what) {
  for (int d = 0; d < D; ++d) {
    if (!std::isfinite(x[d])) throw ValueError(message(what, " is ", x, ": it must be finite"));
  }
  return x;
}

/// x / |x|. \throws ValueError if it has no direction
template <int D>
Vec<D> direction(const Vec<D>& x, const char* what) {
  const double length = norm(finite(x, what));
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw ValueError(message(what, " is ", x, ": it must have a direction"));
  }
  return x / length;
}

template <int D>
Box<D> box_around(const Vec<D>& centre, const Vec<D>& half) {
  return {centre - half, centre + half};
}

template <int D>
Box<D> everywhere() {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return {Vec<D>::constant(-infinite), Vec<D>::constant(infinite)};
}

/// Smallest box around both.
template <int D>
Box<D> hull(Box<D> a, const Box<D>& b) {
  for (int d = 0; d < D; ++d) {
    a.lo[d] = std::fmin(a.lo[d], b.lo[d]);
    a.hi[d] = std::fmax(a.hi[d], b.hi[d]);
  }
  return a;
}

}  // namespace detail

}  // namespace cambium
