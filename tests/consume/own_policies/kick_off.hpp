// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <cambium/levelset/reinit/kick_off.hpp>

/// The distance to the nearest crossing of a lattice line, of first order next to faces of the lattice: KickOff.
struct AlongAxes {
  struct Params {};

  template <class T, int D>
  class Method {
   public:
    using Band = cambium::NarrowBand<T, D>;
    explicit Method(const Params& = {}) {}

    template <cambium::Execution E>
    cambium::KickOffCounts operator()(const Band& band, std::span<T> distance, const E&) const {
      cambium::KickOffCounts counts;
      for (std::size_t b = 0; b < band.blocks(); ++b) {
        for (std::size_t i = 0; i < Band::volume; ++i) {
          const cambium::Index<D> node = band.values().node(b, i);
          if (!band.lattice().contains(node)) continue;
          const T phi = band(node);
          T nearest = std::numeric_limits<T>::infinity();
          for (int d = 0; d < D; ++d) {
            for (const int way : {-1, 1}) {
              const T there = band(band.inside(node + cambium::Index<D>::unit(d, way)));
              if ((phi < T(0)) != (there < T(0))) nearest = std::min(nearest, phi / (phi - there));
            }
          }
          if (std::isinf(nearest)) continue;
          distance[b * Band::volume + i] = phi < T(0) ? -nearest : nearest;
          ++counts.nodes;
        }
      }
      return counts;
    }
  };
};
