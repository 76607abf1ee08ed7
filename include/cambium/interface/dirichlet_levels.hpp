// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include <cambium/interface/cut_rows.hpp>
#include <cambium/multigrid/hierarchy.hpp>

namespace cambium::detail {

/// The equations of a Dirichlet problem on the nodes of the lattice, in double precision, and on the levels of
/// multigrid, in single precision. Memory is kept when the interface moves.
template <int D, class S, Execution E>
class DirichletLevels {
 public:
  using Kernel = Lambda<4, 4>;  ///< the crossings lie on the zero set of its interpolant

  DirichletLevels(const Lattice<D>& lattice, const std::array<Wall, D>& walls, const S& smoother, const E& execution)
      : execution_(execution),
        finest_(LevelGrid<D>(lattice.nodes(), lattice.periodic(), walls)),
        hierarchy_(smoother, execution) {
    domains_.emplace_back(finest_.grid);
  }

  CutDomain<D>& domain() { return domains_.front(); }
  const CutDomain<D>& domain() const { return domains_.front(); }
  Level<double, D>& finest() { return finest_; }
  const Level<double, D>& finest() const { return finest_; }
  Hierarchy<D, S, float, E>& hierarchy() { return hierarchy_; }

  /// \param shift  s h^2
  /// \throws InterfaceError if the side has no node; update() is to be called again then
  template <class B>
  void update(const NarrowBand<B, D>& band, Side side, double shift) {
    find_kinds(band, side, domain(), execution_);
    domain().find_given();
    if (domain().unknowns == 0) {
      throw InterfaceError(
          "the side of the interface on which an equation is to be solved has no node: the shape is "
          "smaller than a spacing; refine the lattice or leave the equation out");
    }
    find_crossings<Kernel>(band, domain(), execution_);
    take_domain(domain(), shift, finest_);
    finest_.take_arrays();
    auto& levels = hierarchy_.levels();
    std::size_t used = 0;
    for (;;) {
      auto& level = level_of(used);
      if (used == 0) {
        take_runs(finest_, level);
      } else {
        take_domain(domains_[used], shift, level);
      }
      if (level.count <= hierarchy_.few_unknowns || !coarsen_to(++used)) break;
      shift *= 4.0;
    }
    levels.erase(levels.begin() + static_cast<std::ptrdiff_t>(used_levels_), levels.end());
    hierarchy_.settle(false);
  }

 private:
  Level<float, D>& level_of(std::size_t l) {
    auto& levels = hierarchy_.levels();
    used_levels_ = l + 1;
    const LevelGrid<D>& grid = domains_[l].grid;
    if (l == levels.size()) return levels.emplace_back(grid);
    return levels[l];
  }
  /// Makes domain l from the one before. \return false if there is none
  bool coarsen_to(std::size_t l) {
    const CutDomain<D>& fine = domains_[l - 1];
    Index<D> nodes;
    for (int d = 0; d < D; ++d) {
      const bool periodic = fine.grid.periodic[d];
      const std::ptrdiff_t cells = fine.grid.nodes[d] - (periodic ? 0 : 1);
      if (cells < 4 || (cells % 2 != 0 && (periodic || fine.touches[static_cast<std::size_t>(d)]))) return false;
      nodes[d] = (cells + 1) / 2 + (periodic ? 0 : 1);
    }
    // The numbers of nodes follow from those of the lattice: a domain made before has them.
    if (l == domains_.size()) domains_.emplace_back(LevelGrid<D>(nodes, finest_.grid.periodic, finest_.grid.walls));
    coarsen(domains_[l - 1], domains_[l]);
    // Without crossings the coarse equations might be singular.
    return domains_[l].unknowns > 0 && !domains_[l].nodes.empty();
  }

  E execution_;
  Level<double, D> finest_;
  Hierarchy<D, S, float, E> hierarchy_;
  std::vector<CutDomain<D>> domains_;  ///< from fine to coarse; those not used now keep their memory
  std::size_t used_levels_ = 0;
};

}  // namespace cambium::detail
