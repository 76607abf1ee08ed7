// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

#include <cambium/interpolation/interpolator.hpp>
#include <cambium/interpolation/place_particles.hpp>
#include <cambium/interpolation/remesh_params.hpp>
#include <cambium/interpolation/split_plan.hpp>

namespace cambium {

/// Replaces particles by new ones on the nodes of a lattice that carry the same field, eq. 11.17-11.21.
///
///     cambium::Remesher<cambium::M6> remesh({.threshold = 1e-6});
///     auto report = remesh(particles, lattice, strength);
///
/// `Kernel` decides accuracy and smoothness, `Strategy` the way it is applied: Tensor for any particles, Split for
/// those that left a whole lattice. Buffers last between calls. New particles come in the order of the lattice;
/// attributes that are not named start anew from their initial value.
///
/// Errors thrown, particles unchanged: those of Interpolator; for Split also SizeError if the particles are not one for
/// each node, ValueError if they moved past each other.
template <RemeshingKernel Kernel, class Strategy = Tensor, Execution E = OpenMP>
class Remesher;

template <RemeshingKernel Kernel, Execution E>
class Remesher<Kernel, Tensor, E> {
 public:
  explicit Remesher(const RemeshParams& params = {}, const E& execution = {})
      : params_(params), execution_(execution) {}

  /// Replaces the particles by new ones with the strengths of the given attributes remeshed.
  template <int D, class P, class... V>
  RemeshReport<V...> operator()(Particles<D, P>& particles, const Lattice<D>& lattice, Attribute<V>... strengths) {
    static_assert(sizeof...(V) > 0, "cambium::Remesher: name the attributes to be remeshed");
    auto& meshes = meshes_.template get<Meshes<D, V...>>(lattice).fields;
    std::apply([&](auto&... mesh) { (interpolator_.p2m(particles, strengths, mesh, execution_), ...); }, meshes);
    return std::apply(
        [&](const auto&... mesh) {
          return detail::place_particles(particles, lattice, params_.threshold, std::make_tuple(strengths...),
                                         std::tie(mesh...), execution_);
        },
        meshes);
  }

 private:
  template <int D, class... V>
  struct Meshes {
    explicit Meshes(const Lattice<D>& on) : engine{on}, fields(Field<V, D>(on)...) {}
    detail::OnLattice<D> engine;
    std::tuple<Field<V, D>...> fields;
  };

  RemeshParams params_;
  E execution_;
  Interpolator<Kernel> interpolator_;
  detail::PlanStore meshes_;
};

template <RemeshingKernel Kernel, Execution E>
class Remesher<Kernel, Split, E> {
 public:
  explicit Remesher(const RemeshParams& params = {}, const E& execution = {}) : execution_(execution) {
    check_remeshing_kernel<Kernel>();
    if (params.threshold > 0.0) {
      throw ValueError(detail::message("threshold ", params.threshold,
                                       " for split remeshing: it needs a particle on every node, so the threshold must "
                                       "be 0; use the strategy Tensor to leave particles out"));
    }
  }

  /// Replaces the particles, particle i having left node i of the lattice, by new ones on all nodes.
  template <int D, class P, class... V>
  RemeshReport<V...> operator()(Particles<D, P>& particles, const Lattice<D>& lattice, Attribute<V>... strengths) {
    static_assert(sizeof...(V) > 0, "cambium::Remesher: name the attributes to be remeshed");
    using T = std::common_type_t<ScalarOf<V>...>;
    static_assert((std::is_same_v<T, ScalarOf<V>> && ...),
                  "cambium::Remesher: attributes remeshed together by Split must have one scalar type");
    detail::require_room_for_kernel<Kernel>(lattice);
    require_size(particles.size(), lattice.size(), "the set of particles for split remeshing");
    auto& plan = plans_.template get<detail::SplitPlan<Kernel, T, P, D, (Components<V>::count + ...)>>(lattice);
    return plan(particles, execution_, strengths...);
  }

 private:
  E execution_;
  detail::PlanStore plans_;
};

}  // namespace cambium
