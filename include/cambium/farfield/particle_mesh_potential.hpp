// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/interpolation/interpolator.hpp>
#include <cambium/kernels/m6.hpp>
#include <cambium/operators/differences.hpp>
#include <cambium/poisson/free_space.hpp>

namespace cambium {

/// Potential in free space of particles at their own places, and its gradient, through a mesh: strengths to the mesh
/// with Kernel, -Lap u = f there by Solver, u and grad u back with Kernel, as one call.
///
///     cambium::ParticleMeshPotential<3> far(lattice);
///     far.evaluate(x, q, potential, gradient);
///
/// Sources are smeared over the kernel's support: what particles that carry a density, q_p = f(x_p) volume_p, should
/// have, and without the singularity of point sources. Solver is any with solve(f, u) on a bounded lattice, made as
/// Solver(lattice, execution): FreeSpacePoisson, FreeSpaceConvolution, FreeSpaceSpectral, ... If it has solve(f, u, g),
/// the gradient at nodes is its; otherwise it comes from centred differences of order `GradientOrder`, one-sided at the
/// faces.
/// With a symmetric solver, as these are, <q1, u[q2]> = <u[q1], q2>; and if f is zero on and next to the faces,
/// differences of the solutions of FreeSpacePoisson make no net force, sum_p q_p grad u_p = 0; both to round-off.
///
/// Plans are made with the object and buffers are kept; the same bits for any number of threads. evaluate() \throws
/// PositionError if a particle is outside the box of the mesh \throws ValueError if a strength is not finite \throws
/// SizeError if lengths differ; results are unchanged then.
template <int D, RemeshingKernel Kernel = M6, class Solver = FreeSpacePoisson<D>, int GradientOrder = 2,
          class T = double, Execution E = OpenMP>
class ParticleMeshPotential {
 public:
  static constexpr int dimension = D;

  /// \throws LatticeError if the lattice is periodic or too small for kernel, solver or differences
  explicit ParticleMeshPotential(const Lattice<D>& lattice, const E& execution = {})
      : execution_(execution), solver_(lattice, execution), source_(lattice), potential_(lattice), gradient_(lattice) {
    detail::require_room_for_kernel<Kernel>(lattice);
    require_room_for_differences<GradientOrder>(lattice);
  }

  const Lattice<D>& lattice() const { return source_.lattice(); }

  /// potential := u at the particles
  template <class P>
  void evaluate(Columns<D, const P> x, std::span<const T> strength, std::span<T> potential) {
    require_size(potential.size(), x.size(), "the array of potentials");
    place(x, strength);
    solver_.solve(source_, potential_);
    interpolator_.m2p(potential_, place_of<P>(), Columns<1, T>(potential), execution_);
  }
  /// The same with the gradient.
  template <class P>
  void evaluate(Columns<D, const P> x, std::span<const T> strength, std::span<T> potential, Columns<D, T> gradient) {
    require_size(potential.size(), x.size(), "the array of potentials");
    require_size(gradient.size(), x.size(), "the array of gradients");
    place(x, strength);
    if constexpr (requires { solver_.solve(source_, potential_, gradient_); }) {
      solver_.solve(source_, potential_, gradient_);
    } else {
      solver_.solve(source_, potential_);
      CentredDifference<GradientOrder>::gradient(potential_, gradient_, execution_);
    }
    interpolator_.m2p(potential_, place_of<P>(), Columns<1, T>(potential), execution_);
    interpolator_.m2p(gradient_, place_of<P>(), gradient, execution_);
  }

  /// What the last evaluation found at the nodes.
  const Field<T, D>& potential() const { return potential_; }

 private:
  /// Places the particles and spreads their strengths: source_ := density of strength.
  template <class P>
  void place(Columns<D, const P> x, std::span<const T> strength) {
    require_size(strength.size(), x.size(), "the array of strengths");
    require_finite(strength, "strength", execution_);
    place_of<P>().update(lattice(), x, execution_);
    interpolator_.p2m(place_of<P>(), Columns<1, const T>(strength), source_, execution_);
    const T scale = static_cast<T>(std::pow(lattice().spacing(), -D));
    for_each(execution_, source_.size(), [&](std::size_t i) { source_[i] *= scale; });
  }
  template <class P>
  auto& place_of() {
    return std::get<Placement<Kernel, D, P>>(placements_);
  }

  E execution_;
  Solver solver_;
  Interpolator<Kernel> interpolator_;
  std::tuple<Placement<Kernel, D, float>, Placement<Kernel, D, double>> placements_;
  Field<T, D> source_;
  Field<T, D> potential_;
  Field<Vec<D, T>, D> gradient_;
};

}  // namespace cambium
