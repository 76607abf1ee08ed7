// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

namespace detail {

/// Random numbers that are the same everywhere: SplitMix64 (Steele, Lea and Flood 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// In [0, 1), a multiple of 2^-53.
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Uniform on the unit sphere, by rejection from the cube.
  template <int D>
  Vec<D> direction() {
    for (;;) {
      Vec<D> x;
      for (int d = 0; d < D; ++d) x[d] = 2.0 * uniform() - 1.0;
      const double square = dot(x, x);
      if (square <= 1.0 && square > 1e-4) return x / std::sqrt(square);
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace detail

/// A smooth random star-shaped body whose surface stays between two radii; the same for the same seed, on every machine
/// (up to the round-off of the cosine).
///
/// In direction n the surface is at r(n) = middle + amplitude u / sqrt(1 + u^2) with u(n) a sum of plane waves
/// w cos(k . n + phase) of random direction, phase and wave number, w ~ 1 / |k|, and of variance 1 (random Fourier
/// features). The value is not the distance but (|x| - r) / L, with a bound L of the slope; inside of 3/4 of the inner
/// radius r - middle fades to zero with |x|.
template <int D>
class Amorphous {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// \param inner, outer  radii between which the surface lies
  /// \param bumps         largest wave number: about how many bumps there are around the body; at least 2
  /// \throws ValueError unless 0 < inner < outer, bumps >= 2 and everything is finite
  Amorphous(const Vec<D>& centre, double inner, double outer, std::uint64_t seed, double bumps = 4.0)
      : centre_(detail::finite(centre, "centre of the body")),
        middle_(0.5 *
                (detail::positive_length(inner, "inner radius") + detail::positive_length(outer, "outer radius"))),
        amplitude_(0.5 * (outer - inner)),
        fade_(0.75 * inner) {
    if (!(inner < outer)) {
      throw ValueError(detail::message("the surface cannot stay between radius ", inner, " and ", outer,
                                       ": the inner radius must be the smaller one"));
    }
    if (!(bumps >= 2.0) || !std::isfinite(bumps)) {
      throw ValueError(detail::message("number of bumps is ", bumps, ": it must be at least 2"));
    }
    draw(seed, bumps);
  }

  double operator()(const Vec<D>& x) const {
    const Vec<D> from_centre = x - centre_;
    const double radius = norm(from_centre);
    if (!(radius > 0.0)) return -middle_ * inverse_slope_;
    double u = 0.0;
    for (const Wave& wave : waves_) u += wave.weight * std::cos(dot(wave.k, from_centre) / radius + wave.phase);
    const double bulge = amplitude_ * u / std::sqrt(1.0 + u * u);
    return (radius - middle_ - bulge * std::fmin(radius / fade_, 1.0)) * inverse_slope_;
  }
  Box<D> bounds() const { return detail::box_around(centre_, Vec<D>::constant(middle_ + amplitude_)); }
  /// Distance from the centre to the surface along `direction`, which has any length but zero.
  double radius(const Vec<D>& direction) const {
    const Vec<D> on_sphere = detail::direction(direction, "direction");
    return middle_ - ((*this)(centre_ + middle_ * on_sphere) / inverse_slope_);
  }

 private:
  static constexpr int count = 12;
  struct Wave {
    Vec<D> k;
    double phase = 0.0;
    double weight = 0.0;
  };

  void draw(std::uint64_t seed, double bumps) {
    detail::SplitMix64 random(seed);
    double variance = 0.0;
    for (Wave& wave : waves_) {
      const double length = 2.0 + (bumps - 2.0) * random.uniform();
      wave.k = length * random.template direction<D>();
      wave.phase = 6.283185307179586 * random.uniform();
      wave.weight = 1.0 / length;
      variance += 0.5 * wave.weight * wave.weight;
    }
    for (Wave& wave : waves_) wave.weight /= std::sqrt(variance);
    // grad u = sum w k sin: at most sqrt(count) times the norm of the matrix of all w k, which is at most the square
    // root of the largest sum of a row of its Gram matrix.
    double gram = 0.0;
    for (int d = 0; d < D; ++d) {
      double row = 0.0;
      for (int e = 0; e < D; ++e) {
        double entry = 0.0;
        for (const Wave& wave : waves_) entry += wave.weight * wave.weight * wave.k[d] * wave.k[e];
        row += std::abs(entry);
      }
      gram = std::fmax(gram, row);
    }
    const double across = amplitude_ * std::sqrt(count * gram) / fade_;
    const double along = 1.0 + amplitude_ / fade_;
    inverse_slope_ = 1.0 / std::hypot(along, across);
  }

  Vec<D> centre_;
  double middle_;
  double amplitude_;
  double fade_;
  double inverse_slope_ = 1.0;
  std::array<Wave, count> waves_;
};

}  // namespace cambium
