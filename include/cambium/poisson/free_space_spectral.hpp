// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/free_space_convolution.hpp>
#include <cambium/poisson/periodic.hpp>

namespace cambium {

/// Poisson's equation -Lap u = f in free space and the gradient of u, both with errors that fall faster than any power
/// of the spacing for smooth f that vanish towards the faces; D = 2 and 3.
///
///     cambium::FreeSpaceSpectral<3> poisson(lattice);
///     poisson.solve(f, u, g);
///
/// u is that of FreeSpaceConvolution with the SpectralKernel. The derivatives of the convolution are convolutions of
/// the derivatives of f, which are those of a periodic function: f is zero where the period ends. So the gradient costs
/// D more convolutions. Plans are made with the object, buffers at the first gradient.
template <int D, class T = double, Execution E = OpenMP>
class FreeSpaceSpectral {
 public:
  static constexpr int dimension = D;

  /// \throws LatticeError unless the lattice is bounded along every axis
  explicit FreeSpaceSpectral(const Lattice<D>& lattice, const E& execution = {})
      : execution_(execution),
        convolution_(lattice, execution),
        period_(lattice.box(), lattice.spacing(), whole_period()),
        derivative_(period_, {}, execution) {}

  const Lattice<D>& lattice() const { return convolution_.lattice(); }

  /// \throws SizeError if a field is not on the lattice of the solver \throws ValueError if a value is not finite; the
  ///         results are unchanged then
  void solve(const Field<T, D>& f, Field<T, D>& u) { convolution_.solve(f, u); }
  /// The same with g = grad u.
  void solve(const Field<T, D>& f, Field<T, D>& u, Field<Vec<D, T>, D>& g) {
    if (!(g.lattice() == lattice()) || !(f.lattice() == lattice())) {
      throw SizeError("a field is not on the lattice this Poisson solver was made for: make one solver per lattice");
    }
    if (work_.empty()) work_.emplace_back(lattice());
    if (wrapped_.empty()) wrapped_.emplace_back(period_);
    if (slope_.empty()) slope_.emplace_back(period_);
    detail::require_finite(f, execution_);
    for_each(execution_, period_.size(), [&](std::size_t i) { wrapped_[0][i] = f(period_.node(i)); });
    convolution_.solve(f, u);
    derivative_.gradient(wrapped_[0], slope_[0]);
    for (int d = 0; d < D; ++d) {
      for_each(execution_, work_[0].size(), [&](std::size_t i) {
        Index<D> node = lattice().node(i);
        for (int e = 0; e < D; ++e) node[e] = node[e] == period_.nodes()[e] ? 0 : node[e];
        work_[0][i] = slope_[0](node)[d];
      });
      convolution_.solve(work_[0], work_[0]);
      for_each(execution_, work_[0].size(), [&](std::size_t i) { g[i][d] = work_[0][i]; });
    }
  }

 private:
  static std::array<bool, D> whole_period() {
    std::array<bool, D> result;
    result.fill(true);
    return result;
  }

  E execution_;
  FreeSpaceConvolution<D, SpectralKernel, T, E> convolution_;
  Lattice<D> period_;
  PeriodicPoisson<D, Spectral, T, E> derivative_;
  std::vector<Field<T, D>> work_;
  std::vector<Field<T, D>> wrapped_;
  std::vector<Field<Vec<D, T>, D>> slope_;
};

}  // namespace cambium
