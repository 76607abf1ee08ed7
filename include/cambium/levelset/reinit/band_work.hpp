// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include <cambium/levelset/patch.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// A second copy of a band; its memory serves again.
template <class T, int D>
NarrowBand<T, D>& copy_band(const NarrowBand<T, D>& band, std::optional<NarrowBand<T, D>>& copy) {
  if (copy) {
    *copy = band;
  } else {
    copy.emplace(band);
  }
  return *copy;
}

/// \throws ValueError if a value of the band is not finite
template <class T, int D, class E>
void require_finite(const NarrowBand<T, D>& band, const E& execution) {
  for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const T phi = band.values().block(b)[i];
      if (std::isfinite(phi)) continue;
      throw ValueError(message("phi is ", phi, " at node ", band.values().node(b, i),
                               ": it must be finite; check the shape, or the velocity that moved it"));
    }
  });
}

/// phi := +-half width where it is larger and beyond the lattice. \return number of nodes in the band
template <class T, int D, class E>
std::size_t cut_off(NarrowBand<T, D>& band, const E& execution) {
  for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
    const auto phi = band.values().block(b);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      if (band.lattice().contains(band.values().node(b, i))) {
        phi[i] = std::clamp(phi[i], -band.half_width(), band.half_width());
      } else {
        phi[i] = phi[i] < T(0) ? -band.half_width() : band.half_width();
      }
    }
  });
  std::size_t nodes = 0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (const T phi : band.values().block(b)) nodes += band.in_band(phi) ? 1 : 0;
  }
  return nodes;
}

/// Square of the length of the centred gradient, in spacings.
template <class T, int D>
T centred_square(const T* at, const Index<D>& stride) {
  T sum{};
  for (int d = 0; d < D; ++d) {
    const T slope = T(0.5) * (at[stride[d]] - at[-stride[d]]);
    sum += slope * slope;
  }
  return sum;
}

/// Smallest |phi| of N nodes in a row and of their neighbours along the axes.
template <std::size_t N, class T, int D>
T smallest_around(const T* at, const Index<D>& stride) {
  using Lanes = simd::Pack<T, N>;
  const auto size = [](const Lanes& phi) { return max(phi, Lanes(T(0)) - phi); };
  Lanes smallest = size(Lanes::load(at));
  for (int d = 0; d < D; ++d) {
    for (const std::ptrdiff_t s : {-stride[d], stride[d]}) smallest = min(smallest, size(Lanes::load(at + s)));
  }
  return lowest_lane(smallest);
}

}  // namespace cambium::detail
