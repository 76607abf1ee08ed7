// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>

#include <cambium/core/field.hpp>
#include <cambium/poisson/difference_symbol.hpp>
#include <cambium/poisson/mean_part.hpp>
#include <cambium/poisson/periodic_transform.hpp>
#include <cambium/poisson/spectral.hpp>

namespace cambium {

/// Poisson's equation -Lap u = f, or (s - Lap) u = f, on a lattice that is periodic along every axis, by Fourier
/// transforms.
///
///     cambium::PeriodicPoisson<2> poisson(lattice);
///     poisson.velocity(vorticity, velocity);
///
/// Symbol says what derivatives are: Spectral (exact for the waves of the lattice), or SecondOrder or FourthOrder,
/// which solve the difference equations of these stencils to round-off. Plans are made with the object, buffers at
/// their first use. Arguments and results may be the same field. Every call \throws SizeError if a field is not on the
/// lattice of the solver \throws ValueError if a value is not finite, or the right-hand side has a mean (see Params)
/// and leaves its result unchanged then.
template <int D, class Symbol = Spectral, class T = double, Execution E = OpenMP>
class PeriodicPoisson {
 public:
  using Complex = std::complex<T>;
  static constexpr int dimension = D;

  struct Params {
    Planning planning = Planning::estimate;
    MeanPart mean = MeanPart::reject;
    /// Means up to this, relative to the largest value, count as round-off: they are left out without a word.
    double mean_tolerance = sizeof(T) < sizeof(double) ? 1e-6 : 1e-10;
    /// s >= 0, one over a squared length: if positive, (s - Lap) u = f is solved, and f may have a mean.
    double shift = 0.0;
  };

  /// \throws LatticeError unless the lattice is periodic along every axis \throws ValueError if the shift is negative
  /// or
  ///         not finite
  explicit PeriodicPoisson(const Lattice<D>& lattice) : PeriodicPoisson(lattice, Params{}) {}
  PeriodicPoisson(const Lattice<D>& lattice, const Params& params, const E& execution = {})
      : lattice_(lattice), params_(params), execution_(execution), transform_(lattice, params.planning) {
    check_difference_symbol<Symbol>();
    if (!(params.shift >= 0.0) || !std::isfinite(params.shift)) {
      throw ValueError(detail::message("shift is ", params.shift, ": it must be finite and not negative"));
    }
    if constexpr (DifferenceSymbol<Symbol>) {
      for (int d = 0; d < D; ++d) tabulate(d);
    }
  }

  const Lattice<D>& lattice() const { return lattice_; }

  /// Solves -Lap u = f, or (s - Lap) u = f; u has mean zero unless s > 0. \return the mean of f, which was left out; 0
  /// if s > 0
  double solve(const Field<T, D>& f, Field<T, D>& u) {
    require_lattice(f, u);
    const double mean = examine(f, 0);
    Complex* const z = spectrum(0);
    transform_.forward(f.data(), z);
    transform_.for_each_wave(execution_, [&](std::size_t i, const Index<D>& m) { z[i] *= inverse(m); });
    transform_.backward(z, u.data());
    return mean;
  }

  /// The same for each component: a vector stream function from a vorticity. \return the means of f
  template <int C>
  Vec<C> solve(const Field<Vec<C, T>, D>& f, Field<Vec<C, T>, D>& u) {
    require_lattice(f, u);
    const Vec<C> means = examine(f);
    Complex* const z = spectrum(0);
    for (int c = 0; c < C; ++c) {
      transform_component(f, c, z);
      transform_.for_each_wave(execution_, [&](std::size_t i, const Index<D>& m) { z[i] *= inverse(m); });
      write_component(z, u, c);
    }
    return means;
  }

  /// g = grad q
  void gradient(const Field<T, D>& q, Field<Vec<D, T>, D>& g) {
    require_lattice(q, g);
    detail::examine_mean(q, 0, MeanPart::subtract, 0.0, execution_);
    Complex* const z = spectrum(0);
    Complex* const work = spectrum(1);
    transform_.forward(q.data(), z);
    const double scale = 1.0 / static_cast<double>(lattice_.size());
    for (int d = 0; d < D; ++d) {
      transform_.for_each_wave(execution_,
                               [&](std::size_t i, const Index<D>& m) { work[i] = along(d, m, scale, z[i]); });
      write_component(work, g, d);
    }
  }

  /// Velocity u = (d psi / dy, -d psi / dx) with -Lap psi = omega, the vorticity dv/dx - du/dy; its mean is zero: add
  /// that of the flow. \return the mean of omega, which was left out
  double velocity(const Field<T, 2>& omega, Field<Vec<2, T>, 2>& u) requires(D == 2) {
    require_lattice(omega, u);
    const double mean = examine(omega, 0);
    Complex* const z = spectrum(0);
    Complex* const work = spectrum(1);
    transform_.forward(omega.data(), z);
    for (int d = 0; d < 2; ++d) {
      const double sign = d == 0 ? 1.0 : -1.0;
      transform_.for_each_wave(execution_, [&](std::size_t i, const Index<D>& m) {
        work[i] = along(1 - d, m, sign * static_cast<double>(inverse(m)), z[i]);
      });
      write_component(work, u, d);
    }
    return mean;
  }

  /// Velocity u = curl psi with -Lap psi = omega; its mean is zero, and its curl is omega if div omega = 0.
  /// \return the means of omega, which were left out
  Vec<3> velocity(const Field<Vec<3, T>, 3>& omega, Field<Vec<3, T>, 3>& u) requires(D == 3) {
    require_lattice(omega, u);
    const Vec<3> means = examine(omega);
    std::array<Complex*, 3> z{spectrum(0), spectrum(1), spectrum(2)};
    Complex* const work = spectrum(3);
    for (int c = 0; c < 3; ++c) transform_component(omega, c, z[static_cast<std::size_t>(c)]);
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const int c = (a + 2) % 3;
      const Complex* const zb = z[static_cast<std::size_t>(b)];
      const Complex* const zc = z[static_cast<std::size_t>(c)];
      transform_.for_each_wave(execution_, [&](std::size_t i, const Index<D>& m) {
        const auto factor = static_cast<double>(inverse(m));
        work[i] = along(b, m, factor, zc[i]) - along(c, m, factor, zb[i]);
      });
      write_component(work, u, a);
    }
    return means;
  }

 private:
  void tabulate(int d) {
    const std::ptrdiff_t n = lattice_.nodes()[d];
    auto& first = first_[static_cast<std::size_t>(d)];
    auto& second = second_[static_cast<std::size_t>(d)];
    const double h = lattice_.spacing();
    for (std::ptrdiff_t m = 0; m < n; ++m) {
      const double theta =
          2.0 * std::numbers::pi * static_cast<double>(2 * m <= n ? m : m - n) / static_cast<double>(n);
      second.push_back(m == 0 ? 0.0 : Symbol::second(theta) / (h * h));
      // The shortest wave, of two nodes, is zero half a node further: it has no first derivative.
      first.push_back(m == 0 || 2 * m == n ? 0.0 : Symbol::first(theta) / h);
      if (m > 0 && !(second.back() > 0.0)) {
        throw ValueError(detail::message("difference symbol has second(", theta, ") = ", second.back() * h * h,
                                         ": it must be positive, or the Poisson equation has many solutions"));
      }
    }
  }

  /// 1 / (number of nodes times the symbol of s - Lap), 0 where that is 0: for the mean if s = 0.
  T inverse(const Index<D>& m) const {
    double sum = params_.shift;
    for (int d = 0; d < D; ++d) sum += second_[static_cast<std::size_t>(d)][static_cast<std::size_t>(m[d])];
    return sum == 0.0 ? T(0) : static_cast<T>(1.0 / (sum * static_cast<double>(lattice_.size())));
  }
  /// factor times the derivative of wave z along an axis.
  Complex along(int axis, const Index<D>& m, double factor, const Complex& z) const {
    const T k = static_cast<T>(factor * first_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(m[axis])]);
    return {-k * z.imag(), k * z.real()};
  }

  template <class V, class R>
  void require_lattice(const Field<V, D>& argument, const Field<R, D>& result) const {
    if (!(argument.lattice() == lattice_) || !(result.lattice() == lattice_)) {
      throw SizeError("a field is not on the lattice this Poisson solver was made for: make one solver per lattice");
    }
  }
  template <int C>
  Vec<C> examine(const Field<Vec<C, T>, D>& f) const {
    Vec<C> means;
    for (int c = 0; c < C; ++c) means[c] = examine(f, c);
    return means;
  }
  template <class V>
  double examine(const Field<V, D>& f, int c) const {
    const bool any_mean = params_.shift > 0.0;
    const MeanPart part = any_mean ? MeanPart::subtract : params_.mean;
    const double mean = detail::examine_mean(f, c, part, params_.mean_tolerance, execution_);
    return any_mean ? 0.0 : mean;
  }

  Complex* spectrum(std::size_t number) {
    auto& z = spectra_[number];
    if (z.empty()) z.resize(transform_.size());
    return z.data();
  }
  T* buffer() {
    if (real_.empty()) real_.resize(lattice_.size());
    return real_.data();
  }
  template <int C>
  void transform_component(const Field<Vec<C, T>, D>& field, int c, Complex* z) {
    T* const x = buffer();
    for_each(execution_, lattice_.size(), [&](std::size_t i) { x[i] = field[i][c]; });
    transform_.forward(x, z);
  }
  template <int C>
  void write_component(Complex* z, Field<Vec<C, T>, D>& field, int c) {
    T* const x = buffer();
    transform_.backward(z, x);
    for_each(execution_, lattice_.size(), [&](std::size_t i) { field[i][c] = x[i]; });
  }

  Lattice<D> lattice_;
  Params params_;
  E execution_;
  PeriodicTransform<D, T> transform_;
  std::array<std::vector<double>, D> first_;
  std::array<std::vector<double>, D> second_;
  std::array<AlignedVector<Complex>, 4> spectra_;
  AlignedVector<T> real_;
};

}  // namespace cambium
