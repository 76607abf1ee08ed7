// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <cambium/levelset/geometry/ridge_aware.hpp>

namespace cambium {

/// Smallest and largest |grad phi| near the interface: 1 and 1 for a signed distance.
///
/// A flow changes S = |grad phi|^2 / 2 along paths by dS/dt = -2 S n . (grad u) n (Bergdorf, Milde & Koumoutsakos, eq.
/// 11.32): exponentially where it strains along normals.
struct GradientRange {
  double smallest = 1.0;
  double largest = 1.0;
  std::size_t nodes = 0;  ///< nodes looked at

  double anisotropy() const { return largest / smallest; }
};

/// When a driver is to reinitialise.
struct ReinitialisationLimits {
  double smallest = 0.7;  ///< below it the band is wider than it says, and remeshing sees a flat phi
  double largest = 1.5;   ///< above it stencils of the band's half width reach values that are cut off
};

namespace detail {

/// Squared length of the largest differences between a node and its neighbours along each axis.
template <class T, int D>
T steepest(const T* at, const Index<D>& stride) {
  T sum{};
  for (int d = 0; d < D; ++d) {
    const T slope = std::max(std::abs(at[stride[d]] - *at), std::abs(*at - at[-stride[d]]));
    sum += slope * slope;
  }
  return sum;
}

}  // namespace detail

/// |grad phi| over the nodes within 1.5 spacings of the interface: those whose |phi| is at most 1.5 times the slope to
/// their neighbours.
/// \tparam Differences  how derivatives are taken: RidgeAware, so that approaching fronts do not look like a flat phi,
///                      or CentredDifferences
/// \throws InterfaceError if there is no such node
template <class Differences = RidgeAware, class T, int D, Execution E = OpenMP>
GradientRange gradient_range(const NarrowBand<T, D>& band, const E& execution = {}) {
  constexpr T within = T(1.5);
  const auto empty = GradientRange{std::numeric_limits<double>::infinity(), 0.0, 0};
  std::vector<GradientRange> of_block(band.blocks(), empty);
  std::vector<Patch<T, D>> patches(static_cast<std::size_t>(execution.count()));
  for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
    const auto phi = band.values().block(b);
    if (std::ranges::none_of(phi, [&](T value) { return band.in_band(value); })) return;
    Patch<T, D>& patch = patches[worker];
    patch.read_block(band, b, Differences::reach);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      if (!band.in_band(phi[i]) || !band.lattice().contains(band.values().node(b, i))) continue;
      const T* at = patch.data() + patch.entry(i);
      if (!(phi[i] * phi[i] <= within * within * detail::steepest(at, patch.stride()))) continue;
      const Jet<T, D> jet = Differences::jet({}, at, patch.stride());
      const auto slope = static_cast<double>(norm(jet.gradient));  // times the spacing
      GradientRange& range = of_block[b];
      range = {std::min(range.smallest, slope), std::max(range.largest, slope), range.nodes + 1};
    }
  });
  GradientRange total = empty;
  for (const GradientRange& range : of_block) {
    total = {std::min(total.smallest, range.smallest), std::max(total.largest, range.largest),
             total.nodes + range.nodes};
  }
  if (total.nodes == 0) throw InterfaceError("no node of the band is within 1.5 spacings of an interface");
  total.smallest /= band.spacing();
  total.largest /= band.spacing();
  return total;
}

/// True if |grad phi| has left the limits: reinitialise before the next step.
inline bool reinitialisation_is_due(const GradientRange& range, const ReinitialisationLimits& limits = {}) {
  return !(range.smallest >= limits.smallest && range.largest <= limits.largest);
}

}  // namespace cambium
