// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include <cambium/levelset/band_field.hpp>

namespace cambium {

/// A way to continue a field off the interface with d/dn = 0:
///   typename X::Params                         options, all with defaults
///   typename X::template Method<T, D>          owner of the buffers, made from X::Params
///   method(band, from, to, execution)          for const NarrowBand<T, D>& band, const Field<V, D, Sparse>& from with
///                                              the blocks of the band, Field<V, D, Sparse>& to; V = T or Vec<C, T>
///
/// What the method may rely on: phi is a signed distance; `from` is right near the interface; each method says how
/// near. What it must leave: `to` with the blocks of the band and a value at every node of them; `from` unchanged; the
/// same bits for any number of threads.
template <class X>
concept Extension = std::constructible_from < typename X::template Method<double, 3>,
const typename X::Params& > &&requires(typename X::template Method<double, 3>& method,
                                       const NarrowBand<double, 3>& band, const Field<double, 3, Sparse>& from,
                                       Field<double, 3, Sparse>& to, const Field<Vec<3>, 3, Sparse>& from_vectors,
                                       Field<Vec<3>, 3, Sparse>& to_vectors) {
  method(band, from, to, Serial{});
  method(band, from_vectors, to_vectors, Serial{});
};

/// Checks X at compile time, one readable message for each requirement.
template <class X>
constexpr void check_extension() {
  static_assert(
      requires { typename X::Params; },
      "cambium: an extension has its options in a nested type Params; see docs/concepts/Extension.md");
  static_assert(
      requires { typename X::template Method<double, 3>; },
      "cambium: an extension has a nested template Method<T, D>; see docs/concepts/Extension.md");
  static_assert(
      Extension<X>,
      "cambium: an extension's Method is made from Params and called as method(band, from, to, execution) for "
      "fields of scalars and of vectors; see docs/concepts/Extension.md");
}

}  // namespace cambium
