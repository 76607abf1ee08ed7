// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include <cambium/core/field.hpp>

namespace support {

/// A Gaussian source of integral 1 off the middle of the unit box, and its potential in free space.
template <int D>
struct Gaussian {
  cambium::Vec<D> centre =
      cambium::Vec<D>::constant(0.5) + cambium::Vec<D>::unit(0, -0.02) + cambium::Vec<D>::unit(1, 0.03);
  double width = 0.05;

  double source(const cambium::Vec<D>& x) const {
    const double r = norm(x - centre) / width;
    return std::exp(-0.5 * r * r) / std::pow(2.0 * std::numbers::pi * width * width, 0.5 * D);
  }
  double potential(const cambium::Vec<D>& x) const {
    const double pi = std::numbers::pi;
    const double r = norm(x - centre);
    if constexpr (D == 3) {
      const double middle = std::sqrt(2.0 / pi) / (4.0 * pi * width);
      return r < 1e-9 ? middle : std::erf(r / (width * std::numbers::sqrt2)) / (4.0 * pi * r);
    } else {
      const double middle = (std::numbers::egamma - std::log(2.0 * width * width)) / (4.0 * pi);
      return r < 1e-9 ? middle : (std::expint(-0.5 * r * r / (width * width)) - 2.0 * std::log(r)) / (4.0 * pi);
    }
  }
};

template <int D>
cambium::Lattice<D> bounded_lattice(const cambium::Index<D>& cells, double h) {
  cambium::Box<D> box;
  for (int d = 0; d < D; ++d) box.hi[d] = static_cast<double>(cells[d]) * h;
  return cambium::Lattice<D>(box, h, {});
}

template <class T, int D>
cambium::Field<T, D> noise(const cambium::Lattice<D>& lattice, unsigned seed) {
  cambium::Field<T, D> f(lattice);
  std::mt19937 random(seed);
  for (T& value : f.values()) value = static_cast<T>(std::uniform_real_distribution<>(-1.0, 1.0)(random));
  return f;
}

template <class T, int D, class F>
double largest_difference(const cambium::Field<T, D>& field, F&& exact) {
  double worst = 0.0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const auto x = field.lattice().position(field.lattice().node(i));
    worst = std::max(worst, std::abs(static_cast<double>(field[i]) - exact(x)));
  }
  return worst;
}

/// Largest difference between what a free-space solver gives for noise in a box and for the same noise inside a
/// box four times as large; the box has `first_cells` + 2 d cells along axis d.
template <class Solver, int D>
double difference_of_larger_box(std::ptrdiff_t first_cells) {
  cambium::Index<D> cells;
  for (int d = 0; d < D; ++d) cells[d] = first_cells + 2 * d;
  const auto lattice = bounded_lattice<D>(cells, 0.1);
  const auto large = bounded_lattice<D>(cells * 4, 0.1);
  const auto f = noise<double>(lattice, 2);
  cambium::Field<double, D> u(lattice), f_large(large), u_large(large);
  for (std::size_t i = 0; i < f.size(); ++i) f_large(lattice.node(i) + cells) = f[i];
  Solver(lattice).solve(f, u);
  Solver(large).solve(f_large, u_large);
  double worst = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) worst = std::max(worst, std::abs(u[i] - u_large(lattice.node(i) + cells)));
  return worst;
}

}  // namespace support
