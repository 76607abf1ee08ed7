// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <tuple>

namespace cambium {

/// Options of Remesher.
struct RemeshParams {
  /// A new particle is made at a node if one of its strengths, in any component, is at least this in magnitude. With 0,
  /// every node gets a particle.
  double threshold = 0.0;
};

/// What a remeshing did. For every attribute: total before = total of the new particles + dropped, to round-off.
template <class... V>
struct RemeshReport {
  /// Number of new particles.
  std::size_t created = 0;
  /// Number of nodes that got no particle.
  std::size_t dropped_nodes = 0;
  /// Sum of the strengths of the nodes that got no particle, one entry for each remeshed attribute.
  std::tuple<V...> dropped{};
};

/// Remeshing by the product kernel: every particle to the support^D nodes around it. For any particles.
struct Tensor {};

/// Remeshing by one-dimensional passes along the axes, D * support operations instead of support^D. For particles that
/// left the nodes of a whole lattice, in its order. See SplitPass.
struct Split {};

}  // namespace cambium
