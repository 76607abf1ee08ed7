// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <numbers>
#include <numeric>

#include <cambium/farfield/expansion.hpp>
#include <cambium/particles/validation.hpp>

namespace cambium {

namespace detail {

/// What a potential of point sources is divided by: 2 pi in the plane, 4 pi in space.
template <int D>
inline constexpr double far_norm = (D == 2 ? 2.0 : 4.0) * std::numbers::pi;

/// Adds what sources [begin, end) make at a vector of targets, times far_norm. A source on a target is left out there.
template <bool Gradient, int D>
void add_sources(const std::array<const double*, D>& y, const double* q, std::size_t begin, std::size_t end,
                 const std::array<FarLanes, D>& x, FarSum<D>& total) {
  FarSum<D> sum = total;  // in registers
  const FarLanes zero(0.0), one(1.0);
  for (std::size_t s = begin; s < end; ++s) {
    std::array<FarLanes, D> away;
    FarLanes square = zero;
    for (std::size_t d = 0; d < D; ++d) {
      away[d] = x[d] - FarLanes(y[d][s]);
      square = fma(away[d], away[d], square);
    }
    const FarLanes strength = where_equal(square, zero, zero, FarLanes(q[s]));
    square = where_equal(square, zero, one, square);
    FarLanes slope;
    if constexpr (D == 3) {
      const FarLanes inverse = one / sqrt(square);
      const FarLanes potential = strength * inverse;
      sum.potential = sum.potential + potential;
      if constexpr (Gradient) slope = potential * (inverse * inverse);
    } else {
      sum.potential = fma(FarLanes(-0.5) * strength, log(square), sum.potential);
      if constexpr (Gradient) slope = strength / square;
    }
    if constexpr (Gradient) {
      for (std::size_t d = 0; d < D; ++d) sum.gradient[d] = sum.gradient[d] - slope * away[d];
    }
  }
  total = sum;
}

/// Points in the order they are summed in, with room for whole vectors: a vector that is not full repeats the last one.
template <int D>
std::array<FarLanes, D> lanes_of(const std::array<const double*, D>& x, std::size_t begin, std::size_t end) {
  std::array<FarLanes, D> result;
  for (std::size_t d = 0; d < D; ++d) {
    alignas(64) std::array<double, FarLanes::lanes> lane;
    for (std::size_t l = 0; l < FarLanes::lanes; ++l) lane[l] = x[d][std::min(begin + l, end - 1)];
    result[d] = FarLanes::load_aligned(lane.data());
  }
  return result;
}

/// result[to[l]] := lane l / far_norm, for as many lanes as there are numbers in `to`
template <int D>
void put_lanes(const FarLanes& value, std::span<const std::size_t> to, std::span<double> result) {
  alignas(64) std::array<double, FarLanes::lanes> lane;
  value.store_aligned(lane.data());
  for (std::size_t l = 0; l < to.size(); ++l) result[to[l]] = lane[l] / far_norm<D>;
}

template <int D>
std::array<const double*, D> pointers(Columns<D, const double> x) {
  std::array<const double*, D> result;
  for (int d = 0; d < D; ++d) result[static_cast<std::size_t>(d)] = x.column(d).data();
  return result;
}

/// \throws PositionError or ValueError unless every number is finite
template <int D, Execution E>
void require_sources(Columns<D, const double> x, std::span<const double> q, const E& execution) {
  require_size(q.size(), x.size(), "the array of strengths");
  require_positions(Domain<D>::periodic_box(Box<D>::cube()), x, execution);  // finite
  require_finite(q, "strength", execution);
}

}  // namespace detail

/// Potential of point sources in free space at targets, by the plain sum:
///   u(x) = sum_j q_j G(x - y_j),  G = -log(r) / (2 pi) in the plane, 1 / (4 pi r) in space: -Lap u = sum_j q_j
///   delta_j.
/// A source leaves out targets at its own place. The reference for TreePotential; N times M interactions.
/// \param gradient  grad u; no columns if it is not wanted
/// \throws SizeError if lengths differ \throws PositionError or ValueError if a number is not finite; results are
///         unchanged then
template <bool Gradient, int D, Execution E>
void direct_potential(Columns<D, const double> sources, std::span<const double> strengths,
                      Columns<D, const double> targets, std::span<double> potential, Columns<D, double> gradient,
                      const E& execution) {
  detail::require_sources(sources, strengths, execution);
  require_positions(Domain<D>::periodic_box(Box<D>::cube()), targets, execution);
  require_size(potential.size(), targets.size(), "the array of potentials");
  if (Gradient) require_size(gradient.size(), targets.size(), "the array of gradients");
  constexpr std::size_t lanes = detail::FarLanes::lanes;
  const auto y = detail::pointers<D>(sources), x = detail::pointers<D>(targets);
  for_each_piece(execution, targets.size(), 8 * lanes, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; t += lanes) {
      detail::FarSum<D> sum;
      detail::add_sources<Gradient, D>(y, strengths.data(), 0, sources.size(), detail::lanes_of<D>(x, t, end), sum);
      std::array<std::size_t, lanes> to;
      std::iota(to.begin(), to.end(), t);
      const std::span<const std::size_t> used(to.data(), std::min(lanes, end - t));
      detail::put_lanes<D>(sum.potential, used, potential);
      for (int d = 0; d < (Gradient ? D : 0); ++d) {
        detail::put_lanes<D>(sum.gradient[static_cast<std::size_t>(d)], used, gradient.column(d));
      }
    }
  });
}

template <int D, Execution E = OpenMP>
void direct_potential(Columns<D, const double> sources, std::span<const double> strengths,
                      Columns<D, const double> targets, std::span<double> potential, const E& execution = {}) {
  direct_potential<false, D>(sources, strengths, targets, potential, Columns<D, double>(), execution);
}
template <int D, Execution E = OpenMP>
void direct_potential(Columns<D, const double> sources, std::span<const double> strengths,
                      Columns<D, const double> targets, std::span<double> potential, Columns<D, double> gradient,
                      const E& execution = {}) {
  direct_potential<true, D>(sources, strengths, targets, potential, gradient, execution);
}

}  // namespace cambium
