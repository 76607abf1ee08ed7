// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include <cambium/core/vec.hpp>
#include <cambium/levelset/shapes/amorphous.hpp>

namespace bench {

/// Real spherical harmonics of a direction up to a degree, of mean square one over the sphere: by the stable recursion
/// for normalised associated Legendre functions. Harmonic (l, m) is number l (l + 1) + m.
inline void harmonics(const cambium::Vec<3>& x, int most, std::vector<double>& value) {
  const double r = norm(x), z = x[2] / r, s = std::sqrt(std::fmax(0.0, 1.0 - z * z)), angle = std::atan2(x[1], x[0]);
  value.assign(static_cast<std::size_t>((most + 1) * (most + 1)), 0.0);
  double diagonal = 1.0;
  for (int m = 0; m <= most; ++m) {
    if (m > 0) diagonal *= s * std::sqrt((2.0 * m + 1.0) / (2.0 * m));
    double before = 0.0, here = diagonal;
    for (int l = m; l <= most; ++l) {
      if (l > m) {
        const double ll = static_cast<double>(l) * l, mm = static_cast<double>(m) * m, k = l - 1.0;
        const double a = std::sqrt((4.0 * ll - 1.0) / (ll - mm));
        const double b = std::sqrt((k * k - mm) / (4.0 * k * k - 1.0));
        const double next = a * (z * here - b * before);
        before = here;
        here = next;
      }
      const std::size_t at = static_cast<std::size_t>(l * (l + 1));
      const double scale = m == 0 ? 1.0 : std::numbers::sqrt2;
      value[at + static_cast<std::size_t>(m)] = scale * here * std::cos(m * angle);
      if (m > 0) value[at - static_cast<std::size_t>(m)] = scale * here * std::sin(m * angle);
    }
  }
}

/// Noise on a sphere: every harmonic up to a degree with an amplitude of its own, normally distributed with mean zero
/// and variance one. It is a function of the direction alone, so that lattices of any spacing and orientation share it.
class HarmonicNoise {
 public:
  HarmonicNoise(std::uint64_t seed, int most)
      : most_(most), amplitude_(static_cast<std::size_t>((most + 1) * (most + 1))) {
    cambium::detail::SplitMix64 random(seed);
    for (double& a : amplitude_) {  // Box and Muller
      const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
      a = radius * std::cos(2.0 * std::numbers::pi * random.uniform());
    }
  }
  double operator()(const cambium::Vec<3>& direction) const {
    thread_local std::vector<double> value;
    harmonics(direction, most_, value);
    return std::inner_product(value.begin(), value.end(), amplitude_.begin(), 0.0) * 0.5 * std::numbers::inv_sqrtpi;
  }

 private:
  int most_;
  std::vector<double> amplitude_;
};

/// Amplitudes of the harmonics of values on a sphere, with the weights of a surface integral.
template <class Band>
std::vector<double> amplitudes(const Band& band, std::span<const double> weight, std::span<const double> c,
                               const cambium::Vec<3>& centre, int most) {
  std::vector<double> sum(static_cast<std::size_t>((most + 1) * (most + 1)), 0.0), value;
  double area = 0.0;
  for (std::size_t k = 0; k < band.size(); ++k) {
    if (weight[k] == 0.0) continue;
    harmonics(band.point(k) - centre, most, value);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight[k] * c[k] * value[i];
    area += weight[k];
  }
  for (double& a : sum) a /= area;
  return sum;
}

/// Share of each degree l > 0 in the variance.
inline std::vector<double> spectrum(const std::vector<double>& amplitude) {
  const int most = static_cast<int>(std::lround(std::sqrt(static_cast<double>(amplitude.size())))) - 1;
  std::vector<double> power(static_cast<std::size_t>(most) + 1, 0.0);
  double total = 0.0;
  for (int l = 1; l <= most; ++l) {
    for (int m = -l; m <= l; ++m) {
      const double a = amplitude[static_cast<std::size_t>(l * (l + 1) + m)];
      power[static_cast<std::size_t>(l)] += a * a;
    }
    total += power[static_cast<std::size_t>(l)];
  }
  for (double& p : power) p /= total;
  return power;
}

/// Middles of the spots, where c is above the middle of its range: of every connected piece the mean direction,
/// weighted by the height above the middle.
template <class Band>
std::vector<cambium::Vec<3>> spots(const Band& band, std::span<const double> weight, std::span<const double> c,
                                   const cambium::Vec<3>& centre) {
  const auto [low, high] = std::ranges::minmax(c);
  const double middle = 0.5 * (low + high);
  std::vector<std::size_t> above;
  for (std::size_t k = 0; k < band.size(); ++k) {
    if (c[k] > middle && weight[k] > 0.0) above.push_back(k);
  }
  std::ranges::sort(above, [&](std::size_t a, std::size_t b) { return c[a] > c[b]; });
  std::vector<int> piece(band.size(), -1);
  std::vector<std::size_t> stack;
  std::vector<cambium::Vec<3>> result;
  const double near = 1.8 * band.spacing();
  for (const std::size_t first : above) {
    if (piece[first] >= 0) continue;
    cambium::Vec<3> sum;
    stack.assign(1, first);
    piece[first] = static_cast<int>(result.size());
    while (!stack.empty()) {
      const std::size_t k = stack.back();
      stack.pop_back();
      const cambium::Vec<3> from = band.point(k) - centre;
      sum += std::abs(weight[k]) * (c[k] - middle) * from;
      for (const std::size_t j : above) {
        if (piece[j] >= 0 || norm(band.point(j) - centre - from) > near) continue;
        piece[j] = piece[first];
        stack.push_back(j);
      }
    }
    result.push_back(sum / norm(sum));
  }
  return result;
}

/// Angles between all pairs of directions, in degrees, ascending.
inline std::vector<double> pair_angles(const std::vector<cambium::Vec<3>>& direction) {
  std::vector<double> angles;
  for (std::size_t a = 0; a < direction.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      angles.push_back(std::acos(std::clamp(dot(direction[a], direction[b]), -1.0, 1.0)) * 180.0 / std::numbers::pi);
    }
  }
  std::ranges::sort(angles);
  return angles;
}

/// Largest distance of six directions from those of an octahedron's corners, in degrees of the angles between them; 180
/// if there are not six.
inline double off_octahedron(const std::vector<cambium::Vec<3>>& direction) {
  if (direction.size() != 6) return 180.0;
  const std::vector<double> angles = pair_angles(direction);
  double off = 0.0;
  for (std::size_t i = 0; i < angles.size(); ++i) off = std::max(off, std::abs(angles[i] - (i < 12 ? 90.0 : 180.0)));
  return off;
}

}  // namespace bench
