// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/core/sparse.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium {

/// Calls f(node, value) for every node of a dense field; value is a reference.
template <class T, int D, class F, Execution E = OpenMP>
void for_each_node(Field<T, D, Dense>& field, F&& f, const E& execution = {}) {
  for_each(execution, field.size(), [&](std::size_t i) { f(field.lattice().node(i), field[i]); });
}

/// Calls f(node, value) for every lattice node in the active blocks of a sparse field; value is a reference.
template <class T, int D, class F, Execution E = OpenMP>
void for_each_node(Field<T, D, Sparse>& field, F&& f, const E& execution = {}) {
  for_each_block(
      field,
      [&](std::size_t b) {
        const auto values = field.block(b);
        for (std::size_t i = 0; i < values.size(); ++i) {
          const Index<D> node = field.node(b, i);
          if (field.lattice().contains(node)) f(node, values[i]);
        }
      },
      execution);
}

/// Calls f(b) for every active block of a sparse field.
template <class T, int D, class F, Execution E = OpenMP>
void for_each_block(const Field<T, D, Sparse>& field, F&& f, const E& execution = {}) {
  for_each_piece(execution, field.blocks(), 1, [&](std::size_t b, std::size_t) { f(b); });
}

}  // namespace cambium
