// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/box.hpp>
#include <cambium/poisson/free_space_convolution.hpp>

namespace cambium {

/// Poisson's equation -Lap u = f in free space, D = 2 and 3, in two steps that need not agree on what a source is:
/// values at the faces of the box by convolution with Kernel, then the difference equations inside with these as
/// Dirichlet values. Second order. FreeSpacePoisson takes values that fit the difference equations, and is faster; this
/// serves for comparison with methods that take them from point sources. Arguments and results may be the same field.
template <int D, class Kernel = PointKernel, class T = double, Execution E = OpenMP>
class FreeSpaceDirichlet {
 public:
  static constexpr int dimension = D;

  /// \throws LatticeError unless the lattice is bounded and has a node between its faces along every axis
  explicit FreeSpaceDirichlet(const Lattice<D>& lattice, const E& execution = {})
      : convolution_(lattice, execution), box_(lattice, dirichlet(), {}, execution), work_(lattice) {}

  const Lattice<D>& lattice() const { return work_.lattice(); }

  /// \throws SizeError if a field is not on the lattice of the solver \throws ValueError if a value is not finite; u is
  ///         unchanged then
  void solve(const Field<T, D>& f, Field<T, D>& u) {
    if (!(u.lattice() == lattice())) {
      throw SizeError("a field is not on the lattice this Poisson solver was made for: make one solver per lattice");
    }
    convolution_.solve(f, work_);
    box_.solve(f, work_);
    std::copy(work_.values().begin(), work_.values().end(), u.values().begin());
  }

 private:
  static std::array<Boundary, D> dirichlet() {
    std::array<Boundary, D> result;
    result.fill(Boundary::dirichlet);
    return result;
  }

  FreeSpaceConvolution<D, Kernel, T, E> convolution_;
  BoxPoisson<D, SecondOrder, T, E> box_;
  Field<T, D> work_;
};

}  // namespace cambium
