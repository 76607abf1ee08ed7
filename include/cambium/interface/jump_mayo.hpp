// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/interface/jump.hpp>

namespace cambium {

/// The jump of the value alone, leg by leg: the neighbour across the interface is off by [p] where the leg crosses it
/// (Mayo, SIAM J. Numer. Anal. 21 (1984) 285, without the jumps of the derivatives along the leg).
struct JumpOfValue {
  template <class T>
  static T at_node(T, T, T a, T, T, T) {
    return a;
  }
  /// Linear between the nodes, whose values are those of their closest points.
  template <class T>
  static T on_leg(T here, T far, T distance_here, T distance_far) {
    const T whole = std::abs(distance_here) + std::abs(distance_far);
    return whole > T(0) ? (std::abs(distance_far) * here + std::abs(distance_here) * far) / whole : far;
  }
  template <class T, int D>
  static Vec<D, T> gradient(const Vec<D, T>&, const Vec<D, T>&, T) {
    return {};
  }
};

/// Comparator of Jump that knows of [p] only: what set() is given for [dp/dn] and [f] is left out. p of first order
/// where [dp/dn] is zero, with gradients that do not converge next to the interface; wrong by O(1) where it is not.
template <int D, class T = double, class K = Lambda<4, 4>>
using JumpMayo = BasicJump<D, T, JumpOfValue, K>;

}  // namespace cambium
