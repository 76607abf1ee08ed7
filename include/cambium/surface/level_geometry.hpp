// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <type_traits>

#include <cambium/levelset/geometry/band_geometry.hpp>

namespace cambium::detail {

/// Normals and curvatures of the levels of phi at the nodes of a band, for operators that act on fields of that band.
/// \tparam Geometry  CentredDifferences<2> or <4>
template <class Geometry, class T, int D>
class LevelGeometry {
 public:
  using Band = NarrowBand<T, D>;

  /// \param needed  half width of the band, in spacings. \throws BandError if the band is thinner; `what` names the
  ///                operator
  template <Execution E>
  void fit(const Band& band, double needed, const char* what, const E& execution) {
    if (static_cast<double>(band.half_width()) < needed * band.spacing()) {
      throw BandError(message("half width of the band is ", static_cast<double>(band.half_width()) / band.spacing(),
                              " spacings, but ", what, " needs ", needed, ": choose a wider band"));
    }
    typename Geometry::template Method<T, D>(typename Geometry::Params{})(band, geometry_.emplace(band.lattice()),
                                                                          execution);
  }
  /// Gives `to` the blocks of the band. \throws SizeError unless `from` and what was taken have these; ValueError if
  /// `from` and `to` are one field
  template <class V>
  void prepare(const Band& band, const Field<V, D, Sparse>& from, Field<V, D, Sparse>& to, const char* what) const {
    static_assert(std::is_same_v<ScalarOf<V>, T>, "cambium: the field must have the scalar type of the level set");
    require_same_blocks(from, band, "the field to diffuse");
    if (!geometry_ || !same_blocks(geometry_->normal, band)) {
      throw SizeError(message(what, " was made for another band: call fit(band) when the interface has moved"));
    }
    if (&from == &to) throw ValueError("the field to diffuse is also the result: give two fields");
    take_blocks(to, band);
  }
  const BandGeometry<T, D>& get() const { return *geometry_; }

 private:
  std::optional<BandGeometry<T, D>> geometry_;
};

}  // namespace cambium::detail
