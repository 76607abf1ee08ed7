// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>

namespace cambium::detail {

/// From which distance on the expansion of a cluster's potential up to an order has the accuracy that is wanted.
///
/// With sources at distances up to a from the centre, moments B_n = sum |q| |y|^n / sum |q|, and t = a / R at a target
/// at distance R, the terms after order p are at most
///   in space  sum_(n > p) B_n / R^(n + 1) <= B_(p + 1) / (R^(p + 2) (1 - t)),
///   in the plane  sum_(n > p) B_n / (n R^n) <= B_(p + 1) / ((p + 1) R^(p + 1) (1 - t)),
/// since Legendre polynomials and cosines are at most 1; their gradients have n + 1 (space) or n (plane) times as much
/// over R. The error is to be at most `tolerance` times the sum of |q| / |x - y| (in the plane of |q|), and that of
/// the gradient times the sum of |q| / |x - y|^2 (|q| / |x - y|), where |x - y| <= R (1 + t).
template <int D>
class ExpansionReach {
 public:
  ExpansionReach(double tolerance, bool gradient) : tolerance_(tolerance), gradient_(gradient) {}

  /// A distance that suffices for order p, at least 1.25 a; `moment` is B_(p + 1).
  double operator()(std::size_t p, double moment, double a) const {
    const double order = 1.0 / static_cast<double>(p + 1);
    const double base = std::pow(moment / tolerance_, order);
    // The equation for the distance is R = base factor(a / R)^order, whose right side falls with R: from a distance
    // that is too short each step leads to one on the other side of the solution.
    double reach = base;
    for (int step = 0; step < 3; ++step) {
      reach = std::fmax(reach, 1.25 * a);
      reach = base * std::pow(factor(a / reach, p), order);
    }
    return std::fmax(reach, 1.25 * a);
  }

 private:
  double factor(double t, std::size_t p) const {
    const auto order = static_cast<double>(p + 1);
    const double ratio = (1.0 + t) / (1.0 - t);
    if constexpr (D == 3) {
      return gradient_ ? (order + 1.0 - order * t) * ratio * ratio : ratio;
    } else {
      return gradient_ ? ratio : 1.0 / (order * (1.0 - t));
    }
  }

  double tolerance_;
  bool gradient_;
};

}  // namespace cambium::detail
