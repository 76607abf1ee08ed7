// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/poisson/even_convolution.hpp>
#include <cambium/poisson/finite.hpp>
#include <cambium/poisson/free_space_kernels.hpp>

namespace cambium {

/// Poisson's equation -Lap u = f in free space, D = 2 and 3: u = sum over nodes of a kernel times f, at the nodes of a
/// box that holds the source, by transforms of twice the box.
///
///     cambium::FreeSpaceConvolution<3, cambium::SpectralKernel> poisson(lattice);
///     poisson.solve(f, u);
///
/// u decays like 1 / (4 pi r) times the integral of f in space; in the plane it tends to -log(r) / (2 pi) times it.
/// Kernel says which sum: LatticeKernel (difference equations, exactly), PointKernel (second order) or SpectralKernel
/// (smooth sources). A kernel of one's own is a struct with values<D>(cells, h, execution): h^D times the kernel at the
/// offsets 0, ..., cells along each axis, axis 0 fastest. Kernel and plans are made with the object; a solve allocates
/// nothing. Arguments and results may be the same field.
template <int D, class Kernel = LatticeKernel, class T = double, Execution E = OpenMP>
class FreeSpaceConvolution {
 public:
  static constexpr int dimension = D;

  /// \throws LatticeError unless the lattice is bounded along every axis
  explicit FreeSpaceConvolution(const Lattice<D>& lattice, const E& execution = {})
      : lattice_(lattice),
        execution_(execution),
        convolution_(cells(lattice), Kernel::template values<D>(cells(lattice), lattice.spacing(), execution),
                     execution) {}

  const Lattice<D>& lattice() const { return lattice_; }

  /// \throws SizeError if a field is not on the lattice of the solver \throws ValueError if a value is not finite; u is
  ///         unchanged then
  void solve(const Field<T, D>& f, Field<T, D>& u) {
    if (!(f.lattice() == lattice_) || !(u.lattice() == lattice_)) {
      throw SizeError("a field is not on the lattice this Poisson solver was made for: make one solver per lattice");
    }
    detail::require_finite(f, execution_);
    const auto width = static_cast<std::size_t>(lattice_.nodes()[0]);
    const auto height = static_cast<std::size_t>(lattice_.nodes()[1]);
    convolution_(
        [&](std::size_t j, std::size_t k, T* x) { std::copy_n(f.data() + (k * height + j) * width, width, x); },
        [&](std::size_t j, std::size_t k, const T* x) { std::copy_n(x, width, u.data() + (k * height + j) * width); });
  }

 private:
  static Index<D> cells(const Lattice<D>& lattice) {
    for (int d = 0; d < D; ++d) {
      if (lattice.periodic(d)) {
        throw LatticeError(detail::message("lattice is periodic along axis ", d,
                                           ": free space needs one that is bounded along every axis"));
      }
    }
    return lattice.nodes() - Index<D>::constant(1);
  }

  Lattice<D> lattice_;
  E execution_;
  detail::EvenConvolution<D, T, E> convolution_;
};

}  // namespace cambium
