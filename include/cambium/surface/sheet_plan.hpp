// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/sparse.hpp>
#include <cambium/surface/sheet_points.hpp>

namespace cambium::detail {

/// Where the values of a surface band are, and which of them the stencils at the interface read.
///
/// A value belongs to a node and one sheet of the interface. Values are numbered group by group; a group has those
/// whose closest points lie in one block of the lattice and on one sheet, and a patch, a small dense array, that holds
/// all that their stencils read. Lengths in spacings.
template <class T, int D>
struct SheetPlan {
  struct Group {
    std::size_t first_value, values;
    std::size_t first_entry, entries;
    Index<D> edge;   ///< nodes of the patch along each axis
    Index<D> inner;  ///< of these, without the ones that only the Laplacian reads
  };

  /// The first point found on a sheet in a cell of the lattice; stencils of all points there read the same entries.
  struct Anchor {
    Index<D> cell;
    Index<D> in_patch;       ///< first node of the cell in the group's patch
    SheetPoint<T, D> point;  ///< from the first node of the cell
    std::int32_t next;       ///< another one in the same cell, or -1
    std::int32_t group;
  };

  std::vector<Group> groups;
  std::vector<Anchor> anchors;
  std::optional<Field<std::int32_t, D, Sparse>> first_anchor;  ///< by first node of the cell, or -1
  std::vector<Index<D>> node;                                  ///< of each value, inside the lattice
  std::array<AlignedVector<T>, D> offset;                      ///< closest point minus node
  std::array<AlignedVector<T>, D> normal;                      ///< outward unit normal at the closest point
  std::array<AlignedVector<T>, D> place;                       ///< closest point, from entry 0 of the group's patch
  std::vector<std::uint16_t> entry;                            ///< entries of patches to be filled
  std::vector<std::int32_t> source;                            ///< with the values of these numbers
  std::size_t largest_patch = 0;                               ///< entries of the largest patch
  std::size_t second_sheets = 0;  ///< values on a sheet that is not the nearest to their node
  std::size_t folded = 0;         ///< stencil nodes without a closest point on the sheet of the stencil

  std::size_t size() const { return node.size(); }
  Vec<D, T> of(const std::array<AlignedVector<T>, D>& columns, std::size_t k) const {
    Vec<D, T> result;
    for (int d = 0; d < D; ++d) result[d] = columns[d][k];
    return result;
  }
};

}  // namespace cambium::detail
