// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/models/tumour/jump_pressure.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/poisson/free_space.hpp>

namespace cambium {

/// Lap p = 0 outside, in free space: p falls off (like the logarithm in the plane).
/// \tparam Rule  how the pressure jumps, see JumpRule: FreeSpace's, or JumpOfValue for comparison
template <class Rule>
struct BasicFreeSpace {
  using Kind = tumour_kind::Outside;
  /// Speed that a drop of the pressure with short waves causes, over their wave number.
  static constexpr double mobility = 0.5;

  template <int D, class K>
  using Method = detail::JumpPressure<D, FreeSpacePoisson<D, double, OpenMP>, K, Rule>;
};

/// The default.
using FreeSpace = BasicFreeSpace<JumpExtension>;

}  // namespace cambium
