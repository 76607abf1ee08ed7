// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/box.hpp>

/// The points with |x_1| + ... + |x_D| < size, about a centre: Shape.
template <int D>
class Diamond {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  Diamond(const cambium::Vec<D>& centre, double size) : centre_(centre), size_(size) {}

  double operator()(const cambium::Vec<D>& x) const {
    double sum = -size_;
    for (int d = 0; d < D; ++d) sum += std::abs(x[d] - centre_[d]);
    return sum / std::sqrt(static_cast<double>(D));
  }
  cambium::Box<D> bounds() const {
    return {centre_ - cambium::Vec<D>::constant(size_), centre_ + cambium::Vec<D>::constant(size_)};
  }

 private:
  cambium::Vec<D> centre_;
  double size_;
};
