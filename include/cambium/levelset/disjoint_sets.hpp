// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cambium::detail {

/// Sets of items 0, ..., n - 1 that grow together (Tarjan 1975); every set is known by its smallest item.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t items) : parent_(items) {
    for (std::size_t i = 0; i < items; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    (a < b ? parent_[b] : parent_[a]) = static_cast<std::uint32_t>(a < b ? a : b);
  }
  /// True if i stands for its set.
  bool stands_for_set(std::size_t i) const { return parent_[i] == i; }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace cambium::detail
