// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include <cambium/core/field.hpp>
#include <cambium/interpolation/remesh_params.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/particles/particles.hpp>

namespace cambium::detail {

/// True if a component of a value reaches the threshold in magnitude.
template <class V>
bool reaches(const V& value, double threshold) {
  for (int c = 0; c < Components<V>::count; ++c) {
    if (std::abs(static_cast<double>(component(value, c))) >= threshold) return true;
  }
  return false;
}

template <class V, class View>
void set_value(const View& view, std::size_t p, const V& value) {
  if constexpr (is_vec<V>) {
    view.set(p, value);
  } else {
    view[p] = value;
  }
}

/// Positions of the nodes [begin, end) that are kept, from place p on.
template <int D, class P, class Kept>
void place_positions(Columns<D, P> positions, const Lattice<D>& lattice, std::size_t p, std::size_t begin,
                     std::size_t end, Kept&& kept) {
  Index<D> node = lattice.node(begin);
  for (std::size_t i = begin; i < end;) {
    const std::size_t row_end = std::min(end, i + static_cast<std::size_t>(lattice.nodes()[0] - node[0]));
    Vec<D> x = lattice.position(node);
    for (; i < row_end; ++i, ++node[0]) {
      if (!kept(i)) continue;
      x[0] = lattice.position(node)[0];
      for (int d = 0; d < D; ++d) positions.column(d)[p] = static_cast<P>(x[d]);
      ++p;
    }
    for (int d = 0; d < D - 1 && node[d] == lattice.nodes()[d]; ++d) {
      node[d] = 0;
      ++node[d + 1];
    }
  }
}

/// Puts one particle on every node whose strengths reach the threshold.
template <int D, class P, class... V, Execution E>
RemeshReport<V...> place_particles(Particles<D, P>& particles, const Lattice<D>& lattice, double threshold,
                                   const std::tuple<Attribute<V>...>& attributes,
                                   const std::tuple<const Field<V, D>&...>& meshes, const E& execution) {
  constexpr std::size_t piece = 4096;
  const auto kept = [&](std::size_t i) {
    return threshold <= 0.0 ||
           std::apply([&](const auto&... mesh) { return (reaches(mesh[i], threshold) || ...); }, meshes);
  };
  RemeshReport<V...> report;
  std::vector<std::size_t> first((lattice.size() + piece - 1) / piece + 1, 0);
  for_each_piece(execution, lattice.size(), piece, [&](std::size_t begin, std::size_t end) {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) count += kept(i);
    first[begin / piece + 1] = count;
  });
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];
  report.created = first.back();
  report.dropped_nodes = lattice.size() - report.created;
  if (particles.size() != report.created || particles.names().size() != sizeof...(V)) {
    particles.resize(0);
    particles.resize(report.created);
  }
  for_each_piece(execution, lattice.size(), piece, [&](std::size_t begin, std::size_t end) {
    place_positions(particles.positions(), lattice, first[begin / piece], begin, end, kept);
  });
  const auto copy = [&]<std::size_t M>(std::integral_constant<std::size_t, M>) {
    const auto& mesh = std::get<M>(meshes);
    const auto view = particles[std::get<M>(attributes)];
    for_each_piece(execution, lattice.size(), piece, [&](std::size_t begin, std::size_t end) {
      std::size_t p = first[begin / piece];
      for (std::size_t i = begin; i < end; ++i) {
        if (kept(i)) set_value(view, p++, mesh[i]);
      }
    });
    for (std::size_t i = 0; i < mesh.size() && report.dropped_nodes > 0; ++i) {
      if (!kept(i)) std::get<M>(report.dropped) += mesh[i];
    }
  };
  [&]<std::size_t... M>(std::index_sequence<M...>) { (copy(std::integral_constant<std::size_t, M>{}), ...); }
  (std::index_sequence_for<V...>{});
  return report;
}

}  // namespace cambium::detail
