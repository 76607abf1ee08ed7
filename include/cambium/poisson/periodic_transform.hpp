// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>

#include <cambium/core/aligned.hpp>
#include <cambium/core/error.hpp>
#include <cambium/core/lattice.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/poisson/fftw.hpp>

namespace cambium {

/// Fourier transform between the real values at the nodes of a periodic lattice and its waves.
///
/// Waves m = (m_0, ..., m_{D-1}) of phase theta_d = 2 pi m_d / n_d per node are numbered with axis 0 fastest; along
/// axis 0 only m_0 = 0, ..., n_0 / 2 are kept, the others being their conjugates. backward(forward(x)) is n_0 ...
/// n_{D-1} times x. Arrays must come from AlignedVector or a Field: the plans count on their alignment.
template <int D, class T = double>
class PeriodicTransform {
 public:
  using Complex = std::complex<T>;

  /// \throws LatticeError unless every axis is periodic and has at most 2^31 - 1 nodes
  explicit PeriodicTransform(const Lattice<D>& lattice, Planning planning = Planning::estimate)
      : nodes_(lattice.nodes()), waves_(nodes_) {
    std::array<int, D> n;  // FFTW's last axis is the fastest
    for (int d = 0; d < D; ++d) {
      if (!lattice.periodic(d)) {
        throw LatticeError(detail::message("lattice is bounded along axis ", d,
                                           ": this Fourier transform needs one that is periodic along every axis"));
      }
      if (nodes_[d] > std::numeric_limits<int>::max()) {
        throw LatticeError(detail::message("lattice has ", nodes_[d], " nodes along axis ", d, ": too many for FFTW"));
      }
      n[static_cast<std::size_t>(D - 1 - d)] = static_cast<int>(nodes_[d]);
    }
    waves_[0] = nodes_[0] / 2 + 1;
    AlignedVector<T> x(lattice.size());
    AlignedVector<Complex> z(size());
    const unsigned flags = planning == Planning::measure ? FFTW_MEASURE : FFTW_ESTIMATE;
    const std::lock_guard guard(detail::planner_lock());
    forward_.reset(detail::Fftw<T>::forward(D, n.data(), x.data(), z.data(), flags));
    backward_.reset(detail::Fftw<T>::backward(D, n.data(), x.data(), z.data(), flags));
  }

  /// Number of waves that are kept.
  std::size_t size() const { return static_cast<std::size_t>(product(waves_)); }
  const Index<D>& waves() const { return waves_; }

  void forward(const T* x, Complex* z) const {
    // FFTW takes a mutable input, but leaves it as it is in a real transform out of place.
    detail::Fftw<T>::run_forward(forward_.get(), const_cast<T*>(x), z);
  }
  /// Overwrites z.
  void backward(Complex* z, T* x) const { detail::Fftw<T>::run_backward(backward_.get(), x, z); }

  /// Calls f(number, m) for every wave that is kept.
  template <Execution E, class F>
  void for_each_wave(const E& execution, F&& f) const {
    const auto width = static_cast<std::size_t>(waves_[0]);
    for_each_piece(execution, size() / width, 1 + 1024 / width, [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        Index<D> m;
        auto rest = static_cast<std::ptrdiff_t>(row);
        for (int d = 1; d < D; ++d) {
          m[d] = rest % waves_[d];
          rest /= waves_[d];
        }
        for (m[0] = 0; m[0] < waves_[0]; ++m[0]) f(row * width + static_cast<std::size_t>(m[0]), m);
      }
    });
  }

 private:
  Index<D> nodes_;
  Index<D> waves_;
  detail::PlanOwner<T> forward_;
  detail::PlanOwner<T> backward_;
};

}  // namespace cambium
