// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include <cambium/particles/neighbours.hpp>

namespace cambium {

/// How closely particles stand, against the smoothing length that is to make a field of them. The error of smoothing
/// holds an O((h/epsilon)^m) part, so particles must overlap: h/epsilon < 1 (eq. 11.7).
struct Overlap {
  std::size_t particles = 0;
  double epsilon = 0.0;
  /// (volume of the box / particles)^(1/D): the lattice spacing of as many particles.
  double mean_spacing = 0.0;
  /// Distance of a particle from its nearest neighbour: over all particles the least, mean and greatest.
  double smallest = 0.0;
  double mean = 0.0;
  double largest = 0.0;
  /// The particle whose nearest neighbour is farthest away.
  std::size_t loneliest = 0;

  /// h/epsilon with h the greatest distance of a particle from its nearest neighbour.
  double ratio() const { return largest / epsilon; }
  /// h/epsilon with h the mean spacing; of use where particles fill the box.
  double mean_ratio() const { return mean_spacing / epsilon; }
  /// True if every particle has another one within epsilon. Clumps that stand apart pass: see largest_gap().
  bool holds() const { return ratio() < 1.0; }
};

/// A point and its distance from the closest particle.
template <int D>
struct Gap {
  Vec<D> at;
  double distance = 0.0;

  /// Spacing h of the lattice whose cells have the same gap in their centre: distance = h sqrt(D)/2.
  double spacing() const { return 2.0 * distance / std::sqrt(static_cast<double>(D)); }
};

namespace detail {

/// Neighbours made for nearest(): about one particle in a sphere of the radius.
template <int D, class T, Execution E>
Neighbours<D, T> nearest_neighbours(const Domain<D>& domain, Columns<D, const T> positions, const E& execution) {
  require_extent(domain);
  const double count = static_cast<double>(std::max<std::size_t>(positions.size(), 1));
  double radius = std::pow(domain.box.volume() / count, 1.0 / D);
  for (int d = 0; d < D; ++d) {
    if (domain.periodic[d]) radius = std::min(radius, 0.5 * domain.box.extent()[d]);
  }
  return Neighbours<D, T>(domain, positions, radius, execution);
}

}  // namespace detail

/// Measures the distances of nearest neighbours. The same bits for any number of threads.
/// \param epsilon  smoothing length, in the units of the positions
/// \throws ValueError if epsilon is not positive and finite; SizeError if there are fewer than two particles;
///         PositionError if a particle is not finite or outside a bounded axis
template <int D, class T, Execution E = OpenMP>
Overlap measure_overlap(const Domain<D>& domain, const Columns<D, T>& positions, double epsilon,
                        const E& execution = {}) {
  if (!(epsilon > 0.0) || !std::isfinite(epsilon)) {
    throw ValueError(detail::message("smoothing length is ", epsilon, ": it must be a positive, finite length"));
  }
  if (positions.size() < 2) {
    throw SizeError(detail::message("overlap of ", positions.size(), " particle(s): there must be at least two"));
  }
  const auto near = detail::nearest_neighbours(domain, read_columns(positions), execution);
  struct Part {
    double smallest = std::numeric_limits<double>::infinity();
    double sum = 0.0;
    double largest = -1.0;
    std::size_t loneliest = 0;
  };
  const auto distance = [&](std::size_t s) {
    const std::size_t p = near.order()[s];
    const double r = norm(near.nearest(near.position(p), p)->r);
    return Part{r, r, r, p};
  };
  const auto combine = [](const Part& a, const Part& b) {
    const bool b_lonelier = b.largest > a.largest || (b.largest == a.largest && b.loneliest < a.loneliest);
    return Part{std::min(a.smallest, b.smallest), a.sum + b.sum, std::max(a.largest, b.largest),
                b_lonelier ? b.loneliest : a.loneliest};
  };
  const Part all = reduce(execution, near.size(), Part{}, distance, combine);
  const double count = static_cast<double>(near.size());
  return {near.size(), epsilon,      std::pow(domain.box.volume() / count, 1.0 / D), all.smallest, all.sum / count,
          all.largest, all.loneliest};
}

/// The node of `lattice` that is farthest from the closest particle, of those at points x with where(x): the radius of
/// the largest empty ball, to half the diagonal of a lattice cell. Of several such nodes the first.
/// \throws SizeError if there is no particle, or no node with where(x); PositionError if a particle is not finite or
///         outside a bounded axis
template <int D, class T, class Where, Execution E = OpenMP>
    Gap<D> largest_gap(const Lattice<D>&lattice, const Columns<D, T>&positions, Where&&where,
                       const E&execution = {}) requires std::predicate < Where &,
    const Vec<D>
& > {
  if (positions.size() == 0) throw SizeError("largest gap between no particles: there must be at least one");
  const auto near = detail::nearest_neighbours(lattice.domain(), read_columns(positions), execution);
  const auto gap_at = [&](std::size_t i) {
    const Vec<D> x = lattice.position(lattice.node(i));
    return where(x) ? Gap<D>{x, norm(near.nearest(x)->r)} : Gap<D>{x, -1.0};
  };
  const auto larger = [](const Gap<D>& a, const Gap<D>& b) { return b.distance > a.distance ? b : a; };
  const Gap<D> result = reduce(execution, lattice.size(), Gap<D>{{}, -1.0}, gap_at, larger);
  if (result.distance < 0.0) throw SizeError("largest gap at no point: the lattice has no node where it was asked for");
  return result;
}

/// The same over all nodes.
template <int D, class T, Execution E = OpenMP>
Gap<D> largest_gap(const Lattice<D>& lattice, const Columns<D, T>& positions, const E& execution = {}) {
  return largest_gap(
      lattice, positions, [](const Vec<D>&) { return true; }, execution);
}

}  // namespace cambium
