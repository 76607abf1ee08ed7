// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <cambium/levelset/band_builder.hpp>
#include <cambium/levelset/shapes/shape.hpp>

namespace cambium::detail {

/// Samples a function on the blocks of a band around its zero set.
///
/// A function of bounded slope is not called in boxes of nodes that the value in their middle shows to lie on one side:
/// the blocks found are the same, at a cost that grows with the area of the interface and not with the box.
template <class T, int D, class F>
class Sampler {
 public:
  using Band = NarrowBand<T, D>;

  Sampler(const Band& band, F& f) : band_(band), f_(f) {}

  /// Marks the blocks with nodes within `width` spacings of the interface.
  template <Execution E>
  void mark(BlockMarks<D>& marks, double width, const E& execution) const {
    const Index<D> grid = band_.values().block_grid();
    std::vector<std::uint8_t> crossed(static_cast<std::size_t>(product(grid)));
    Index<D> groups;
    for (int d = 0; d < D; ++d) groups[d] = (grid[d] + group - 1) / group;
    for_each_piece(execution, static_cast<std::size_t>(product(groups)), 1, [&](std::size_t k, std::size_t) {
      const Index<D> low = unfold(k, groups) * group;
      Index<D> high;
      for (int d = 0; d < D; ++d) high[d] = std::min(low[d] + group, grid[d]) - 1;
      find_crossed(low, high, crossed);
    });
    std::vector<Index<D>> blocks;
    for (std::size_t k = 0; k < crossed.size(); ++k) {
      if (crossed[k]) blocks.push_back(unfold(k, grid));
    }
    // A point of the interface is at most a diagonal away from the first node of a crossed edge of its cell.
    const BlockReach<D> reach(band_.lattice(), width + std::sqrt(static_cast<double>(D)));
    std::vector<typename BlockReach<D>::Set> near(blocks.size(), reach.empty_set());
    for_each_piece(execution, blocks.size(), 1,
                   [&](std::size_t k, std::size_t) { add_near(blocks[k], reach, near[k]); });
    marks.clear();
    for (std::size_t k = 0; k < blocks.size(); ++k) marks.mark(blocks[k], reach, near[k]);
  }

  /// Gives the nodes of block b their values; nodes beyond the lattice take that of the node on the face, or of their
  /// image. Boxes of nodes that are known to be further than `width` from the interface become +-half width.
  /// \throws ValueError if the function is not finite
  void fill(Band& band, std::size_t b, double width) const {
    const Index<D> origin = band.values().block_origin(b);
    std::array<std::array<double, static_cast<std::size_t>(Band::extent)>, static_cast<std::size_t>(D)> coordinate;
    for (int d = 0; d < D; ++d) {
      for (std::ptrdiff_t i = 0; i < Band::extent; ++i) {
        coordinate[d][static_cast<std::size_t>(i)] = position(origin + Index<D>::unit(d, i))[d];
      }
    }
    const auto values = band.values().block(b);
    const Index<D> boxes = Index<D>::constant(Band::extent / fill_edge), edge = Index<D>::constant(fill_edge);
    for (std::size_t k = 0; k < static_cast<std::size_t>(product(boxes)); ++k) {
      const Index<D> first = unfold(k, boxes) * fill_edge, last = first + Index<D>::constant(fill_edge - 1);
      const unsigned side = in_lattice(origin + last) ? one_side(origin + first, origin + last, width) : 0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(product(edge)); ++i) {
        const Index<D> local = first + unfold(i, edge);
        T& value = values[band.values().offset(local)];
        Vec<D> x;
        for (int d = 0; d < D; ++d) x[d] = coordinate[d][static_cast<std::size_t>(local[d])];
        value = side == 0 ? static_cast<T>(finite_value(x)) : side == negative ? -band.half_width() : band.half_width();
      }
    }
  }

 private:
  static constexpr bool bounded = BoundedSlope<F, D>;
  /// Blocks along an edge of the boxes that are asked first, each of which is a piece of work.
  static constexpr std::ptrdiff_t group = bounded ? 4 : 1;
  /// Nodes along an edge of the boxes that are filled at once.
  static constexpr std::ptrdiff_t fill_edge = 4;
  static constexpr unsigned negative = 1, positive = 2, both = 3;

  static Index<D> unfold(std::size_t k, const Index<D>& count) {
    Index<D> result;
    for (int d = 0; d < D; ++d) {
      result[d] = static_cast<std::ptrdiff_t>(k) % count[d];
      k /= static_cast<std::size_t>(count[d]);
    }
    return result;
  }
  Vec<D> position(const Index<D>& node) const { return band_.lattice().position(band_.inside(node)); }
  double finite_value(const Vec<D>& x) const {
    const auto value = static_cast<double>(f_(x));
    if (!std::isfinite(value)) {
      throw ValueError(message("the function that the level set is built from is ", value, " at ", x,
                               ": it must be finite in the whole box"));
    }
    return value;
  }
  /// Halves of a box of nodes or blocks, cut across its longest edge.
  static void halve(const Index<D>& low, const Index<D>& high, Index<D>& end_of_first, Index<D>& begin_of_second) {
    int longest = 0;
    for (int d = 1; d < D; ++d) longest = high[d] - low[d] > high[longest] - low[longest] ? d : longest;
    end_of_first = high;
    begin_of_second = low;
    end_of_first[longest] = low[longest] + (high[longest] - low[longest]) / 2;
    begin_of_second[longest] = end_of_first[longest] + 1;
  }

  void find_crossed(const Index<D>& low, const Index<D>& high, std::vector<std::uint8_t>& crossed) const {
    const Index<D> first = low * Band::extent;
    const Index<D> last = (high + Index<D>::constant(1)) * Band::extent;
    if (low == high) {
      std::ptrdiff_t number = 0;
      for (int d = D - 1; d >= 0; --d) number = number * band_.values().block_grid()[d] + low[d];
      crossed[static_cast<std::size_t>(number)] = signs(first, last) == both;
      return;
    }
    if (in_lattice(last) && one_side(first, last) != 0) return;
    Index<D> end, begin;
    halve(low, high, end, begin);
    find_crossed(low, end, crossed);
    find_crossed(begin, high, crossed);
  }
  /// Adds what is near the nodes of a block whose next node along an axis is on the other side.
  void add_near(const Index<D>& block, const BlockReach<D>& reach, typename BlockReach<D>::Set& set) const {
    const Index<D> edge = Index<D>::constant(Band::extent + 1);
    std::array<bool, static_cast<std::size_t>(product(Index<D>::constant(Band::extent + 1)))> inside{};
    for (std::size_t k = 0; k < inside.size(); ++k) {
      inside[k] = static_cast<T>(finite_value(position(block * Band::extent + unfold(k, edge)))) < T(0);
    }
    for (std::size_t k = 0; k < inside.size(); ++k) {
      const Index<D> local = unfold(k, edge);
      bool own = true, crossed = false;
      std::size_t pitch = 1;
      for (int d = 0; d < D; ++d, pitch *= static_cast<std::size_t>(edge[0])) {
        own &= local[d] < Band::extent;
        crossed |= own && inside[k] != inside[k + pitch];
      }
      if (own && crossed) reach.add(band_.values().offset(local), set);
    }
  }
  bool in_lattice(const Index<D>& node) const { return band_.lattice().contains(node); }

  /// Signs at the nodes first, ..., last, which may lie behind the lattice.
  unsigned signs(Index<D> first, Index<D> last) const {
    for (int d = 0; d < D; ++d) {
      const std::ptrdiff_t n = band_.lattice().nodes()[d];
      if (last[d] < n) continue;
      if (!band_.lattice().periodic(d)) {
        last[d] = n - 1;
      } else if (last[d] - first[d] + 1 >= n) {
        first[d] = 0;
        last[d] = n - 1;
      } else {  // a function of the position is not continuous across the face
        Index<D> image = first, end = last;
        image[d] = 0;
        end[d] = n - 1;
        last[d] -= n;
        const unsigned here = signs(first, end);
        return here == both ? both : here | signs(image, last);
      }
    }
    return signs_inside(first, last);
  }
  unsigned signs_inside(const Index<D>& first, const Index<D>& last) const {
    const Index<D> edge = last - first + Index<D>::constant(1);
    if (bounded && product(edge) > 8) {
      if (const unsigned side = one_side(first, last)) return side;
      Index<D> end, begin;
      halve(first, last, end, begin);
      const unsigned here = signs_inside(first, end);
      return here == both ? both : here | signs_inside(begin, last);
    }
    unsigned found = 0;
    for (std::ptrdiff_t k = 0; k < product(edge) && found != both; ++k) {
      const auto value = static_cast<T>(finite_value(position(first + unfold(static_cast<std::size_t>(k), edge))));
      found |= value < T(0) ? negative : positive;
    }
    return found;
  }
  /// The side that the box of nodes first, ..., last is known to lie on, and further than `width` from the interface,
  /// from the value in its middle; or 0.
  unsigned one_side(const Index<D>& first, const Index<D>& last, double width = 0.0) const {
    if constexpr (bounded) {
      const Vec<D> low = band_.lattice().position(first), high = band_.lattice().position(last);
      const double value = finite_value((low + high) * 0.5);
      // The margin keeps round-off from deciding.
      const double radius = (0.5 * norm(high - low) + width) * (1.0 + 1e-6);
      if (std::abs(value) > static_cast<double>(F::lipschitz) * radius) return value < 0.0 ? negative : positive;
    }
    (void)first, (void)last, (void)width;
    return 0;
  }

  const Band& band_;
  F& f_;
};

/// True if a block has nodes within `distance` nodes of a face of the box.
template <class T, int D>
bool near_face(const NarrowBand<T, D>& band, std::size_t b, std::ptrdiff_t distance) {
  const Index<D> origin = band.values().block_origin(b);
  for (int d = 0; d < D; ++d) {
    const std::ptrdiff_t nodes = band.lattice().nodes()[d];
    if (origin[d] <= distance || origin[d] + band.extent + distance >= nodes) return true;
  }
  return false;
}

/// \throws InterfaceError if the interface is within `distance` nodes of a bounded face
template <class T, int D>
void check_walls(const NarrowBand<T, D>& band, std::ptrdiff_t distance) {
  std::array<std::array<unsigned, 2>, static_cast<std::size_t>(D)> found{};
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    if (!near_face(band, b, distance)) continue;
    for (std::size_t i = 0; i < band.volume; ++i) {
      const Index<D> node = band.values().node(b, i);
      if (!band.lattice().contains(node)) continue;
      for (int d = 0; d < D; ++d) {
        if (band.lattice().periodic(d)) continue;
        for (const int face : {0, 1}) {
          const std::ptrdiff_t depth = face == 0 ? node[d] : band.lattice().nodes()[d] - 1 - node[d];
          if (depth > distance) continue;
          unsigned& signs = found[static_cast<std::size_t>(d)][static_cast<std::size_t>(face)];
          signs |= band.values().block(b)[i] < T(0) ? 1U : 2U;
          if (signs != 3U) continue;
          throw InterfaceError(message("the interface is within ", distance, " nodes of the ",
                                       face == 0 ? "lower" : "upper", " face of the box along axis ", d, ", near ",
                                       band.lattice().position(node),
                                       ": move the shape away from it or enlarge the box"));
        }
      }
    }
  }
}

/// \throws InterfaceError if phi, of slope at most `slope`, changes sign across a periodic face by a jump
template <class T, int D>
void check_seams(const NarrowBand<T, D>& band, double slope) {
  const double most = slope * band.spacing() * (1.0 + 1e-3);
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    if (!near_face(band, b, 0)) continue;
    for (std::size_t i = 0; i < band.volume; ++i) {
      const Index<D> node = band.values().node(b, i);
      if (!band.lattice().contains(node)) continue;
      for (int d = 0; d < D; ++d) {
        if (!band.lattice().periodic(d) || node[d] + 1 < band.lattice().nodes()[d]) continue;
        Index<D> next = node;
        next[d] = 0;
        const auto here = static_cast<double>(band.values().block(b)[i]), there = static_cast<double>(band(next));
        if ((here < 0.0) == (there < 0.0) || std::abs(here - there) <= most) continue;
        throw InterfaceError(message("the shape ends at the periodic face along axis ", d, " near ",
                                     band.lattice().position(node), ": give it its images, repeat(shape, domain)"));
      }
    }
  }
}

}  // namespace cambium::detail
