// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include <cambium/core/field.hpp>
#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/sampler.hpp>
#include <cambium/multigrid/krylov.hpp>

namespace cambium {

/// p = 0 outside an interface, by a change of the right-hand side: GMRES finds the sources at the nodes outside that
/// have a neighbour inside with which the solution of a whole box, or of free space, is zero at these nodes. There are
/// no other sources outside, so that it is zero at all nodes outside. Comparator of Dirichlet<D>(band).
///
///     jump.set(a);                        // [p] = -gamma kappa, JumpMayo or Jump
///     jump.correct(f);
///     cambium::RightHandSideGmres<2> outside(lattice);
///     outside.attach(level_set.band());
///     outside.solve(poisson, f, p);
///
/// The value on the interface comes from the correction of f for the jump, and that needs [dp/dn], which is not known
/// before p is: with [p] alone, the values 0 and gamma kappa hold at nodes that are up to a spacing from the interface.
/// p has first order then, and its normal derivative, the velocity of growth, does not converge. Each iteration is a
/// solve in the whole box, and their number grows as the spacing falls: no preconditioner is used.
///
/// Solvers: solve(f, p) must have one solution (walls with values, free space). In the plane, free space lacks one if
/// the interface has the logarithmic capacity 1. Zero outside needs f to be zero outside but for jumps, and so values
/// at walls.
template <int D, class T = double, class Krylov = GMRES<60>>
class RightHandSideGmres {
 public:
  static_assert(D == 2 || D == 3, "cambium::RightHandSideGmres: the dimension must be 2 or 3");
  static constexpr int dimension = D;

  struct Params {
    double tolerance = 1e-7;  ///< of p at the nodes, relative to what it is there without the sources
    int most_iterations = 300;
  };

  explicit RightHandSideGmres(const Lattice<D>& lattice) : RightHandSideGmres(lattice, Params{}) {}
  RightHandSideGmres(const Lattice<D>& lattice, const Params& params)
      : lattice_(lattice), params_(params), sources_(lattice), image_(lattice), free_(lattice) {}

  const Lattice<D>& lattice() const { return lattice_; }
  /// Numbers of the nodes outside that have a neighbour inside.
  const std::vector<std::size_t>& nodes() const { return nodes_; }
  /// What solve() added to the right-hand side at these nodes.
  const std::vector<T>& sources() const { return strength_; }

  /// Takes a new interface. \throws SizeError if the band is on another lattice; InterfaceError if there is no
  /// interface, or it is within two nodes of a bounded face. solve() cannot be called then
  template <class B>
  void attach(const NarrowBand<B, D>& band) {
    nodes_.clear();
    if (!(band.lattice() == lattice_)) {
      throw SizeError("the band is not on the lattice of this right-hand side: make one object for each lattice");
    }
    detail::check_walls(band, 2);
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      for (std::size_t i = 0; i < band.volume; ++i) {
        const Index<D> node = band.values().node(b, i);
        if (lattice_.contains(node) && band.values().block(b)[i] >= B(0) && beside_inside(band, node)) {
          nodes_.push_back(lattice_.number(node));
        }
      }
    }
    if (nodes_.empty()) throw InterfaceError("the band has no zero crossing: nothing is outside of anything");
    strength_.assign(nodes_.size(), T(0));
    for (T& value : sources_.values()) value = T(0);
  }

  /// \param poisson  any solver of the lattice: poisson.solve(f, p)
  /// \param f        right-hand side, corrected for jumps; it is not changed
  /// \param p        holds what the solver wants (values at walls); becomes the solution
  /// \throws ValueError before attach(), and what the solver throws; SizeError if a field is on another lattice;
  ///         ConvergenceError with the residuals on the way. p is unchanged then. The sources of the last solve are the
  ///         first guess of the next
  template <class Solver>
  SolveReport solve(Solver& poisson, const Field<T, D>& f, Field<T, D>& p) {
    require(f);
    require(p);
    std::ranges::copy(p.values(), free_.values().begin());
    poisson.solve(f, free_);
    right_.resize(nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) right_[k] = -free_[nodes_[k]];
    // At walls, sources alone have the value zero.
    for (T& value : image_.values()) value = T(0);
    using Operator = std::function<void(const T*, T*)>;
    const Operator apply = [&](const T* in, T* out) {
      place(in, sources_);
      poisson.solve(sources_, image_);
      for (std::size_t k = 0; k < nodes_.size(); ++k) out[k] = image_[nodes_[k]];
    };
    const Operator same = [&](const T* in, T* out) { std::copy_n(in, nodes_.size(), out); };
    SolveReport report = solve_krylov<Krylov, T>(apply, same, std::span<const T>(right_), std::span<T>(strength_),
                                                 {params_.tolerance, params_.most_iterations}, krylov_);
    apply(strength_.data(), right_.data());
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = free_[i] + image_[i];
    return report;
  }

 private:
  template <class B>
  static bool beside_inside(const NarrowBand<B, D>& band, const Index<D>& node) {
    for (int d = 0; d < D; ++d) {
      for (const std::ptrdiff_t step : {-1, 1}) {
        if (band(band.inside(node + Index<D>::unit(d, step))) < B(0)) return true;
      }
    }
    return false;
  }
  void place(const T* strength, Field<T, D>& to) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k) to[nodes_[k]] = strength[k];
  }
  void require(const Field<T, D>& field) const {
    if (nodes_.empty()) throw ValueError("there is no interface yet: call attach() first");
    if (field.lattice() == lattice_) return;
    throw SizeError("a field is not on the lattice of this right-hand side: make one object for each lattice");
  }

  Lattice<D> lattice_;
  Params params_;
  std::vector<std::size_t> nodes_;
  std::vector<T> strength_, right_;
  Field<T, D> sources_;
  Field<T, D> image_;
  Field<T, D> free_;  ///< the solution without sources
  KrylovSpace<Krylov, T> krylov_;
};

}  // namespace cambium
