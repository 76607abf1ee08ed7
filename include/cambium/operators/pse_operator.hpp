// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <cambium/operators/columns_of.hpp>
#include <cambium/operators/pse_pairs.hpp>
#include <cambium/operators/symmetric_tensor.hpp>

namespace cambium {

/// Particles carry strengths Q = v q (volume times value), and so does the result.
struct OfStrengths {
  /// v_p v_q (q_q + sign q_p)
  static double pair(double vp, double vq, double fp, double fq, double sign) { return vp * fq + sign * (vq * fp); }
};
/// Particles carry values q, and so does the result.
struct OfValues {
  /// v_q (q_q + sign q_p)
  static double pair(double, double vq, double fp, double fq, double sign) { return vq * (fq + sign * fp); }
};

namespace detail {

template <class T>
void require_volumes(const Columns<1, T>& volumes) {
  cambium::require_finite(volumes, "volume");
  const auto v = volumes.column(0);
  for (std::size_t p = 0; p < v.size(); ++p) {
    if (v[p] < T(0)) throw ValueError(message("volume of particle ", p, " is ", v[p], ": volumes are not negative"));
  }
}

}  // namespace detail

/// Particle strength exchange operators bound to positions and volumes; made by PSE::at() and PSE::stored_at().
///
/// By default arguments and results are strengths, Q = v q; a last argument OfValues{} makes both values. Results
/// overwrite `out`. Every particle sums over its neighbours in a fixed order, so the bits do not depend on the number
/// of threads; the two halves of a pair differ in sign alone, so the sum of a strength result is zero to round-off, on
/// any particles. Along bounded axes there is nothing beyond the faces: nothing flows out, but within the kernel's
/// radius of a face the operators are not consistent, unless the function vanishes there or mirrored particles continue
/// it. Every operator \throws SizeError if an array has not one entry per particle \throws ValueError if an argument is
/// not finite or is also the result and leaves `out` unchanged then.
template <class Kernel, int D, class Pairs, Execution E>
class PSEOperator {
 public:
  static constexpr int dimension = D;

  template <class T>
  PSEOperator(Pairs pairs, Columns<1, const T> volumes, double epsilon, const E& execution)
      : pairs_(std::move(pairs)), volume_(volumes.size()), epsilon_(epsilon), execution_(execution) {
    for (std::size_t p = 0; p < volume_.size(); ++p) volume_[p] = static_cast<double>(volumes.column(0)[p]);
  }

  std::size_t size() const { return volume_.size(); }
  double epsilon() const { return epsilon_; }
  const Pairs& pairs() const { return pairs_; }

  /// Laplacian, component by component: out_p = eps^-2 sum_q (v_p Q_q - v_q Q_p) eta_eps(x_q - x_p) (eq. 11.12).
  template <class In, class Out, class Form = OfStrengths>
  void laplacian(const In& in, Out&& out, Form = {}) const {
    const auto f = detail::const_columns_of(in);
    constexpr int count = decltype(f)::count;
    gather<detail::LaplacianWeight, count>(f, detail::columns_of(out),
                                           [&](std::size_t p, std::size_t q, const Vec<D>&, double w, Vec<count>& sum) {
                                             for (int c = 0; c < count; ++c) sum[c] += w * pair<Form>(f, c, p, q, -1.0);
                                           });
  }

  /// Gradient of C components: component c D + d of `out` is the derivative of component c along axis d,
  /// eps^-1 sum_q (v_p Q_q + v_q Q_p) eta_{d,eps}(x_p - x_q).
  template <class In, class Out, class Form = OfStrengths>
  void gradient(const In& in, Out&& out, Form = {}) const {
    const auto f = detail::const_columns_of(in);
    constexpr int count = decltype(f)::count;
    gather<detail::GradientWeight, count * D>(
        f, detail::columns_of(out), [&](std::size_t p, std::size_t q, const Vec<D>& r, double w, Vec<count * D>& sum) {
          for (int c = 0; c < count; ++c) {
            const double value = w * pair<Form>(f, c, p, q, 1.0);
            for (int d = 0; d < D; ++d) sum[c * D + d] -= value * r[d];
          }
        });
  }

  /// Divergence of D components, the trace of their gradient.
  template <class In, class Out, class Form = OfStrengths>
  void divergence(const In& in, Out&& out, Form = {}) const {
    const auto f = detail::const_columns_of(in);
    static_assert(decltype(f)::count == D, "cambium: the divergence needs as many components as dimensions");
    gather<detail::GradientWeight, 1>(f, detail::columns_of(out),
                                      [&](std::size_t p, std::size_t q, const Vec<D>& r, double w, Vec<1>& sum) {
                                        double value = 0.0;
                                        for (int d = 0; d < D; ++d) value += pair<Form>(f, d, p, q, 1.0) * r[d];
                                        sum[0] -= w * value;
                                      });
  }

  /// Anisotropic diffusion div(K grad q), component by component.
  ///
  /// eps^-2 sum_q (v_p Q_q - v_q Q_p) z^T M z phi_eps(z), z = (x_q - x_p) / eps, M = K' - tr(K') / (D + 2) with K' the
  /// mean of the tensors of p and q, and phi of fourth moment int z_i^2 z_j^2 phi = 1. Second derivatives of the
  /// symmetric mean give grad K . grad q exactly, so the order is the kernel's for variable K too.
  /// \param tensor  SymmetricTensor<D>, the same everywhere, or Columns of its D (D + 1) / 2 components
  template <class Tensor, class In, class Out, class Form = OfStrengths>
  void diffusion(const Tensor& tensor, const In& in, Out&& out, Form = {}) const {
    detail::check_diffusion_kernel<Kernel, D>();
    const auto f = detail::const_columns_of(in);
    const auto result = detail::columns_of(out);
    constexpr int count = decltype(f)::count;
    const detail::TensorOf<D, Tensor> at(tensor, size(), result);
    gather<detail::DiffusionWeight, count>(
        f, result, [&](std::size_t p, std::size_t q, const Vec<D>& r, double w, Vec<count>& sum) {
          const double shape = w * detail::exchange_form(at.mean(p, q), r);
          for (int c = 0; c < count; ++c) sum[c] += shape * pair<Form>(f, c, p, q, -1.0);
        });
  }

  /// Largest stable explicit Euler step of dQ/dt = nu Lap Q on these particles: 2 / (nu max_p R_p) with the row sums
  /// R_p = eps^-2 sum_q v_q eta_eps(x_q - x_p), which are M_0 / eps^2 on a lattice. Eigenvalues of the operator are no
  /// less than -max R if the kernel has no negative Fourier modes. \throws ValueError unless nu > 0
  double stable_step(double diffusivity) const {
    const double integral_bound = largest_euler_step<Kernel, D>(diffusivity, epsilon_);
    const double itself = detail::PairWeight<detail::LaplacianWeight, Kernel, D>(epsilon_)(Vec<D>{});
    const double largest = reduce(
        execution_, size(), 0.0,
        [&](std::size_t p) {
          double sum = volume_[p] * itself;
          pairs_.template for_each<detail::LaplacianWeight>(p, [&](std::size_t q, const Vec<D>&, double w) {
            if (q != p) sum += volume_[q] * w;
          });
          return sum;
        },
        [](double a, double b) { return std::max(a, b); });
    return largest > 0.0 ? 2.0 / (diffusivity * largest) : integral_bound;
  }

 private:
  template <class Form, int C, class T>
  double pair(const Columns<C, T>& f, int c, std::size_t p, std::size_t q, double sign) const {
    const auto column = f.column(c);
    return Form::pair(volume_[p], volume_[q], static_cast<double>(column[p]), static_cast<double>(column[q]), sign);
  }

  /// out_p = sum over neighbours q of what add(p, q, r, w, sum) adds.
  template <class W, int Count, int C, class S, class T, class F>
  void gather(const Columns<C, S>& in, const Columns<Count, T>& out, F&& add) const {
    require_size(in.size(), size(), "the argument of a PSE operator");
    require_size(out.size(), size(), "the result of a PSE operator");
    detail::require_distinct(in, out);
    require_finite(Columns<C, S>(in), "argument of an operator", execution_);
    for_each_piece(execution_, size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) {
        Vec<Count> sum;
        pairs_.template for_each<W>(p, [&](std::size_t q, const Vec<D>& r, double w) { add(p, q, r, w, sum); });
        for (int c = 0; c < Count; ++c) out.column(c)[p] = static_cast<T>(sum[c]);
      }
    });
  }

  Pairs pairs_;
  AlignedVector<double> volume_;
  double epsilon_;
  E execution_;
};

}  // namespace cambium
