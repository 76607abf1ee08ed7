// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include <cambium/core/vec.hpp>

namespace cambium {

/// What a jump correction puts on a leg of a stencil that the interface crosses:
///   R::at_node(phi, kappa, a, b, l, s)     the jump continued to a node at signed distance phi, from what there is at
///   its
///                                          closest point: curvature, [p], [dp/dn], [Lap p], surface Laplacian of [p]
///   R::on_leg(here, far, phi_here, phi_far)  the jump of a leg from that of its two nodes
///   R::gradient(t, n, b)                   the jump of the gradient, t being the surface gradient of [p], n the normal
template <class R>
concept JumpRule = requires(double x, const Vec<3>& v) {
  { R::at_node(x, x, x, x, x, x) } -> std::same_as<double>;
  { R::on_leg(x, x, x, x) } -> std::same_as<double>;
  { R::gradient(v, v, x) } -> std::same_as<Vec<3>>;
};

/// Checks R at compile time, one readable message for each requirement.
template <class R>
constexpr void check_jump_rule() {
  static_assert(
      requires(double x) { R::at_node(x, x, x, x, x, x); },
      "cambium: a jump rule has at_node(distance, curvature, value, normal_derivative, laplacian, "
      "surface_laplacian); see docs/concepts/JumpRule.md");
  static_assert(
      requires(double x) { R::on_leg(x, x, x, x); },
      "cambium: a jump rule has on_leg(here, far, distance_here, distance_far); see docs/concepts/JumpRule.md");
  static_assert(
      requires(double x, const Vec<3>& v) { R::gradient(v, v, x); },
      "cambium: a jump rule has gradient(surface_gradient, normal, normal_derivative); see "
      "docs/concepts/JumpRule.md");
  static_assert(JumpRule<R>,
                "cambium: a jump rule's functions return the scalars and vectors they are given; see "
                "docs/concepts/JumpRule.md");
}

}  // namespace cambium
