// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include <cambium/core/columns.hpp>
#include <cambium/core/sparse.hpp>
#include <cambium/interpolation/dense_engine.hpp>
#include <cambium/interpolation/line_engine.hpp>
#include <cambium/interpolation/placement.hpp>
#include <cambium/interpolation/plan_store.hpp>
#include <cambium/interpolation/sparse_engine.hpp>
#include <cambium/particles/particles.hpp>

namespace cambium {

/// What a renormalised P2M found.
struct Coverage {
  /// Number of nodes whose sum of weights is below the wanted one and which took the fallback value.
  std::size_t uncovered = 0;
  /// Smallest sum of weights of the nodes that took an interpolated value; 1 if there is none.
  double smallest_weight = 1.0;
};

/// When a renormalised P2M takes a node as covered by particles, and what it writes elsewhere.
template <class V>
struct RenormalisedParams {
  /// A node is covered if the sum of the weights of the particles around it is at least this.
  double smallest_weight = 0.1;
  /// Value of the nodes that are not covered.
  V fallback{};
};

namespace detail {

/// Buffers of interpolation between one kind of particles and one kind of mesh; made once, reused as long as the
/// lattice stays the same.
template <class K, class T, class P, int D, int C, class Storage>
struct InterpolationPlan {
  using Engine = std::conditional_t<std::is_same_v<Storage, Sparse>, SparseEngine<K, T, P, D, C>,
                                    std::conditional_t<D == 1, LineEngine<K, T, P, C>, DenseEngine<K, T, P, D, C>>>;

  explicit InterpolationPlan(const Lattice<D>& lattice) : engine(lattice) {}

  /// Orders the particles; copies positions into the order of rows if they are not in it.
  template <Execution E>
  const Placement<K, D, P>& place(Columns<D, const P> x, const E& execution) {
    if constexpr (std::is_same_v<Storage, Sparse>) {
      placement.update_by(
          x, [&](RowOrder& order) { engine.order(x, order, execution); }, execution);
    } else {
      placement.update(engine.lattice(), x, execution);
    }
    return placement;
  }

  template <class V, Execution E>
  void p2m(const Placement<K, D, P>& particles, Columns<C, const T> strength, Field<V, D, Storage>& mesh,
           const E& execution) {
    std::array<const T*, C> q;
    for (int c = 0; c < C; ++c) {
      q[c] = strength.column(c).data();
      if (particles.sorted()) continue;
      particles.order().scatter(strength.column(c), values[c], execution);
      q[c] = values[c].data();
    }
    engine.p2m(particles.positions(), q, particles.order(), access(mesh), execution);
  }

  template <class V, Execution E>
  void m2p(const Field<V, D, Storage>& mesh, const Placement<K, D, P>& particles, Columns<C, T> value,
           const E& execution) {
    std::array<T*, C> q;
    for (int c = 0; c < C; ++c) {
      q[c] = value.column(c).data();
      if (particles.sorted()) continue;
      values[c].resize(particles.size());
      q[c] = values[c].data();
    }
    engine.m2p(particles.positions(), q, particles.order(), access(mesh), execution);
    for (int c = 0; c < C && !particles.sorted(); ++c) particles.order().gather(values[c], value.column(c), execution);
  }

  /// A mesh as the engine takes it: a sparse field, or the first value of a dense one.
  template <class Mesh>
  static decltype(auto) access(Mesh& mesh) {
    if constexpr (std::is_same_v<Storage, Sparse>) {
      return (mesh);
    } else {
      return &component(mesh[0], 0);
    }
  }

  Engine engine;
  Placement<K, D, P> placement;
  std::array<AlignedVector<T>, C> values;
};

/// Sums of weighted values and, as their last component, of weights; and a strength of one for every particle.
template <class T, int D, int C, class Storage>
struct WeightedSums {
  explicit WeightedSums(const Lattice<D>& lattice) : engine{lattice}, sums(lattice) {}
  OnLattice<D> engine;
  Field<Vec<C + 1, T>, D, Storage> sums;
  AlignedVector<T> ones;
};

}  // namespace detail

/// Interpolation between particles and a lattice with kernel K, in 1D, 2D and 3D, float or double, any number of
/// components at once, dense or sparse meshes, periodic or bounded axes.
///
/// p2m and m2p are adjoint: <p2m a, b> = <a, m2p b>. At bounded faces stencils are closed by extrapolation of the
/// kernel's moment degree, so that moments are conserved and orders kept up to the face. Particles need no order;
/// those already in the order of rows of cells (cell order, or the order of a remeshed lattice) skip a sort.
/// Results are the same bits for any number of threads. The object keeps its buffers between calls; it must not be
/// used by two threads at a time.
///
/// Errors thrown, before anything is written: PositionError (position not finite, or outside a bounded box), ValueError
/// (strength not finite), SizeError (array lengths differ), LatticeError (fewer nodes than the kernel needs).
template <RemeshingKernel Kernel>
class Interpolator {
 public:
  Interpolator() { check_remeshing_kernel<Kernel>(); }

  /// mesh_i := sum_p strength_p W((x_i - x_p) / h), eq. 11.17: conserves total and moments. Overwrites the mesh; a
  /// sparse mesh gets the blocks that the kernel can reach from blocks of cells with particles, and no others.
  template <int D, class P, int C, class T, class V, class S, Execution E = OpenMP>
  void p2m(Columns<D, const P> x, Columns<C, const T> strength, Field<V, D, S>& mesh, const E& execution = {}) {
    check_values<C, T, V>();
    detail::require_room_for_kernel<Kernel>(mesh.lattice());
    require_size(strength.size(), x.size(), "the array of strengths");
    require_finite(strength, "strength", execution);
    auto& plan = plan_for<D, P, C, T>(mesh);
    plan.p2m(plan.place(x, execution), strength, mesh, execution);
  }
  /// The same for particles that were placed before.
  template <int D, class P, int C, class T, class V, Execution E = OpenMP>
  void p2m(const Placement<Kernel, D, P>& particles, Columns<C, const T> strength, Field<V, D>& mesh,
           const E& execution = {}) {
    check_values<C, T, V>();
    particles.require_lattice(mesh.lattice());
    require_size(strength.size(), particles.size(), "the array of strengths");
    require_finite(strength, "strength", execution);
    plan_for<D, P, C, T>(mesh).p2m(particles, strength, mesh, execution);
  }

  /// value_p := sum_i mesh_i W((x_i - x_p) / h). Reads inactive blocks of a sparse mesh as its background.
  template <int D, class P, int C, class T, class V, class S, Execution E = OpenMP>
  void m2p(const Field<V, D, S>& mesh, Columns<D, const P> x, Columns<C, T> value, const E& execution = {}) {
    check_values<C, T, V>();
    detail::require_room_for_kernel<Kernel>(mesh.lattice());
    require_size(value.size(), x.size(), "the array of values");
    auto& plan = plan_for<D, P, C, T>(mesh);
    plan.m2p(mesh, plan.place(x, execution), value, execution);
  }
  /// The same for particles that were placed before.
  template <int D, class P, int C, class T, class V, Execution E = OpenMP>
  void m2p(const Field<V, D>& mesh, const Placement<Kernel, D, P>& particles, Columns<C, T> value,
           const E& execution = {}) {
    check_values<C, T, V>();
    particles.require_lattice(mesh.lattice());
    require_size(value.size(), particles.size(), "the array of values");
    plan_for<D, P, C, T>(mesh).m2p(mesh, particles, value, execution);
  }

  /// mesh_i := sum_p value_p W / sum_p W, eq. 11.31: for values rather than strengths; the denominator stands for the
  /// particles' volumes. Nodes too far from any particle take the fallback value and are counted in the result.
  template <int D, class P, int C, class T, class V, class S, Execution E = OpenMP>
  Coverage p2m_renormalised(Columns<D, const P> x, Columns<C, const T> value, Field<V, D, S>& mesh,
                            const RenormalisedParams<V>& params = {}, const E& execution = {}) {
    require_size(value.size(), x.size(), "the array of values");
    std::array<const T*, C + 1> weighted;
    for (int c = 0; c < C; ++c) weighted[c] = value.column(c).data();
    auto& scratch = plans_.template get<detail::WeightedSums<T, D, C, S>>(mesh.lattice());
    scratch.ones.resize(x.size(), T(1));
    weighted[C] = scratch.ones.data();
    p2m(x, Columns<C + 1, const T>(weighted, x.size()), scratch.sums, execution);
    return divide(scratch.sums, mesh, params);
  }

  template <int D, class P, class A, class V, class S, Execution E = OpenMP>
  void p2m(const Particles<D, P>& particles, Attribute<A> strength, Field<V, D, S>& mesh, const E& execution = {}) {
    if constexpr (check_values<Components<A>::count, ScalarOf<A>, V>()) {
      p2m(particles.positions(), detail::columns_of(particles[strength]), mesh, execution);
    }
  }
  template <int D, class P, class A, class V, class S, Execution E = OpenMP>
  void m2p(const Field<V, D, S>& mesh, Particles<D, P>& particles, Attribute<A> value, const E& execution = {}) {
    if constexpr (check_values<Components<A>::count, ScalarOf<A>, V>()) {
      const Particles<D, P>& constant = particles;
      m2p(mesh, constant.positions(), detail::columns_of(particles[value]), execution);
    }
  }
  template <int D, class P, class A, class V, class S, Execution E = OpenMP>
  Coverage p2m_renormalised(const Particles<D, P>& particles, Attribute<A> value, Field<V, D, S>& mesh,
                            const RenormalisedParams<V>& params = {}, const E& execution = {}) {
    if constexpr (check_values<Components<A>::count, ScalarOf<A>, V>()) {
      return p2m_renormalised(particles.positions(), detail::columns_of(particles[value]), mesh, params, execution);
    }
    return {};
  }

 private:
  template <int D, class P, int C, class T, class V, class S>
  auto& plan_for(const Field<V, D, S>& mesh) {
    return plans_.template get<detail::InterpolationPlan<Kernel, T, P, D, C, S>>(mesh.lattice());
  }
  /// True, unless compilation stops here: so that nothing follows the message.
  template <int C, class T, class V>
  static constexpr bool check_values() {
    static_assert(Components<V>::count == C, "cambium: particles and mesh must have the same number of components");
    static_assert(std::is_same_v<ScalarOf<V>, T>, "cambium: particles and mesh must hold the same scalar type");
    return Components<V>::count == C && std::is_same_v<ScalarOf<V>, T>;
  }
  /// Divides the first components by the last, node by node.
  template <class Sums, class V>
  static void quotient(const Sums& sum, V& value, const RenormalisedParams<V>& params, Coverage& coverage) {
    constexpr int C = Components<V>::count;
    const auto weight = static_cast<double>(sum[C]);
    if (weight < params.smallest_weight) {
      value = params.fallback;
      ++coverage.uncovered;
      return;
    }
    coverage.smallest_weight = std::min(coverage.smallest_weight, weight);
    for (int c = 0; c < C; ++c) component(value, c) = sum[c] / sum[C];
  }
  template <class Sums, class V, int D>
  static Coverage divide(const Field<Sums, D, Dense>& sums, Field<V, D, Dense>& mesh,
                         const RenormalisedParams<V>& params) {
    Coverage coverage;
    for (std::size_t i = 0; i < mesh.size(); ++i) quotient(sums[i], mesh[i], params, coverage);
    return coverage;
  }
  template <class Sums, class V, int D>
  static Coverage divide(const Field<Sums, D, Sparse>& sums, Field<V, D, Sparse>& mesh,
                         const RenormalisedParams<V>& params) {
    Coverage coverage;
    mesh.clear();
    for (std::size_t b = 0; b < sums.blocks(); ++b) {
      const std::size_t to = mesh.activate(sums.block_index(b));
      for (std::size_t i = 0; i < sums.block(b).size(); ++i) {
        if (!sums.lattice().contains(sums.node(b, i))) continue;
        quotient(sums.block(b)[i], mesh.block(to)[i], params, coverage);
      }
    }
    return coverage;
  }

  detail::PlanStore plans_;
};

}  // namespace cambium
