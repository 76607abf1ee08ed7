// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include <cambium/core/box.hpp>

namespace support {

/// Points on a surface, close enough to each other that every point of it is within `spacing` of one.
template <int D>
struct SurfaceSamples {
  std::vector<cambium::Vec<D>> points;
  double spacing = 0.0;

  double distance(const cambium::Vec<D>& x) const {
    double square = 1e300;
    for (const auto& point : points) square = std::min(square, dot(point - x, point - x));
    return std::sqrt(square);
  }

  /// The patch f(u, v), u and v in [0, 1], edges included; a curve if `across` is 0.
  template <class F>
  void add(F&& f, int along, int across) {
    double u_step = 0.0, v_step = 0.0;
    for (int i = 0; i <= along; ++i) {
      for (int j = 0; j <= across; ++j) {
        const double u = static_cast<double>(i) / along, v = across > 0 ? static_cast<double>(j) / across : 0.0;
        points.push_back(f(u, v));
        if (i > 0) u_step = std::max(u_step, norm(points.back() - f(u - 1.0 / along, v)));
        if (j > 0) v_step = std::max(v_step, norm(points.back() - f(u, v - 1.0 / across)));
      }
    }
    spacing = std::max(spacing, 0.55 * (u_step + v_step));
  }

  using Profile = std::function<std::pair<double, double>(double)>;
  /// The surface of revolution of the curve (along, across)(u) around the line through `origin` along the unit vector
  /// `axis`; in 2D the curve and its mirror image.
  void revolve(const cambium::Vec<D>& origin, const cambium::Vec<D>& axis, const Profile& profile, int count = 400) {
    if constexpr (D == 2) {
      const cambium::Vec<2> side{-axis[1], axis[0]};
      for (const double way : {-1.0, 1.0}) {
        add([&](double u, double) { return origin + profile(u).first * axis + way * profile(u).second * side; },
            8 * count, 0);
      }
    } else {
      const int least = std::abs(axis[0]) < 0.6 ? 0 : 1;
      cambium::Vec<3> a = cambium::Vec<3>::unit(least) - axis[least] * axis;
      a /= norm(a);
      const cambium::Vec<3> b{axis[1] * a[2] - axis[2] * a[1], axis[2] * a[0] - axis[0] * a[2],
                              axis[0] * a[1] - axis[1] * a[0]};
      add(
          [&](double u, double v) {
            const double angle = 2.0 * std::numbers::pi * v;
            return origin + profile(u).first * axis + profile(u).second * (std::cos(angle) * a + std::sin(angle) * b);
          },
          count, count);
    }
  }
};

/// Uniform positions in a box.
template <int D>
std::vector<cambium::Vec<D>> random_points(const cambium::Box<D>& box, int count, unsigned seed = 7) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<cambium::Vec<D>> result(static_cast<std::size_t>(count));
  for (auto& x : result) {
    for (int d = 0; d < D; ++d) x[d] = box.lo[d] + unit(generator) * box.extent()[d];
  }
  return result;
}

}  // namespace support
