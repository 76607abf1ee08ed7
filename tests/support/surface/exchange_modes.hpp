// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <cambium/surface/surface_exchange.hpp>
#include <cambium/time/rk4.hpp>

#include "sphere_modes.hpp"

namespace modes {

using namespace cambium;

struct Outcome {
  double error, amplitude, total, area;
};

template <int D, class T>
LevelSet<ClosestPoint, D, T> sphere(std::ptrdiff_t cells, double half_width = 6.0) {
  return {lattice<D>(cells), Ball<D>(centre<D>(), 1.0), {.half_width = half_width}};
}

template <int D, class T, class E = OpenMP>
void diffuse(SurfaceExchange<D, T>& particles, AlignedVector<T>& strengths, double time, const E& execution = {}) {
  const double steps = std::ceil(time * particles.spectral_radius() / RK4<AlignedVector<T>>::real_axis);
  RK4<AlignedVector<T>, E> stepper(strengths, execution);
  for (int s = 0; s < steps; ++s) {
    stepper.step(strengths, 0.0, time / steps,
                 [&](const auto& y, double, auto& rate) { particles.exchange(y, rate, execution); });
  }
}

/// 1 + Y_l on the unit sphere until t = 0.1: error of the values within a spacing of the interface, over what is left
/// of the amplitude; of the amplitude; of the total; of the area.
template <int D, class T>
Outcome decay(int l, std::ptrdiff_t cells, double half_width = 3.0) {
  SurfaceExchange<D, T> particles(sphere<D, T>(cells, half_width + 3.0), {.half_width = half_width});
  AlignedVector<T> strengths(particles.size());
  const auto mode = [&](const Vec<D>& x) { return harmonic<D>(l, x - centre<D>()); };
  particles.sample([&](const Vec<D>& x) { return 1.0 + mode(x); }, strengths);
  const double before = particles.total(strengths), left = std::exp(-0.1 * eigenvalue<D>(l));
  diffuse(particles, strengths, 0.1, Serial{});
  double error = 0.0, product = 0.0, square = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const double exact = mode(particles.point(p)), volume = static_cast<double>(particles.volumes()[p]);
    const double strength = static_cast<double>(strengths[p]);
    product += exact * (strength - volume);
    square += exact * exact * volume;
    if (std::abs(particles.phi(p)) > particles.lattice().spacing()) continue;
    error = std::max(error, std::abs(strength / volume - 1.0 - left * exact) / left);
  }
  const double area = std::accumulate(particles.volumes().begin(), particles.volumes().end(), 0.0);
  return {error, std::abs(product / square / left - 1.0), std::abs(particles.total(strengths) / before - 1.0),
          std::abs(area / (2.0 * (D - 1) * std::numbers::pi) - 1.0)};
}

}  // namespace modes
