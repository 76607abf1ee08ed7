// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/core/field.hpp>
#include <cambium/kernels/mollifier.hpp>
#include <cambium/particles/neighbours.hpp>

namespace cambium {

/// The smooth field of particles, q(x) = sum_p Q_p zeta_eps(x - x_p), zeta_eps(x) = eps^-D zeta(x/eps) (eq. 11.6).
///
///     Reconstruction<GaussianMollifier<4>, 2> smooth(domain, particles.positions(), 2.0 * h);
///     const double q = smooth(x, particles[strength]);                 // a Vec<C> for strengths of C components
///     smooth.sample(particles[strength], field);                       // at every node of a lattice
///
/// With strengths Q_p = v_p q(x_p) the error is O(eps^r) + O((h/eps)^m): r the order of the mollifier, m given by the
/// smoothness of it and of q. Gaussian mollifiers at h/eps = 0.5 leave the first term alone.
template <Mollifier Zeta, int D, class T = double>
class Reconstruction {
  static_assert(MollifierIn<Zeta, D>, "cambium::Reconstruction: the mollifier is not made for this dimension");

 public:
  /// As build().
  template <Execution E = OpenMP>
  Reconstruction(const Domain<D>& domain, Columns<D, const T> positions, double epsilon, const E& execution = {}) {
    check_mollifier<Zeta>();
    build(domain, positions, epsilon, execution);
  }

  /// Takes in new positions, reusing the memory of the last ones.
  /// \param epsilon  smoothing length, in the units of the positions
  /// \throws ValueError if epsilon is not positive and finite, or cutoff * epsilon more than half a period;
  ///         PositionError if a particle is not finite or outside a bounded axis. The last build is kept then.
  template <Execution E = OpenMP>
  void build(const Domain<D>& domain, Columns<D, const T> positions, double epsilon, const E& execution = {}) {
    require_reach(domain, epsilon);
    neighbours_.build(domain, positions, Zeta::cutoff * epsilon, execution);
    inverse_square_ = 1.0 / (epsilon * epsilon);
    scale_ = 1.0 / product(Vec<D>::constant(epsilon));
  }

  /// Number of particles.
  std::size_t size() const { return neighbours_.size(); }

  /// q at x: a double for an array of scalar strengths, a Vec<C> for Columns<C, S>.
  /// \throws SizeError if there are not size() strengths; PositionError if x is not finite; ValueError if a strength
  ///         that has a part in q(x) is not finite
  template <class V>
  auto operator()(const Vec<D>& x, const V& strengths) const {
    const auto q = read_columns(strengths);
    require_size(q.size(), size(), "array of strengths");
    const auto result = evaluate(x, q);
    for (int c = 0; c < q.count; ++c) {
      if (!std::isfinite(result[c])) require_finite(q, "strength");
    }
    if constexpr (requires { V::count; }) {
      return result;
    } else {
      return result[0];
    }
  }

  /// Sets every node of a field to q at its position; the field holds scalars, or a Vec with the components of the
  /// strengths. The same bits for any number of threads.
  /// \throws SizeError if there are not size() strengths; ValueError if a strength is not finite; the field is
  /// unchanged
  ///         then
  template <class V, class Value, Execution E = OpenMP>
  void sample(const V& strengths, Field<Value, D, Dense>& field, const E& execution = {}) const {
    const auto q = read_columns(strengths);
    static_assert(decltype(q)::count == Components<Value>::count,
                  "cambium::Reconstruction: strengths and field have different numbers of components");
    require_size(q.size(), size(), "array of strengths");
    require_finite(q, "strength", execution);
    for_each_piece(execution, field.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto result = evaluate(field.lattice().position(field.lattice().node(i)), q);
        for (int c = 0; c < q.count; ++c) component(field[i], c) = static_cast<ScalarOf<Value>>(result[c]);
      }
    });
  }

 private:
  static void require_reach(const Domain<D>& domain, double epsilon) {
    if (!(epsilon > 0.0) || !std::isfinite(epsilon)) {
      throw ValueError(detail::message("smoothing length is ", epsilon, ": it must be a positive, finite length"));
    }
    for (int d = 0; d < D; ++d) {
      const double half = 0.5 * (domain.box.hi[d] - domain.box.lo[d]);
      if (domain.periodic[d] && Zeta::cutoff * epsilon > half) {
        throw ValueError(detail::message("smoothing length ", epsilon, " makes the mollifier reach ",
                                         Zeta::cutoff * epsilon, ", more than half the period along axis ", d,
                                         ": choose a length of at most ", half / Zeta::cutoff));
      }
    }
  }

  template <int C, class S>
  Vec<C> evaluate(const Vec<D>& x, const Columns<C, const S>& strengths) const {
    Vec<C> sum;
    neighbours_.for_each(x, [&](std::size_t p, const Vec<D>& r) {
      const double weight = Zeta::template radial<D>(dot(r, r) * inverse_square_);
      for (int c = 0; c < C; ++c) sum[c] += weight * static_cast<double>(strengths.column(c)[p]);
    });
    return sum * scale_;
  }

  Neighbours<D, T> neighbours_;
  double inverse_square_ = 0.0;
  double scale_ = 0.0;
};

}  // namespace cambium
