// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace support {

/// Observed order of convergence between two errors whose resolutions differ by `ratio`.
inline double observed_order(double coarse_error, double fine_error, double ratio = 2.0) {
  return std::log(coarse_error / fine_error) / std::log(ratio);
}

/// Order of convergence fitted (least squares of the logarithms) to errors whose resolutions double from one to the
/// next.
inline double fitted_order(const std::vector<double>& errors) {
  const double middle = 0.5 * static_cast<double>(errors.size() - 1);
  double product = 0.0, square = 0.0;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double from_middle = static_cast<double>(k) - middle;
    product -= from_middle * std::log2(errors[k]);
    square += from_middle * from_middle;
  }
  return product / square;
}

}  // namespace support
