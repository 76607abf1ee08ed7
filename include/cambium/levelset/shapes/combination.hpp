// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// Two shapes put together by a rule, see unite(), intersect(), subtract() and blend(). The result has the signs of the
/// rule and bounds the distance from below; it is not everywhere the distance itself.
template <Shape A, Shape B, class Rule>
class Combination {
 public:
  static_assert(A::dimension == B::dimension, "cambium: only shapes of the same dimension can be combined");
  static constexpr int dimension = A::dimension;
  static constexpr double lipschitz = std::max(A::lipschitz, B::lipschitz);

  Combination(A a, B b, Rule rule) : a_(std::move(a)), b_(std::move(b)), rule_(rule) {}

  double operator()(const Vec<dimension>& x) const { return rule_(a_(x), b_(x)); }
  Box<dimension> bounds() const { return rule_.bounds(a_.bounds(), b_.bounds()); }

 private:
  A a_;
  B b_;
  Rule rule_;
};

namespace detail {

struct Unite {
  double operator()(double a, double b) const { return std::min(a, b); }
  template <int D>
  Box<D> bounds(const Box<D>& a, const Box<D>& b) const {
    return hull(a, b);
  }
};

struct Intersect {
  double operator()(double a, double b) const { return std::max(a, b); }
  template <int D>
  Box<D> bounds(Box<D> a, const Box<D>& b) const {
    for (int d = 0; d < D; ++d) {
      a.lo[d] = std::max(a.lo[d], b.lo[d]);
      a.hi[d] = std::min(a.hi[d], b.hi[d]);
    }
    return a;
  }
};

struct Subtract {
  double operator()(double a, double b) const { return std::max(a, -b); }
  template <int D>
  Box<D> bounds(const Box<D>& a, const Box<D>&) const {
    return a;
  }
};

/// min(a, b) - length / 6 max(1 - |a - b| / length, 0)^3: twice continuously differentiable in a and b, its derivatives
/// by them positive and of sum 1, so that slopes stay bounded by those of a and b.
struct Blend {
  double length;

  double operator()(double a, double b) const {
    const double near = std::max(1.0 - std::abs(a - b) / length, 0.0);
    return std::min(a, b) - length / 6.0 * near * near * near;
  }
  /// Where both are at least length / 6 the blend is not negative.
  template <int D>
  Box<D> bounds(const Box<D>& a, const Box<D>& b) const {
    Box<D> result = hull(a, b);
    result.lo -= Vec<D>::constant(length / 6.0);
    result.hi += Vec<D>::constant(length / 6.0);
    return result;
  }
};

}  // namespace detail

/// Points in any of the shapes.
template <Shape A, Shape B>
auto unite(A a, B b) {
  return Combination<A, B, detail::Unite>(std::move(a), std::move(b), {});
}
template <Shape A, Shape B, Shape... Rest>
auto unite(A a, B b, Rest... rest) {
  return unite(unite(std::move(a), std::move(b)), std::move(rest)...);
}

/// Points in all of the shapes.
template <Shape A, Shape B>
auto intersect(A a, B b) {
  return Combination<A, B, detail::Intersect>(std::move(a), std::move(b), {});
}
template <Shape A, Shape B, Shape... Rest>
auto intersect(A a, B b, Rest... rest) {
  return intersect(intersect(std::move(a), std::move(b)), std::move(rest)...);
}

/// Points in the first shape and not in the second.
template <Shape A, Shape B>
auto subtract(A a, B b) {
  return Combination<A, B, detail::Subtract>(std::move(a), std::move(b), {});
}

/// The union with its creases filled smoothly, over about `length` on either side of them: it holds the union, and goes
/// beyond it only where the values of the two differ by less than `length`. Both should be distances near their
/// surfaces. \throws ValueError unless the length is positive
template <Shape A, Shape B>
auto blend(A a, B b, double length) {
  return Combination<A, B, detail::Blend>(std::move(a), std::move(b),
                                          {detail::positive_length(length, "length of the blend")});
}

}  // namespace cambium
