// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include <cambium/levelset/narrow_band.hpp>

namespace cambium {

/// How the nodes next to the interface got their distances.
struct KickOffCounts {
  std::size_t nodes = 0;        ///< nodes that got a distance
  std::size_t lower_order = 0;  ///< of these, by a method of lower order: the interface is under-resolved there
  std::size_t estimated = 0;    ///< nodes at which no search converged: they took a linear estimate or were left out
};

/// A way to give the nodes next to the interface their distances, from which marching and sweeping start:
///   typename K::Params                          options, all with defaults
///   typename K::template Method<T, D>           owner of the buffers, made from K::Params
///   KickOffCounts method(band, distance, execution)
///
/// distance[b * volume + i] belongs to node i of block b; it arrives as NaN. The method writes signed distances in
/// spacings, of the sign of phi (a negative phi never gets zero), at least at every node of the lattice with a
/// neighbour along an axis on the other side of the interface, and leaves all other entries as they are.
template <class K>
concept KickOff = std::constructible_from < typename K::template Method<double, 3>,
const typename K::Params& > &&requires(typename K::template Method<double, 3>& method,
                                       const NarrowBand<double, 3>& band, std::span<double> distance) {
  { method(band, distance, Serial{}) } -> std::same_as<KickOffCounts>;
};

/// Checks K at compile time, one readable message for each requirement.
template <class K>
constexpr void check_kick_off() {
  static_assert(
      requires { typename K::Params; },
      "cambium: a kick-off has its options in a nested type Params; see docs/concepts/KickOff.md");
  static_assert(
      requires { typename K::template Method<double, 3>; },
      "cambium: a kick-off has a nested template Method<T, D>; see docs/concepts/KickOff.md");
  static_assert(KickOff<K>,
                "cambium: a kick-off's Method is made from Params and called as method(band, distance, execution), "
                "which returns KickOffCounts; see docs/concepts/KickOff.md");
}

}  // namespace cambium
