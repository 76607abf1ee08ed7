// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include <cambium/levelset/band_field.hpp>
#include <cambium/levelset/geometry/surface_geometry.hpp>

namespace cambium {

/// Normals and curvatures at the nodes of a band; see SurfaceGeometry for what they mean. Zero at nodes for which the
/// method has none; see defined().
template <class T, int D>
struct BandGeometry {
  Field<Vec<D, T>, D, Sparse> normal;
  Field<T, D, Sparse> mean;
  Field<T, D, Sparse> gaussian;  ///< without blocks in 2D

  explicit BandGeometry(const Lattice<D>& lattice) : normal(lattice), mean(lattice), gaussian(lattice) {}

  /// True if node i of block b has a normal.
  bool defined(std::size_t b, std::size_t i) const { return !(normal.block(b)[i] == Vec<D, T>{}); }

  /// Takes the blocks of a band.
  void take_blocks(const NarrowBand<T, D>& band) {
    cambium::take_blocks(normal, band);
    cambium::take_blocks(mean, band);
    if constexpr (D == 3) cambium::take_blocks(gaussian, band);
  }
  void set(std::size_t b, std::size_t i, const SurfaceGeometry<T, D>& value) {
    normal.block(b)[i] = value.normal;
    mean.block(b)[i] = value.mean;
    if constexpr (D == 3) gaussian.block(b)[i] = value.gaussian;
  }
};

/// A way to find normals and curvatures on the nodes of a band:
///   typename G::Params                        options, all with defaults
///   typename G::template Method<T, D>         owner of the buffers, made from G::Params
///   method(band, geometry, execution)         for const NarrowBand<T, D>& band and BandGeometry<T, D>& geometry
///
/// What the method may rely on: phi is finite and negative inside; it is a signed distance unless the method says that
/// it takes others. What it must leave: geometry with the blocks of the band and a value at every node, zero where it
/// has none; the same bits for any number of threads.
template <class G>
concept GeometryPolicy = std::constructible_from < typename G::template Method<double, 3>,
const typename G::Params& > &&requires(typename G::template Method<double, 3>& method,
                                       const NarrowBand<double, 3>& band, BandGeometry<double, 3>& geometry) {
  method(band, geometry, Serial{});
};

/// Checks G at compile time, one readable message for each requirement.
template <class G>
constexpr void check_geometry_policy() {
  static_assert(
      requires { typename G::Params; },
      "cambium: a geometry policy has its options in a nested type Params; see docs/concepts/GeometryPolicy.md");
  static_assert(
      requires { typename G::template Method<double, 3>; },
      "cambium: a geometry policy has a nested template Method<T, D>; see docs/concepts/GeometryPolicy.md");
  static_assert(GeometryPolicy<G>,
                "cambium: a geometry policy's Method is made from Params and called as method(band, geometry, "
                "execution); see docs/concepts/GeometryPolicy.md");
}

}  // namespace cambium
