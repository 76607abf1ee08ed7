// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstddef>

#include <cambium/levelset/narrow_band.hpp>

namespace cambium {

/// What a reinitialisation did.
struct ReinitReport {
  std::size_t nodes = 0;          ///< nodes in the band afterwards
  std::size_t lower_order = 0;    ///< nodes worked on by a method of lower order: the interface is under-resolved there
  std::size_t not_converged = 0;  ///< nodes that took an estimate because no search or iteration converged
  std::size_t iterations = 0;     ///< sweeps or pseudo-time steps over the band
};

/// A way to make phi the signed distance to its own zero set:
///   typename R::Params                          options, all with defaults
///   typename R::template Method<T, D>           owner of the buffers, made from R::Params
///   ReinitReport method(band, execution)        for NarrowBand<T, D>& band
///
/// What the method may rely on: phi is finite, negative inside, of any scaling near the interface; blocks hold every
/// node within half_width() of the interface and three spacings more. What it must leave: signed distances below
/// half_width() in the band, exactly +-half_width() at all other nodes of the blocks (padding beyond the lattice
/// included), the blocks themselves as they were.
template <class R>
concept Reinitialisation = std::constructible_from < typename R::template Method<double, 3>,
const typename R::Params& > &&requires(typename R::template Method<double, 3>& method, NarrowBand<double, 3>& band) {
  { method(band, Serial{}) } -> std::same_as<ReinitReport>;
};

/// Checks R at compile time, one readable message for each requirement.
template <class R>
constexpr void check_reinitialisation() {
  static_assert(
      requires { typename R::Params; },
      "cambium: a reinitialisation has its options in a nested type Params; see docs/concepts/Reinitialisation.md");
  static_assert(
      requires { typename R::template Method<double, 3>; },
      "cambium: a reinitialisation has a nested template Method<T, D>; see docs/concepts/Reinitialisation.md");
  static_assert(Reinitialisation<R>,
                "cambium: a reinitialisation's Method is made from Params and called as method(band, execution), which "
                "returns a ReinitReport; see docs/concepts/Reinitialisation.md");
}

}  // namespace cambium
