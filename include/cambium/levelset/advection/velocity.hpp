// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include <cambium/core/vec.hpp>

namespace cambium::detail {

/// Checks at compile time that V can move a level set: velocity(Vec<D, T> x, double time) -> Vec<D, T>.
template <class V, class T, int D>
constexpr void check_velocity() {
  static_assert(
      requires(V & velocity, const Vec<D, T>& x, double time) {
        { velocity(x, time) } -> std::convertible_to<Vec<D, T>>;
      },
      "cambium: the velocity of a level set is called as velocity(x, time) with a Vec<D, T> and a double, and returns "
      "a "
      "Vec<D, T>");
}

}  // namespace cambium::detail
