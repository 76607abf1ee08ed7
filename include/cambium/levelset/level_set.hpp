// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include <cambium/core/snapshot.hpp>
#include <cambium/levelset/band_builder.hpp>
#include <cambium/levelset/closest_point.hpp>
#include <cambium/levelset/sampler.hpp>

namespace cambium {

/// A closed interface as the zero set of its signed distance phi, phi < 0 inside, kept in a narrow band.
///
/// \tparam Reinit   how phi is made a distance, see Reinitialisation
/// \tparam Storage  Sparse: values near the interface alone. Dense: also a field with a value for every node, kept
///                  up to date, for what works on the whole lattice
template <class Reinit = ClosestPoint, int D = 3, class T = double, class Storage = Sparse>
class LevelSet {
  static_assert((check_reinitialisation<Reinit>(), true));

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
  ///         shape cut off by a periodic face; ValueError if f is found to be not finite, or the band is too thin for
  ///         the stencils of the reinitialisation
  template <class F, Execution E = OpenMP>
  LevelSet(const Lattice<D>& lattice, F&& f, const Params& params = {}, const E& execution = {})
      : LevelSet(lattice, params) {
    static_assert(std::is_invocable_r_v<double, F&, const Vec<D>&>,
                  "cambium: a level set is made from a function of a position with as many dimensions as the lattice");
    sample(f, execution);
    reinitialise(execution);
  }
  /// One that was saved, with the same lattice and parameters: to the last bit. \throws SnapshotError, InterfaceError
  /// for what does not fit
  static LevelSet restored(const Lattice<D>& lattice, const Snapshot& snapshot, const Params& params = {}) {
    LevelSet result(lattice, params);
    SnapshotReader reader(snapshot);
    visit(result, reader);
    result.band_.find_far_sides();
    require_crossing(result.band_);
    result.dense_.take(result.band_);
    return result;
  }
  /// Adds phi and what the reinitialisation knows of it.
  void save(Snapshot& snapshot) const {
    SnapshotWriter writer(snapshot);
    visit(*this, writer);
  }

  const Lattice<D>& lattice() const { return band_.lattice(); }
  double spacing() const { return band_.spacing(); }
  const Band& band() const { return band_; }
  /// The reinitialisation with its buffers. That by closest points has, after reinitialise() or restore_band(), the
  /// closest points of the nodes of band().
  const Method& method() const { return reinit_; }

  /// phi at every node of the lattice, +-half width far from the interface.
  const Field<T, D>& phi() const requires std::same_as<Storage, Dense> { return dense_.values; }

  /// phi := signed distance to its zero set. \throws InterfaceError if the interface has vanished or is too near to a
  /// bounded face; the level set is then unchanged
  template <Execution E = OpenMP>
  ReinitReport reinitialise(const E& execution = {}) {
    ReinitReport report;
    change([&] { report = reinit_(band_, execution); });
    return report;
  }

  /// Makes a band again of phi that is right next to the interface only, without a reinitialisation: slopes are kept.
  /// Reinitialisations that have no way to do so leave phi as trim() does. \throws as reinitialise()
  template <Execution E = OpenMP>
  void restore_band(const E& execution = {}) {
    if constexpr (requires { reinit_.extend_slopes(band_, execution); }) {
      change([&] { reinit_.extend_slopes(band_, execution); });
    } else {
      trim();
    }
  }
  /// phi := +-half width where it is larger, and blocks only where it is not. \throws as reinitialise()
  void trim() {
    change([&] {
      for (std::size_t b = 0; b < band_.blocks(); ++b) {
        for (T& phi : band_.values().block(b)) phi = std::clamp(phi, -band_.half_width(), band_.half_width());
      }
    });
  }

  /// Replaces the band by another: write_block(band, b, worker) gives values to the nodes of block b (NaN to those far
  /// from the interface), or returns false if all are far, for all blocks that `mark(marks)` marked.
  /// \throws InterfaceError if the new values are not those of a closed interface; the level set is then unchanged
  template <class Mark, class Write, Execution E>
  void replace(Mark&& mark, Write&& write_block, const E& execution) {
    marks_.clear();
    mark(marks_);
    before_.values().clear();
    before_.values().reserve(marks_.count());
    marks_.for_each([&](const Index<D>& block) { before_.values().activate(block); });
    written_.resize(before_.blocks());
    for_each_piece_by_worker(execution, before_.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      written_[b] = write_block(before_, b, worker);
      if (written_[b]) detail::fill_unknown(before_, b);
    });
    next_.values().clear();
    next_.values().reserve(static_cast<std::size_t>(std::ranges::count(written_, std::uint8_t{1})));
    for (std::size_t b = 0; b < before_.blocks(); ++b) {
      if (!written_[b]) continue;
      const std::size_t to = next_.values().activate(before_.values().block_index(b));
      std::ranges::copy(before_.values().block(b), next_.values().block(to).begin());
    }
    next_.find_far_sides();
    require_crossing(next_);
    detail::check_walls(next_, wall_distance_);
    std::swap(band_, next_);
    dense_.take(band_);
  }

 private:
  LevelSet(const Lattice<D>& lattice, const Params& params)
      : band_(lattice, params.half_width * lattice.spacing()),
        next_(band_),
        marks_(lattice),
        reach_(lattice, margin),
        reinit_(params.reinit),
        wall_distance_(params.wall_distance),
        dense_(lattice, params.half_width * lattice.spacing()) {
    require_width(params.half_width);
  }
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive("lattice", self.lattice());
    archive("phi", self.band_.values());
    if constexpr (requires { Method::visit(self.reinit_, archive, self.band_.blocks()); }) {
      Method::visit(self.reinit_, archive, self.band_.blocks());
    }
  }

  /// Nodes kept around those of the band.
  static constexpr double margin = 3.0;

  static void require_width(double half_width) {
    if constexpr (requires { Reinit::least_half_width; }) {
      if (half_width < Reinit::least_half_width) {
        throw ValueError(detail::message("half width of the band is ", half_width, " spacings, but stencils of the ",
                                         "reinitialisation need ", Reinit::least_half_width, ": choose a wider band"));
      }
    }
  }
  static void require_crossing(const Band& band) {
    bool negative = false, positive = false;
    for (std::size_t b = 0; b < band.blocks() && !(negative && positive); ++b) {
      for (const T phi : band.values().block(b)) (phi < T(0) ? negative : positive) = true;
    }
    if (negative && positive) return;
    throw InterfaceError("the level set has no zero crossing any more: the interface has vanished; stop before");
  }
  /// Calls f, which changes values; then keeps the blocks that are needed. All is as before if that throws.
  template <class F>
  void change(F&& f) {
    before_ = band_;
    try {
      f();
      detail::trim(band_, next_, marks_, reach_, came_from_);
      detail::check_walls(band_, wall_distance_);
    } catch (...) {
      std::swap(band_, before_);
      throw;
    }
    if constexpr (requires { reinit_.take_blocks(came_from_); }) reinit_.take_blocks(came_from_);
    dense_.take(band_);
  }
  template <class F, class E>
  void sample(F& f, const E& execution) {
    const detail::Sampler<T, D, F> sampler(band_, f);
    const double width = static_cast<double>(band_.half_width()) / band_.spacing() + margin;
    sampler.mark(marks_, width, execution);
    band_.values().reserve(marks_.count());
    marks_.for_each([&](const Index<D>& block) { band_.values().activate(block); });
    // Reinitialisations may rely on values up to the margin beyond the band.
    for_each_piece(execution, band_.blocks(), 1,
                   [&](std::size_t b, std::size_t) { sampler.fill(band_, b, width * band_.spacing()); });
    detail::check_walls(band_, wall_distance_);
    if constexpr (BoundedSlope<F, D>) {
      detail::check_seams(band_, static_cast<double>(F::lipschitz));
    }
    band_.find_far_sides();
  }

  /// The dense field of a level set that has one.
  struct DenseCopy {
    DenseCopy(const Lattice<D>& lattice, double half_width) : values(lattice, static_cast<T>(half_width)) {}
    void take(const Band& band) {
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = band(values.lattice().node(i));
    }
    Field<T, D> values;
  };
  struct NoCopy {
    NoCopy(const Lattice<D>&, double) {}
    void take(const Band&) {}
  };

  Band band_;
  Band next_;
  Band before_ = band_;
  detail::BlockMarks<D> marks_;
  detail::BlockReach<D> reach_;
  Method reinit_;
  std::ptrdiff_t wall_distance_;
  std::vector<std::uint8_t> written_;
  std::vector<std::ptrdiff_t> came_from_;
  [[no_unique_address]] std::conditional_t<std::is_same_v<Storage, Dense>, DenseCopy, NoCopy> dense_;
};

}  // namespace cambium
