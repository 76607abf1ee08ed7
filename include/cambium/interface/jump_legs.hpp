// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <cambium/levelset/geometry/band_geometry.hpp>
#include <cambium/levelset/patch.hpp>
#include <cambium/poisson/fourth_order.hpp>
#include <cambium/poisson/second_order.hpp>

namespace cambium {

/// Weights of the nodes k = 1, 2, ... steps away in the stencils of a difference symbol: u'' h^2 = sum_k second_k (u_k
/// - 2 u_0 + u_-k), u' h = sum_k first_k (u_k - u_-k).
template <class Symbol>
struct StencilLegs;
template <>
struct StencilLegs<SecondOrder> {
  static constexpr std::array<double, 1> second{1.0};
  static constexpr std::array<double, 1> first{0.5};
};
template <>
struct StencilLegs<FourthOrder> {
  static constexpr std::array<double, 2> second{4.0 / 3.0, -1.0 / 12.0};
  static constexpr std::array<double, 2> first{2.0 / 3.0, -1.0 / 12.0};
};

/// What becomes of legs whose two nodes have their closest points on different parts of the interface.
enum class UnresolvedLegs {
  reject,  ///< InterfaceError
  keep     ///< they take the jump at the closest point of the far node all the same, and are counted
};

namespace detail {

/// A leg of a stencil that the interface crosses, from the node it belongs to.
struct JumpLeg {
  std::size_t node;  ///< number in the lattice
  std::size_t here;  ///< the node in the band: block times nodes in a block, plus place in the block
  std::size_t far;   ///< the node at the other end, in the band
  std::int8_t axis;
  std::int8_t steps;  ///< to the other end; negative towards lower nodes
  bool inside;        ///< the side of the node
};

/// The legs of up to two steps that the interface crosses, block by block of a band.
template <int D>
class JumpLegs {
 public:
  /// Legs whose ends have normals that differ by more than 60 degrees are unresolved: the interface turns, or comes
  /// back, within a step.
  static constexpr double least_cosine = 0.5;

  /// \param known  known(b, i): node i of block b has a closest point
  /// \param patch  buffer
  template <class T, class Known>
  void find(const NarrowBand<T, D>& band, const BandGeometry<T, D>& geometry, UnresolvedLegs unresolved, Known&& known,
            Patch<T, D>& patch) {
    legs_.clear();
    begin_.assign(1, 0);
    unresolved_ = 0;
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      patch.read_block(band, b, longest);
      if (crossed(patch)) {
        for (std::size_t i = 0; i < band.volume; ++i) add_node(band, patch, b, i);
      }
      for (std::size_t k = begin_.back(); k < legs_.size(); ++k) {
        require_known(band, legs_[k], known);
        examine(band, geometry, legs_[k], unresolved);
      }
      begin_.push_back(legs_.size());
    }
  }

  std::size_t size() const { return legs_.size(); }
  /// Legs of one step whose ends belong to different parts of the interface.
  std::size_t unresolved() const { return unresolved_; }
  /// Calls f(leg) for the legs of the nodes of block b.
  template <class F>
  void for_each(std::size_t b, F&& f) const {
    for (std::size_t k = begin_[b]; k < begin_[b + 1]; ++k) f(legs_[k]);
  }

 private:
  static constexpr std::ptrdiff_t longest = 2;

  template <class T>
  static bool crossed(const Patch<T, D>& patch) {
    const std::ptrdiff_t size = product(patch.edge());
    std::ptrdiff_t inside = 0;
    for (std::ptrdiff_t at = 0; at < size; ++at) inside += patch[at] < T(0);
    return inside > 0 && inside < size;
  }
  template <class T>
  void add_node(const NarrowBand<T, D>& band, const Patch<T, D>& patch, std::size_t b, std::size_t i) {
    const std::ptrdiff_t at = patch.entry(i);
    const bool inside = patch[at] < T(0);
    for (int d = 0; d < D; ++d) {
      for (const std::ptrdiff_t steps : {-2, -1, 1, 2}) {
        if ((patch[at + steps * patch.stride()[d]] < T(0)) == inside) continue;
        const Index<D> node = band.values().node(b, i);
        if (!band.lattice().contains(node)) return;
        const Index<D> other = band.inside(node + Index<D>::unit(d, steps));
        const std::ptrdiff_t block = band.values().find(band.values().block_of(other));
        if (block < 0) {
          throw InterfaceError(message("the interface near ", band.lattice().position(node),
                                       " is next to nodes without values: give the band of a level set"));
        }
        legs_.push_back({band.lattice().number(node), b * band.volume + i,
                         static_cast<std::size_t>(block) * band.volume + band.values().offset(other),
                         static_cast<std::int8_t>(d), static_cast<std::int8_t>(steps), inside});
      }
    }
  }
  template <class T, class Known>
  static void require_known(const NarrowBand<T, D>& band, const JumpLeg& leg, Known&& known) {
    for (const std::size_t end : {leg.here, leg.far}) {
      if (known(end / band.volume, end % band.volume)) continue;
      throw InterfaceError(message("the node at ", position(band, leg),
                                   " is next to the interface but has no closest point: the interface is not resolved "
                                   "there; refine the lattice"));
    }
  }
  template <class T>
  void examine(const NarrowBand<T, D>& band, const BandGeometry<T, D>& geometry, const JumpLeg& leg,
               UnresolvedLegs unresolved) {
    if (std::abs(leg.steps) > 1) return;
    const auto normal = [&](std::size_t end) { return geometry.normal.block(end / band.volume)[end % band.volume]; };
    if (static_cast<double>(dot(normal(leg.here), normal(leg.far))) >= least_cosine) return;
    if (unresolved == UnresolvedLegs::reject) {
      throw InterfaceError(
          message("the interface turns or comes back within a spacing near ", position(band, leg),
                  ", so that a leg of the stencil is crossed by two parts of it: refine the lattice, or "
                  "ask for UnresolvedLegs::keep"));
    }
    ++unresolved_;
  }
  template <class T>
  static Vec<D> position(const NarrowBand<T, D>& band, const JumpLeg& leg) {
    return band.lattice().position(band.lattice().node(leg.node));
  }

  std::vector<JumpLeg> legs_;
  std::vector<std::size_t> begin_{0};
  std::size_t unresolved_ = 0;
};

}  // namespace detail
}  // namespace cambium
