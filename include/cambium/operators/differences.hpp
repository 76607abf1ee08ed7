// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include <cambium/operators/difference_rows.hpp>

namespace cambium {

namespace detail {

/// C components in a field value: T itself for one, Vec<C, T> otherwise.
template <int C, class T>
using ValueOf = std::conditional_t<C == 1, T, Vec<C, T>>;

}  // namespace detail

/// Centred finite differences of order 2, 4 or 6 on the nodes of a lattice.
///
/// Periodic axes wrap; near the faces of a bounded axis one-sided stencils of the same order take over. All functions
/// take dense or sparse fields of float or double. A sparse result gets the active blocks of its argument, and a
/// stencil that leaves them reads the background value: for exact values keep Order / 2 nodes of margin (Order + 1 next
/// to a face). The result of a constant field is exactly zero. Every function
/// \throws SizeError if the two fields live on different lattices
/// \throws LatticeError if an axis has fewer nodes than a stencil
/// and leaves `out` unchanged then.
template <int Order>
struct CentredDifference {
  static constexpr int order = Order;

  /// out = d in / d x_axis, component by component. \throws ValueError if there is no such axis or in and out are one
  template <class V, int D, class S, Execution E = OpenMP>
  static void derivative(const Field<V, D, S>& in, int axis, Field<V, D, S>& out, const E& execution = {}) {
    along_axis<1>(in, axis, out, execution);
  }
  /// out = d^2 in / d x_axis^2, component by component. \throws ValueError as derivative()
  template <class V, int D, class S, Execution E = OpenMP>
  static void second_derivative(const Field<V, D, S>& in, int axis, Field<V, D, S>& out, const E& execution = {}) {
    along_axis<2>(in, axis, out, execution);
  }

  /// Gradient of a scalar or of C components: component c * D + d of the result is d in_c / d x_d.
  template <class V, int D, class S, Execution E = OpenMP>
  static void gradient(const Field<V, D, S>& in,
                       Field<detail::ValueOf<Components<V>::count * D, ScalarOf<V>>, D, S>& out,
                       const E& execution = {}) {
    constexpr int count = Components<V>::count;
    std::array<detail::DifferenceTerm, count * D> terms;
    for (int t = 0; t < count * D; ++t) terms[static_cast<std::size_t>(t)] = {t / D, t, t % D, 1, 1.0};
    apply(in, terms, out, execution);
  }

  /// out = sum_d d in_d / d x_d
  template <class T, int D, class S, Execution E = OpenMP>
  static void divergence(const Field<Vec<D, T>, D, S>& in, Field<T, D, S>& out, const E& execution = {}) {
    std::array<detail::DifferenceTerm, D> terms;
    for (int d = 0; d < D; ++d) terms[static_cast<std::size_t>(d)] = {d, 0, d, 1, 1.0};
    apply(in, terms, out, execution);
  }

  /// out = sum_d d^2 in / d x_d^2, component by component. \throws ValueError if in and out are one
  template <class V, int D, class S, Execution E = OpenMP>
  static void laplacian(const Field<V, D, S>& in, Field<V, D, S>& out, const E& execution = {}) {
    constexpr int count = Components<V>::count;
    require_distinct(in, out);
    std::array<detail::DifferenceTerm, count * D> terms;
    for (int t = 0; t < count * D; ++t) terms[static_cast<std::size_t>(t)] = {t / D, t / D, t % D, 2, 1.0};
    apply(in, terms, out, execution);
  }

  /// Vorticity of a velocity field in the plane: d u_1 / d x_0 - d u_0 / d x_1.
  template <class T, class S, Execution E = OpenMP>
  static void curl(const Field<Vec<2, T>, 2, S>& in, Field<T, 2, S>& out, const E& execution = {}) {
    apply(in, std::array<detail::DifferenceTerm, 2>{{{1, 0, 0, 1, 1.0}, {0, 0, 1, 1, -1.0}}}, out, execution);
  }
  /// Curl in space; component a is d u_{a+2} / d x_{a+1} - d u_{a+1} / d x_{a+2}, indices modulo 3.
  /// \throws ValueError if in and out are one
  template <class T, class S, Execution E = OpenMP>
  static void curl(const Field<Vec<3, T>, 3, S>& in, Field<Vec<3, T>, 3, S>& out, const E& execution = {}) {
    require_distinct(in, out);
    std::array<detail::DifferenceTerm, 6> terms;
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      terms[static_cast<std::size_t>(2 * a)] = {c, a, b, 1, 1.0};
      terms[static_cast<std::size_t>(2 * a + 1)] = {b, a, c, 1, -1.0};
    }
    apply(in, terms, out, execution);
  }

 private:
  template <int Derivative, class V, int D, class S, Execution E>
  static void along_axis(const Field<V, D, S>& in, int axis, Field<V, D, S>& out, const E& execution) {
    constexpr int count = Components<V>::count;
    if (axis < 0 || axis >= D) {
      throw ValueError(detail::message("derivative along axis ", axis, " in ", D, " dimensions: take 0 to ", D - 1));
    }
    require_distinct(in, out);
    std::array<detail::DifferenceTerm, count> terms;
    for (int c = 0; c < count; ++c) terms[static_cast<std::size_t>(c)] = {c, c, axis, Derivative, 1.0};
    apply(in, terms, out, execution);
  }

  template <class V, class R, int D, class S, std::size_t N, Execution E>
  static void apply(const Field<V, D, S>& in, const std::array<detail::DifferenceTerm, N>& terms, Field<R, D, S>& out,
                    const E& execution) {
    if (!(in.lattice() == out.lattice())) {
      throw SizeError("the field and its derivative live on different lattices: make both from one lattice");
    }
    require_room_for_differences<Order>(in.lattice());
    detail::apply_differences<Order>(in, terms, out, execution);
  }

  template <class F>
  static void require_distinct(const F& in, const F& out) {
    if (&in == &out) throw ValueError("a field cannot be overwritten with its own derivative: pass a second field");
  }
};

}  // namespace cambium
