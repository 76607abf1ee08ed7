// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <cambium/interpolation/interpolator.hpp>
#include <cambium/kernels/delta4.hpp>
#include <cambium/kernels/delta_function.hpp>
#include <cambium/levelset/surface.hpp>

namespace cambium {

/// A point of an interface that stands for a piece of it.
template <int D>
struct InterfaceMarker {
  Vec<D> position;
  Vec<D> normal;           ///< outward
  double curvature = 0.0;  ///< sum of the principal curvatures
  double area = 0.0;       ///< of the piece; its length in 2D
};

/// The immersed boundary method (Peskin, Acta Numerica 11 (2002) 479): what acts on an interface is spread to the
/// lattice with a regularised delta function, and fields are read back with the same.
///
///     cambium::ImmersedBoundary<2> boundary(lattice);
///     boundary.attach(level_set.band());
///     boundary.spread([&](const auto& m) { return -gamma * m.curvature * m.normal; }, force);
///
/// First order: solutions are smeared over the width of the delta function, jumps and gradients at the interface are
/// not seen. It is the comparator of Jump, and works where Jump's interface would be under-resolved. spread() and
/// interpolate() are adjoint; the sum of what is spread is kept to round-off.
/// \tparam K  delta function
template <int D, class K = Delta4, class T = double>
class ImmersedBoundary {
 public:
  using Marker = InterfaceMarker<D>;
  static constexpr int dimension = D;

  explicit ImmersedBoundary(const Lattice<D>& lattice) : lattice_((check_delta_function<K>(), lattice)) {}

  const Lattice<D>& lattice() const { return lattice_; }
  /// One for every crossing of the interface with an edge of the lattice, and so closer than a spacing to the next
  /// ones.
  const std::vector<Marker>& markers() const { return markers_; }

  /// Takes a new interface. \throws SizeError if the band is on another lattice, InterfaceError as extract_surface()
  template <Execution E = OpenMP>
  void attach(const NarrowBand<T, D>& band, const E& execution = {}) {
    if (!(band.lattice() == lattice_)) {
      throw SizeError("the band is not on the lattice of the immersed boundary: make one for every lattice");
    }
    const Surface<D> surface = extract_surface(band, {}, execution);
    std::vector<Marker> markers(surface.vertices.size());
    for (std::size_t v = 0; v < markers.size(); ++v) {
      markers[v] = {surface.vertices[v], surface.normals[v], surface.curvatures[v], 0.0};
    }
    for (const auto& element : surface.elements) {
      const double share = area(surface, element) / D;
      for (const std::uint32_t v : element) markers[v].area += share;
    }
    markers_ = std::move(markers);
    for (int d = 0; d < D; ++d) {
      position_[d].resize(markers_.size());
      for (std::size_t v = 0; v < markers_.size(); ++v) position_[d][v] = markers_[v].position[d];
    }
  }

  /// field := integral over the interface of density(marker) delta_h(x - x_marker): per volume what the density is per
  /// area. \tparam V  T or Vec<C, T>, what the density returns. \throws ValueError if the density is not finite,
  /// SizeError
  ///         if the field is on another lattice, PositionError if a marker is out of a bounded box
  template <class Density, class V, Execution E = OpenMP>
  void spread(Density&& density, Field<V, D>& field, const E& execution = {}) {
    constexpr int C = Components<V>::count;
    require(field);
    const double per_volume = 1.0 / lattice_.cell_volume();
    auto columns = strengths<C>();
    for (std::size_t v = 0; v < markers_.size(); ++v) {
      const V value = density(markers_[v]);
      for (int c = 0; c < C; ++c) {
        columns.column(c)[v] = component(value, c) * static_cast<T>(markers_[v].area * per_volume);
      }
    }
    interpolator_.p2m(positions(), constant(columns), field, execution);
  }

  /// What the field is at the markers, as the delta function sees it. \throws SizeError if the field is on another
  /// lattice
  template <class V, Execution E = OpenMP>
  void interpolate(const Field<V, D>& field, std::vector<V>& at_markers, const E& execution = {}) {
    constexpr int C = Components<V>::count;
    require(field);
    auto columns = strengths<C>();
    interpolator_.m2p(field, positions(), columns, execution);
    at_markers.resize(markers_.size());
    for (std::size_t v = 0; v < markers_.size(); ++v) {
      for (int c = 0; c < C; ++c) component(at_markers[v], c) = columns.column(c)[v];
    }
  }

 private:
  double area(const Surface<D>& surface, const std::array<std::uint32_t, D>& element) const {
    const auto edge = [&](std::size_t k) {
      return lattice_.domain().difference(surface.vertices[element[0]], surface.vertices[element[k]]);
    };
    const Vec<D> a = edge(1);
    if constexpr (D == 2) {
      return norm(a);
    } else {
      const Vec<D> b = edge(2);
      return 0.5 * std::sqrt(std::fmax(dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b), 0.0));
    }
  }
  template <class V>
  void require(const Field<V, D>& field) const {
    if (field.lattice() == lattice_) return;
    throw SizeError("the field is not on the lattice of the immersed boundary: make one for every lattice");
  }
  Columns<D, const double> positions() const {
    std::array<const double*, D> first;
    for (int d = 0; d < D; ++d) first[d] = position_[d].data();
    return {first, markers_.size()};
  }
  /// Room for C components at the markers.
  template <int C>
  Columns<C, T> strengths() {
    if (strength_.size() < static_cast<std::size_t>(C)) strength_.resize(static_cast<std::size_t>(C));
    std::array<T*, C> first;
    for (int c = 0; c < C; ++c) {
      auto& column = strength_[static_cast<std::size_t>(c)];
      column.resize(markers_.size());
      first[c] = column.data();
    }
    return {first, markers_.size()};
  }
  template <int C>
  static Columns<C, const T> constant(const Columns<C, T>& columns) {
    std::array<const T*, C> first;
    for (int c = 0; c < C; ++c) first[c] = columns.column(c).data();
    return {first, columns.size()};
  }

  Lattice<D> lattice_;
  std::vector<Marker> markers_;
  std::array<AlignedVector<double>, D> position_;
  std::vector<AlignedVector<T>> strength_;
  Interpolator<K> interpolator_;
};

}  // namespace cambium
