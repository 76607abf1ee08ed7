// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium {

/// |grad phi| at the nodes next to the interface, by the steeper of the two differences along each axis, which is right
/// at ridges, too: 1 where phi is a distance.
struct Slopes {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  /// Mean over the nodes of |log2 |grad phi||: 0 for a distance, 1 if slopes are doubled or halved.
  double mean_octaves = 0.0;
};

/// The nodes next to the interface, as points that can be moved: where they go, the interface goes.
template <class T, int D>
class Front {
 public:
  using Band = NarrowBand<T, D>;

  /// Takes the nodes of `band` that have a neighbour on the other side.
  template <Execution E>
  void take(const Band& band, const E& execution) {
    patches_.resize(static_cast<std::size_t>(execution.count()));
    if (of_block_.size() < band.blocks()) of_block_.resize(band.blocks());  // what is longer keeps its memory
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      patches_[worker].read_block(band, b, 1);
      take_block(band, patches_[worker], b);
    });
    gather(band);
  }

  const Lattice<D>& lattice() const { return *lattice_; }
  std::size_t size() const { return x_[0].size(); }
  /// Positions, to be moved.
  Columns<D, T> positions() {
    std::array<T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = x_[d].data();
    return {first, size()};
  }
  const Slopes& slopes() const { return slopes_; }
  /// Largest distance between points that were neighbouring nodes, in spacings.
  double stretch(double spacing) const {
    double largest = 0.0;
    for (const std::size_t p : pairs_) {
      double square = 0.0;
      for (int d = 0; d < D; ++d) square += std::pow(static_cast<double>(x_[d][p + 1] - x_[d][p]), 2);
      largest = std::max(largest, square);
    }
    return std::sqrt(largest) / spacing;
  }

 private:
  /// What one block gives.
  struct Share {
    std::vector<std::size_t> node;
    Slopes slopes;
  };

  void take_block(const Band& band, const Patch<T, D>& patch, std::size_t b) {
    Share& share = of_block_[b];
    share.node.clear();
    share.slopes = {};
    for (std::size_t i = 0; i < Band::volume; ++i) {
      const std::ptrdiff_t at = patch.entry(i);
      bool crossed = false;
      double square = 0.0;
      for (int d = 0; d < D; ++d) {
        const T before = patch[at - patch.stride()[d]];
        const T behind = patch[at + patch.stride()[d]];
        crossed |= (before < T(0)) != (patch[at] < T(0)) || (behind < T(0)) != (patch[at] < T(0));
        const T steepest = std::max(std::abs(behind - patch[at]), std::abs(patch[at] - before));
        square += std::pow(static_cast<double>(steepest) / band.spacing(), 2);
      }
      if (!crossed || !band.lattice().contains(band.values().node(b, i))) continue;
      share.node.push_back(i);
      share.slopes.smallest = std::min(share.slopes.smallest, std::sqrt(square));
      share.slopes.largest = std::max(share.slopes.largest, std::sqrt(square));
      share.slopes.mean_octaves += std::abs(0.5 * std::log2(square));
    }
  }
  void gather(const Band& band) {
    lattice_ = band.lattice();
    for (auto& column : x_) column.clear();
    pairs_.clear();
    slopes_ = {};
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      const Share& share = of_block_[b];
      slopes_.smallest = std::min(slopes_.smallest, share.slopes.smallest);
      slopes_.largest = std::max(slopes_.largest, share.slopes.largest);
      slopes_.mean_octaves += share.slopes.mean_octaves;
      for (std::size_t k = 0; k < share.node.size(); ++k) {
        const Vec<D> x = band.lattice().position(band.values().node(b, share.node[k]));
        if (k + 1 < share.node.size() && share.node[k + 1] == share.node[k] + 1 &&
            share.node[k + 1] % Band::extent != 0) {
          pairs_.push_back(size());
        }
        for (int d = 0; d < D; ++d) x_[d].push_back(static_cast<T>(x[d]));
      }
    }
    if (size() > 0) slopes_.mean_octaves /= static_cast<double>(size());
  }

  std::array<AlignedVector<T>, D> x_;
  std::vector<std::size_t> pairs_;
  std::vector<Share> of_block_;
  std::vector<Patch<T, D>> patches_;
  Slopes slopes_;
  std::optional<Lattice<D>> lattice_;
};

}  // namespace cambium
