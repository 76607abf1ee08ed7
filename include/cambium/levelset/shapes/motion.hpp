// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include <cambium/core/domain.hpp>
#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// A shape turned about the origin and then shifted, see translate() and rotate(). Distances stay distances.
template <Shape S>
class Moved {
 public:
  static constexpr int dimension = S::dimension;
  static constexpr double lipschitz = S::lipschitz;
  using Position = Vec<dimension>;
  /// Columns of a rotation.
  using Axes = std::array<Position, static_cast<std::size_t>(dimension)>;

  Moved(S shape, const Axes& axes, const Position& shift) : shape_(std::move(shape)), axes_(axes), shift_(shift) {}

  double operator()(const Position& x) const {
    const Position moved = x - shift_;
    Position back;
    for (int d = 0; d < dimension; ++d) back[d] = dot(axes_[d], moved);
    return shape_(back);
  }
  Box<dimension> bounds() const {
    const Box<dimension> own = shape_.bounds();
    Box<dimension> result{shift_, shift_};
    for (int d = 0; d < dimension; ++d) {
      for (int e = 0; e < dimension; ++e) {
        if (axes_[d][e] == 0.0) continue;  // may be an infinite face
        const double a = axes_[d][e] * own.lo[d];
        const double b = axes_[d][e] * own.hi[d];
        result.lo[e] += std::fmin(a, b);
        result.hi[e] += std::fmax(a, b);
      }
    }
    return result;
  }

 private:
  S shape_;
  Axes axes_;
  Position shift_;
};

/// The shape moved by `shift`. \throws ValueError if that is not finite
template <Shape S>
auto translate(S shape, const Vec<S::dimension>& shift) {
  typename Moved<S>::Axes axes;
  for (int d = 0; d < S::dimension; ++d) axes[d] = Vec<S::dimension>::unit(d);
  return Moved<S>(std::move(shape), axes, detail::finite(shift, "shift of the shape"));
}

/// The shape turned by `angle` (radians, counter-clockwise) about `centre`. \throws ValueError if these are not finite
template <Shape S>
auto rotate(S shape, double angle, const Vec<2>& centre) requires(S::dimension == 2) {
  detail::finite(Vec<1>{angle}, "angle of the rotation");
  const Vec<2> a{std::cos(angle), std::sin(angle)};
  const Vec<2> b{-a[1], a[0]};
  const Vec<2> shift = detail::finite(centre, "centre of the rotation") - centre[0] * a - centre[1] * b;
  return Moved<S>(std::move(shape), {a, b}, shift);
}

/// The shape turned by `angle` (radians, right-handed) about the line through `centre` along `axis`.
/// \throws ValueError if the axis has no direction or something is not finite
template <Shape S>
auto rotate(S shape, const Vec<3>& axis, double angle, const Vec<3>& centre) requires(S::dimension == 3) {
  detail::finite(Vec<1>{angle}, "angle of the rotation");
  const Vec<3> n = detail::direction(axis, "axis of the rotation");
  const double c = std::cos(angle), s = std::sin(angle);
  std::array<Vec<3>, 3> axes;
  Vec<3> shift = detail::finite(centre, "centre of the rotation");
  for (int d = 0; d < 3; ++d) {  // Rodrigues' formula for the image of axis d
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    axes[d] = (1.0 - c) * n[d] * n;
    axes[d][d] += c;
    axes[d][e] += s * n[f];
    axes[d][f] -= s * n[e];
    shift -= centre[d] * axes[d];
  }
  return Moved<S>(std::move(shape), axes, shift);
}

/// A shape and its images in a domain with periodic axes, see repeat().
template <Shape S>
class Repeated {
 public:
  static constexpr int dimension = S::dimension;
  static constexpr double lipschitz = S::lipschitz;

  Repeated(S shape, const Domain<S::dimension>& domain) : shape_(std::move(shape)), domain_(domain) {}

  double operator()(const Vec<dimension>& x) const { return nearest(domain_.wrap(x), 0); }
  Box<dimension> bounds() const {
    Box<dimension> result = shape_.bounds();
    for (int d = 0; d < dimension; ++d) {
      if (!domain_.periodic[d]) continue;
      result.lo[d] = detail::everywhere<dimension>().lo[d];
      result.hi[d] = detail::everywhere<dimension>().hi[d];
    }
    return result;
  }

 private:
  double nearest(const Vec<dimension>& x, int axis) const {
    if (axis == dimension) return shape_(x);
    double result = nearest(x, axis + 1);
    if (!domain_.periodic[axis]) return result;
    const double period = domain_.box.hi[axis] - domain_.box.lo[axis];
    for (const double way : {-period, period}) {
      result = std::fmin(result, nearest(x + Vec<dimension>::unit(axis, way), axis + 1));
    }
    return result;
  }

  S shape_;
  Domain<S::dimension> domain_;
};

/// The shape with its nearest images across the periodic faces of a domain, one either way along every periodic axis:
/// for shapes that cross such a face. What of the shape is further than a period beyond the box is not seen.
template <Shape S>
auto repeat(S shape, const Domain<S::dimension>& domain) {
  return Repeated<S>(std::move(shape), domain);
}

}  // namespace cambium
