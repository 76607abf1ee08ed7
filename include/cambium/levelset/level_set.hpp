// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>

#include <cambium/levelset/band_builder.hpp>
#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/sampler.hpp>

namespace cambium {

/// A closed interface as the zero set of its signed distance phi, phi < 0 inside, kept in a narrow band.
///
/// \tparam Reinit  how phi is made a distance, see Reinitialisation
template <class Reinit = ClosestPoint, int D = 3, class T = double>
class LevelSet {
 public:
  static constexpr int dimension = D;
  using Scalar = T;
  using Band = NarrowBand<T, D>;
  using Method = typename Reinit::template Method<T, D>;

  struct Params {
    /// Distance up to which phi is kept, in spacings: what the stencils of the default policies need.
    double half_width = 6.0;
    /// Nodes that must be between the interface and a bounded face: half the support of the default kernel.
    std::ptrdiff_t wall_distance = 3;
    typename Reinit::Params reinit = {};
  };

  /// From a function of the position, of any scaling, negative inside: phi := distance to its zero set. It is called by
  /// several threads, at every node of the lattice, or, if it bounds its slope (as shapes do), near its zero set only.
  /// \throws InterfaceError if there is no zero crossing, one within `wall_distance` nodes of a bounded face, or a
  /// shape
  ///         cut off by a periodic face; ValueError if f is found to be not finite
  template <class F, Execution E = OpenMP>
  LevelSet(const Lattice<D>& lattice, F&& f, const Params& params = {}, const E& execution = {})
      : band_(lattice, params.half_width * lattice.spacing()),
        next_(band_),
        marks_(lattice),
        reinit_((check_reinitialisation<Reinit>(), params.reinit)) {
    sample(f, params.wall_distance, execution);
    reinitialise(execution);
  }

  const Lattice<D>& lattice() const { return band_.lattice(); }
  double spacing() const { return band_.spacing(); }
  const Band& band() const { return band_; }
  /// The reinitialisation with its buffers; that by closest points has the points of the last call.
  const Method& method() const { return reinit_; }

  /// phi := signed distance to its zero set.
  template <Execution E = OpenMP>
  ReinitReport reinitialise(const E& execution = {}) {
    const ReinitReport report = reinit_(band_, execution);
    detail::trim(band_, next_, marks_, margin);
    return report;
  }

  /// phi := +-half width where it is larger, and blocks only where it is not.
  void trim() {
    for (std::size_t b = 0; b < band_.blocks(); ++b) {
      for (T& phi : band_.values().block(b)) phi = std::clamp(phi, -band_.half_width(), band_.half_width());
    }
    detail::trim(band_, next_, marks_, margin);
  }

  /// Replaces the band by another: write_block(band, b) gives values to the nodes of block b (NaN where the node is far
  /// from the interface), for all blocks that `mark(marks)` marked.
  template <class Mark, class Write, Execution E>
  void replace(Mark&& mark, Write&& write_block, const E& execution) {
    marks_.clear();
    mark(marks_);
    next_.values().clear();
    marks_.for_each([&](const Index<D>& block) { next_.values().activate(block); });
    for_each_piece_by_worker(execution, next_.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      write_block(next_, b, worker);
      detail::fill_unknown(next_, b);
    });
    next_.find_far_sides();
    std::swap(band_, next_);
  }

 private:
  static constexpr std::ptrdiff_t margin = 5;

  template <class F, class E>
  void sample(F& f, std::ptrdiff_t wall_distance, const E& execution) {
    const detail::Sampler<T, D, F> sampler(band_, f);
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(band_.half_width() / band_.spacing())) + margin;
    sampler.mark(marks_, reach, execution);
    marks_.for_each([&](const Index<D>& block) { band_.values().activate(block); });
    // Reinitialisations may rely on values up to the margin beyond the band.
    const double width = static_cast<double>(reach) * band_.spacing();
    for_each_piece(execution, band_.blocks(), 1, [&](std::size_t b, std::size_t) { sampler.fill(band_, b, width); });
    detail::check_walls(band_, wall_distance);
    if constexpr (BoundedSlope<F, D>) {
      detail::check_seams(band_, static_cast<double>(F::lipschitz));
    }
    band_.find_far_sides();
  }

  Band band_;
  Band next_;
  detail::BlockMarks<D> marks_;
  typename Reinit::template Method<T, D> reinit_;
};

}  // namespace cambium
