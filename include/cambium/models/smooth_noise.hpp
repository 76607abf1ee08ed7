// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <cambium/levelset/shapes/amorphous.hpp>

namespace cambium {

/// A smooth random function of the position, of mean zero and variance one over all seeds: a sum of plane waves of
/// random direction and phase and of wave numbers up to a largest. It does not know of any lattice: patterns that
/// start from it can be compared between resolutions.
template <int D>
class SmoothNoise {
 public:
  /// \param wave_number  the largest, in radians per length
  explicit SmoothNoise(std::uint64_t seed, double wave_number, int waves = 100)
      : waves_(static_cast<std::size_t>(waves)) {
    detail::SplitMix64 random(seed);
    for (Wave& wave : waves_) {
      wave.k = wave_number * std::pow(random.uniform(), 1.0 / D) * random.template direction<D>();
      wave.phase = 6.283185307179586 * random.uniform();
    }
  }
  double operator()(const Vec<D>& x) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::cos(dot(wave.k, x) + wave.phase);
    return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
  }

 private:
  struct Wave {
    Vec<D> k;
    double phase = 0.0;
  };
  std::vector<Wave> waves_;
};

}  // namespace cambium
