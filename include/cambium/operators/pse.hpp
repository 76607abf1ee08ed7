// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include <cambium/operators/pse_operator.hpp>

namespace cambium {

/// Particle strength exchange: derivatives of a function carried by particles as integrals over their neighbours.
///
///     const cambium::PSE<cambium::Gaussian4> pse(2.0 * h);                // epsilon; overlap h / epsilon = 1/2
///     const auto op = pse.at(domain, particles.positions(), particles[volume]);
///     op.laplacian(particles[strength], particles[rate]);                // dQ/dt = nu * rate
///
/// The error is O(eps^order) + O((h / eps)^m), m as large as the particles' quadrature is smooth; on a lattice the
/// second term is below 1e-11 for h / eps <= 0.5 and limits the accuracy at h / eps > 0.8, 0.6, 0.5 for order 2, 4, 6.
/// The kernel's dimension is that of the positions. Source: Degond & Mas-Gallic, Math. Comp. 53 (1989) 485 and 509;
/// Eldredge, Leonard & Colonius, J. Comput. Phys. 180 (2002) 686.
template <class Kernel>
class PSE {
 public:
  /// \param epsilon  kernel width (length)
  /// \param cutoff   pairs farther apart than cutoff * epsilon are left out
  /// \throws ValueError unless both are positive and finite
  explicit PSE(double epsilon, double cutoff = Kernel::cutoff) : epsilon_(epsilon), cutoff_(cutoff) {
    check_pse_kernel<Kernel>();
    if (!(epsilon > 0.0) || !std::isfinite(epsilon)) {
      throw ValueError(detail::message("PSE kernel width epsilon is ", epsilon, ": it must be a positive length"));
    }
    if (!(cutoff > 0.0) || !std::isfinite(cutoff)) {
      throw ValueError(detail::message("PSE cutoff is ", cutoff, ": it must be a positive number of kernel widths"));
    }
  }

  double epsilon() const { return epsilon_; }
  /// Distance of the farthest pairs.
  double radius() const { return cutoff_ * epsilon_; }

  /// Largest stable explicit Euler step of dq/dt = nu Lap q in D dimensions: 2 eps^2 / (nu M_0). Holds for kernels
  /// without negative Fourier modes on particles whose volumes make a good quadrature; PSEOperator::stable_step()
  /// measures the particles at hand. \throws ValueError unless nu > 0
  template <int D>
  double stable_step(double diffusivity) const {
    return largest_euler_step<Kernel, D>(diffusivity, epsilon_);
  }

  /// The operators on given particles; kernels are evaluated in every use.
  /// \param positions  Columns<D, ...>, read now
  /// \param volumes    one per particle, copied
  /// \throws ValueError if a volume is negative or not finite, or the kernel reaches its own image across a period
  /// \throws SizeError if the arrays differ in length
  /// \throws PositionError if a position is not finite or outside a bounded box
  template <int D, class X, class V, Execution E = OpenMP>
  auto at(const Domain<D>& domain, const X& positions, const V& volumes, const E& execution = {}) const {
    return bind<EvaluatedPairs, D>(domain, detail::const_columns_of(positions), volumes, execution);
  }

  /// The same with kernels evaluated once and kept, for positions that serve several right-hand sides.
  template <int D, class X, class V, Execution E = OpenMP>
  auto stored_at(const Domain<D>& domain, const X& positions, const V& volumes, const E& execution = {}) const {
    return bind<StoredPairs, D>(domain, detail::const_columns_of(positions), volumes, execution);
  }

 private:
  template <template <class, int, class> class Pairs, int D, class P, class V, Execution E>
  auto bind(const Domain<D>& domain, Columns<D, const P> positions, const V& volumes, const E& execution) const {
    static_assert(PSEKernelIn<Kernel, D>, "cambium: this PSE kernel is not made for the dimension of the positions");
    const auto v = detail::const_columns_of(volumes);
    require_size(v.size(), positions.size(), "the array of particle volumes");
    detail::require_volumes(v);
    require_period(domain);
    return PSEOperator<Kernel, D, Pairs<Kernel, D, P>, E>(
        Pairs<Kernel, D, P>(domain, positions, epsilon_, radius(), execution), v, epsilon_, execution);
  }

  template <int D>
  void require_period(const Domain<D>& domain) const {
    for (int d = 0; d < D; ++d) {
      const double period = domain.box.hi[d] - domain.box.lo[d];
      if (!domain.periodic[d] || 2.0 * radius() <= period) continue;
      throw ValueError(detail::message("PSE kernel of radius ", radius(), " (cutoff ", cutoff_, " times epsilon ",
                                       epsilon_, ") is wider than half the period ", period, " along axis ", d,
                                       ": take more particles with a smaller epsilon, or a smaller cutoff"));
    }
  }

  double epsilon_;
  double cutoff_;
};

}  // namespace cambium
