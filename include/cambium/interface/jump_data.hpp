// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <concepts>
#include <type_traits>

#include <cambium/interface/jump_geometry.hpp>

namespace cambium {

/// Nothing jumps: the jump data that are zero.
struct NoJump {
  template <class X>
  double operator()(const X&) const {
    return 0.0;
  }
};

/// What gives a number at every point of an interface: a function of the position, or a field with the blocks of the
/// band whose nodes have the value of their closest point, as ByClosestPoint makes it.
template <class A, class T, int D>
concept JumpData = std::same_as<A, Field<T, D, Sparse>> || requires(const A& a, const Vec<D>& x) {
  { a(x) } -> std::convertible_to<double>;
};

namespace detail {

/// to := what `data` is at the closest point of every node that has one, 0 elsewhere.
/// \throws ValueError if it is not finite, SizeError if a field has other blocks than the band
template <class A, int D, class T, class K, Execution E>
void read_jump(const A& data, const JumpGeometry<D, T, K>& geometry, const char* what, Field<T, D, Sparse>& to,
               const E& execution) {
  static_assert(JumpData<A, T, D>,
                "cambium: a jump is a function of the position or a field on the blocks of the band");
  const auto& band = geometry.band();
  if constexpr (std::same_as<A, Field<T, D, Sparse>>) require_same_blocks(data, band, what);
  take_blocks(to, band);
  for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
    const auto values = to.block(b);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = T(0);
      if (!geometry.points().found(b, i)) continue;
      if constexpr (std::same_as<A, Field<T, D, Sparse>>) {
        values[i] = data.block(b)[i];
      } else {
        values[i] = static_cast<T>(data(geometry.closest_point(b, i)));
      }
      if (std::isfinite(values[i])) continue;
      throw ValueError(message(what, " is ", values[i], " at ", geometry.closest_point(b, i),
                               " on the interface: it must be finite"));
    }
  });
}

}  // namespace detail
}  // namespace cambium
