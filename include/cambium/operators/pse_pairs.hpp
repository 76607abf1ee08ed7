// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/operators/pse_weights.hpp>
#include <cambium/particles/neighbours.hpp>

namespace cambium {

/// Pairs of particles whose kernel is evaluated anew in every use: no memory beyond the neighbour search. The choice
/// for positions that are used once, as in every stage of a time step that moves particles.
template <class Kernel, int D, class P>
class EvaluatedPairs {
 public:
  template <Execution E>
  EvaluatedPairs(const Domain<D>& domain, Columns<D, const P> positions, double epsilon, double radius,
                 const E& execution)
      : neighbours_(domain, positions, radius, execution), epsilon_(epsilon) {}

  /// Calls f(q, r, w) for every neighbour q of particle p: r = x_q - x_p, w = eps^-(D + powers) W(|r|^2 / eps^2).
  template <class W, class F>
  void for_each(std::size_t p, F&& f) const {
    const detail::PairWeight<W, Kernel, D> weight(epsilon_);
    neighbours_.for_each_neighbour(p, [&](std::size_t q, const Vec<D>& r) { f(q, r, weight(r)); });
  }

 private:
  Neighbours<D, P> neighbours_;
  double epsilon_;
};

/// Pairs of particles whose kernels are evaluated once and kept: 4 bytes for the neighbour and 8 for each of the
/// Laplacian and the gradient weight. Several times faster from the second use on; mind the number of pairs, which is
/// the volume of the cutoff sphere in cells (113 in 2D, 900 in 3D for a cutoff of 6 h).
template <class Kernel, int D, class P>
class StoredPairs {
 public:
  template <Execution E>
  StoredPairs(const Domain<D>& domain, Columns<D, const P> positions, double epsilon, double radius, const E& execution)
      : domain_(domain), epsilon_(epsilon), first_(positions.size() + 1, 0) {
    require_numbers_fit(positions.size());
    const Neighbours<D, P> neighbours(domain, positions, radius, execution);
    for (int d = 0; d < D; ++d) position_[d].resize(positions.size());
    cambium::for_each(execution, positions.size(), [&](std::size_t p) {
      const Vec<D> x = neighbours.position(p);
      for (int d = 0; d < D; ++d) position_[d][p] = x[d];
      neighbours.for_each_neighbour(p, [&](std::size_t, const Vec<D>&) { ++first_[p + 1]; });
    });
    for (std::size_t p = 0; p < positions.size(); ++p) first_[p + 1] += first_[p];
    neighbour_.resize(first_.back());
    laplacian_.resize(first_.back());
    gradient_.resize(first_.back());
    const detail::PairWeight<detail::LaplacianWeight, Kernel, D> laplacian(epsilon);
    const detail::PairWeight<detail::GradientWeight, Kernel, D> gradient(epsilon);
    cambium::for_each(execution, positions.size(), [&](std::size_t p) {
      std::size_t k = first_[p];
      neighbours.for_each_neighbour(p, [&](std::size_t q, const Vec<D>& r) {
        neighbour_[k] = static_cast<std::uint32_t>(q);
        laplacian_[k] = laplacian(r);
        gradient_[k] = gradient(r);
        ++k;
      });
    });
  }

  /// Number of ordered pairs.
  std::size_t size() const { return neighbour_.size(); }

  /// As EvaluatedPairs::for_each; the weight of anisotropic diffusion is evaluated.
  template <class W, class F>
  void for_each(std::size_t p, F&& f) const {
    const detail::PairWeight<W, Kernel, D> weight(epsilon_);
    for (std::size_t k = first_[p]; k < first_[p + 1]; ++k) {
      const std::size_t q = neighbour_[k];
      const Vec<D> r = difference(p, q);
      if constexpr (std::is_same_v<W, detail::LaplacianWeight>) {
        f(q, r, laplacian_[k]);
      } else if constexpr (std::is_same_v<W, detail::GradientWeight>) {
        f(q, r, gradient_[k]);
      } else {
        f(q, r, weight(r));
      }
    }
  }

 private:
  static void require_numbers_fit(std::size_t count) {
    if (count > std::numeric_limits<std::uint32_t>::max()) {
      throw SizeError(detail::message(count, " particles are more than stored pairs can number (2^32 - 1): use at()"));
    }
  }

  /// x_q - x_p to the nearest image; stored positions lie in the box, so one period is enough.
  Vec<D> difference(std::size_t p, std::size_t q) const {
    Vec<D> r;
    for (int d = 0; d < D; ++d) {
      r[d] = position_[d][q] - position_[d][p];
      if (!domain_.periodic[d]) continue;
      const double period = domain_.box.hi[d] - domain_.box.lo[d];
      r[d] -= r[d] > 0.5 * period ? period : r[d] < -0.5 * period ? -period : 0.0;
    }
    return r;
  }

  Domain<D> domain_;
  double epsilon_;
  std::array<AlignedVector<double>, D> position_;
  std::vector<std::size_t> first_;
  AlignedVector<std::uint32_t> neighbour_;
  AlignedVector<double> laplacian_;
  AlignedVector<double> gradient_;
};

}  // namespace cambium
