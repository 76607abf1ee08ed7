// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/interface/dirichlet_levels.hpp>
#include <cambium/multigrid/matrix_entries.hpp>
#include <cambium/multigrid/red_black.hpp>

#include "dirichlet/scene.hpp"
#include "petsc/petsc.hpp"

namespace bench {

/// The matrix and the right-hand side of the equations that Dirichlet solves inside a shape, for other solvers.
template <class Shape>
struct Equations {
  petsc::Matrix matrix;
  std::vector<double> right;

  explicit Equations(const Scene<3, Shape>& scene) {
    const Lattice<3>& lattice = scene.lattice;
    detail::DirichletLevels<3, RedBlack, OpenMP> levels(lattice, {}, {}, OpenMP{1});
    levels.update(scene.level_set.band(), Side::inside, 0.0);
    take_matrix(levels.finest());
    right.resize(static_cast<std::size_t>(levels.finest().count));
    const double square = lattice.spacing() * lattice.spacing();
    for (const auto& run : levels.finest().unknowns) {
      const std::size_t first = lattice.number(run.node);
      for (std::ptrdiff_t i = 0; i < run.count; ++i) {
        right[static_cast<std::size_t>(run.number + i)] = square * scene.f[first + static_cast<std::size_t>(i)];
      }
    }
    const auto& domain = levels.domain();
    auto node = domain.nodes.begin();
    detail::for_each_unknown(levels.finest(), Serial{}, [&](std::size_t at, std::size_t number) {
      if (node == domain.nodes.end() || node->at != at) return;
      const detail::CutWeights<3> weights(*node, levels.finest().diagonal, 0.0);
      right[number] *= weights.scale;
      for (std::size_t k = 0; k < 6; ++k) {
        if (node->leg[k] < 0.0) continue;
        Vec<3> x = lattice.position(node->node);
        x[static_cast<int>(k / 2)] += (k % 2 == 0 ? -1.0 : 1.0) * node->leg[k] * lattice.spacing();
        right[number] += weights.leg[k] * Scene<3, Shape>::Problem::value(x);
      }
      ++node;
    });
  }
  /// out := A in
  void apply(const double* in, double* out) const {
    for (std::size_t i = 0; i < right.size(); ++i) {
      double sum = 0.0;
      for (int k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
        const auto entry = static_cast<std::size_t>(k);
        sum += matrix.value[entry] * in[matrix.column[entry]];
      }
      out[i] = sum;
    }
  }

 private:
  void take_matrix(const detail::Level<double, 3>& level) {
    struct Entry {
      int column;
      double value;
    };
    std::vector<std::vector<Entry>> rows(static_cast<std::size_t>(level.count));
    detail::for_each_entry(level, [&](std::ptrdiff_t i, std::ptrdiff_t j, double value) {
      rows[static_cast<std::size_t>(i)].push_back({static_cast<int>(j), value});
    });
    matrix.start.push_back(0);
    for (auto& row : rows) {
      std::ranges::sort(row, {}, &Entry::column);
      for (const Entry& entry : row) {
        matrix.column.push_back(entry.column);
        matrix.value.push_back(entry.value);
      }
      matrix.start.push_back(static_cast<int>(matrix.column.size()));
    }
  }
};

}  // namespace bench
