// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <cambium/core/sparse.hpp>
#include <cambium/kernels/taps.hpp>

namespace cambium::detail {

/// Nodes that the stencils of one cell of the lattice read, and where they are in the patch of the cell's block.
/// \tparam Stencil  see SurfaceLaplacian
template <class Stencil, int D>
class StencilBox {
 public:
  static constexpr std::ptrdiff_t before = Taps<typename Stencil::Kernel>::before;
  static constexpr std::ptrdiff_t support = Stencil::Kernel::support;
  static constexpr std::ptrdiff_t reach = Stencil::reach;
  /// Nodes along an edge of the patch of a whole block.
  static constexpr std::ptrdiff_t edge = BlockShape<D>::extent + support - 1 + 2 * reach;
  /// Nodes of a box at most.
  static constexpr auto most = static_cast<std::size_t>(product(Index<D>::constant(support + 2 * reach)));

  struct Node {
    Index<D> step;      ///< from the first node of the cell
    std::size_t entry;  ///< of a patch, for the first cell of a block
  };

  StencilBox() {
    const Index<D> size = Index<D>::constant(support + 2 * reach);
    for (std::ptrdiff_t k = 0; k < product(size); ++k) {
      Node node{{}, 0};
      std::ptrdiff_t rest = k, pitch = 1;
      int outside = 0;
      for (int d = 0; d < D; ++d, pitch *= edge) {
        const std::ptrdiff_t i = rest % size[d];
        rest /= size[d];
        outside += i < reach || i >= support + reach ? 1 : 0;
        node.step[d] = i - before - reach;
        node.entry += static_cast<std::size_t>(i * pitch);
      }
      if (outside <= Stencil::axes) nodes_.push_back(node);
    }
  }

  std::size_t size() const { return nodes_.size(); }
  const Node& operator[](std::size_t n) const { return nodes_[n]; }
  /// Entry of a patch of a whole block.
  static std::size_t entry_of(const Index<D>& in_patch) {
    std::ptrdiff_t at = 0;
    for (int d = D - 1; d >= 0; --d) at = at * edge + in_patch[d];
    return static_cast<std::size_t>(at);
  }

 private:
  std::vector<Node> nodes_;
};

}  // namespace cambium::detail
