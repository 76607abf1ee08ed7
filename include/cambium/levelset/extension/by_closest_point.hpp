// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <vector>

#include <cambium/levelset/closest_point_walk.hpp>
#include <cambium/levelset/extension/extension.hpp>
#include <cambium/levelset/field_patch.hpp>

namespace cambium {

/// Extension off the interface by closest points: every node takes the value that kernel K interpolates at its closest
/// point. Nodes on one normal have one closest point, so that d/dn = 0 to the accuracy of the points, without
/// iteration.
///
/// Takes phi of any scaling. Reads `from` at nodes up to K::support / 2 spacings along each axis from the interface (3
/// with the default: 4.3 h in 2D and 5.2 h in 3D), on both sides: a field that is known on one side only must be
/// continued that far first. Order K::moments + 1 where `from` is that smooth. Nodes that have no closest point (beyond
/// the half width) keep the value of `from`.
template <class K = Lambda<4, 4>>
struct ByClosestPoint {
  struct Params {};

  template <class T, int D>
  class Method {
   public:
    using Points = ClosestPoints<K, T, D>;

    Method() = default;
    explicit Method(const Params&) {}

    /// Finds the closest points first.
    /// \throws SizeError unless `from` has the blocks of the band; ValueError if `from` and `to` are one field
    template <class V, Execution E>
    void operator()(const NarrowBand<T, D>& band, const Field<V, D, Sparse>& from, Field<V, D, Sparse>& to,
                    const E& execution) {
      require_source(band, from, to);
      points_.find(band, static_cast<double>(band.half_width()), execution);
      (*this)(band, points_, from, to, execution);
    }
    /// From closest points that are known, those of points.find(band, ...): several fields share them.
    template <class V, Execution E>
    void operator()(const NarrowBand<T, D>& band, const Points& points, const Field<V, D, Sparse>& from,
                    Field<V, D, Sparse>& to, const E& execution) {
      require_source(band, from, to);
      take_blocks(to, band);
      patches_.resize(static_cast<std::size_t>(execution.count()));
      for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
        FieldPatch<T, D>& patch = patches_[worker];
        const auto values = to.block(b);
        detail::for_each_closest_point<K>(
            points, band, b, from, patch,
            [&](std::size_t i, const Vec<D, T>& u) {
              for (int c = 0; c < Components<V>::count; ++c) {
                component(values[i], c) = Interpolant<K, T, D>::value(patch.data(c), patch.stride(), u);
              }
            },
            [&](std::size_t i) { values[i] = from.block(b)[i]; });
      });
    }
    /// Closest points of the last call that found them.
    const Points& points() const { return points_; }

   private:
    template <class V>
    static void require_source(const NarrowBand<T, D>& band, const Field<V, D, Sparse>& from,
                               const Field<V, D, Sparse>& to) {
      static_assert(std::is_same_v<ScalarOf<V>, T>, "cambium: the field must have the scalar type of the level set");
      require_same_blocks(from, band, "the field to extend");
      if (&from == &to) throw ValueError("the field to extend is also the result: give two fields");
    }

    Points points_;
    std::vector<FieldPatch<T, D>> patches_;
  };
};

}  // namespace cambium
