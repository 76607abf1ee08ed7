// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

#include <cambium/core/vec.hpp>

namespace bench {

/// Waves r = R + delta Y on a ball around a point that is no node, nothing in their directions being the lattice's:
/// cos(l theta) in the plane, Legendre's P_l(n . axis) in space.
template <int D>
struct Wave {
  int l;

  static cambium::Vec<D> centre() {
    if constexpr (D == 2) return {0.05, 0.02};
    if constexpr (D == 3) return {0.05, 0.02, 0.03};
  }
  double operator()(const cambium::Vec<D>& x) const {
    const cambium::Vec<D> y = x - centre();
    if constexpr (D == 2) {
      return std::cos(l * std::atan2(y[1], y[0]));
    } else {
      return std::legendre(static_cast<unsigned>(l), (y[0] + 2.0 * y[1] + 3.0 * y[2]) / (std::sqrt(14.0) * norm(y)));
    }
  }
  /// Negative inside.
  double shape(const cambium::Vec<D>& x, double delta) const {
    const double r = norm(x - centre());
    return r < 0.1 ? r - 2.0 : r - 2.0 - delta * (*this)(x);
  }
};

/// The part b of values a + b Y, by least squares.
struct WaveFit {
  double weight = 0.0, waves = 0.0, values = 0.0, squares = 0.0, products = 0.0;

  void add(double y, double value, double w = 1.0) {
    weight += w;
    waves += w * y;
    values += w * value;
    squares += w * y * y;
    products += w * y * value;
  }
  double part() const { return (products - waves * values / weight) / (squares - waves * waves / weight); }
};

}  // namespace bench
