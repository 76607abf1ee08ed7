// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/poisson/box_transform.hpp>
#include <cambium/poisson/lattice_green.hpp>

namespace cambium {

/// The solution of the second-order difference equations on the infinite lattice, to round-off: the lattice Green's
/// function, in two dimensions with the constant that makes it tend to -log(r) / (2 pi) far away.
struct LatticeKernel {
  template <int D, Execution E>
  static AlignedVector<double> values(const Index<D>& cells, double h, const E& execution) {
    auto result = lattice_green<D>(cells + Index<D>::constant(1), execution);
    const double constant =
        D == 2 ? (std::numbers::egamma + 1.5 * std::numbers::ln2 - std::log(h)) / (2.0 * std::numbers::pi) : 0.0;
    for (double& value : result) value = h * h * (value + constant);
    return result;
  }
};

/// The potential of point sources, 1 / (4 pi r) or -log(r) / (2 pi), and at a node that of its own source spread over
/// a ball of the volume of a cell, in its middle: second order (Hockney, Eastwood 1988, Computer Simulation Using
/// Particles, section 6-5).
struct PointKernel {
  template <int D, Execution E>
  static AlignedVector<double> values(const Index<D>& cells, double h, const E& execution) {
    const Index<D> count = cells + Index<D>::constant(1);
    AlignedVector<double> result(static_cast<std::size_t>(product(count)));
    const double pi = std::numbers::pi;
    for_each(execution, result.size(), [&](std::size_t number) {
      double square = 0.0;
      auto rest = static_cast<std::ptrdiff_t>(number);
      for (int d = 0; d < D; rest /= count[d], ++d) square += static_cast<double>(rest % count[d] * (rest % count[d]));
      const double r = h * std::sqrt(square);
      if (number == 0) {
        const double ball = h * (D == 2 ? std::sqrt(1.0 / pi) : std::cbrt(0.75 / pi));
        result[number] = D == 2 ? ball * ball * (0.25 - 0.5 * std::log(ball)) : 0.5 * ball * ball;
      } else {
        result[number] = D == 2 ? -h * h * std::log(r) / (2.0 * pi) : h * h * h / (4.0 * pi * r);
      }
    });
    return result;
  }
};

/// The exact solution for the trigonometric polynomial through the nodes of a source that vanishes towards the faces:
/// the error falls faster than any power for smooth sources. The kernel is cut off at a radius R beyond the diagonal of
/// the box, which changes nothing inside but gives it a smooth transform, (1 - cos R k) / k^2 in space and
/// (1 - J_0(R k)) / k^2 - R log(R) J_1(R k) / k in the plane; its values at the nodes are sums of cosines on a box
/// that is longer than the box by R (Vico, Greengard, Ferrando 2016, J. Comput. Phys. 323).
struct SpectralKernel {
  template <int D, Execution E>
  static AlignedVector<double> values(const Index<D>& cells, double h, const E& execution) {
    double square = 0.0;
    for (int d = 0; d < D; ++d) square += static_cast<double>(cells[d] * cells[d]);
    const double radius = std::sqrt(square) + 1.0;  // in spacings, as everything below
    Index<D> half;                                  // of a period of at least cells + radius
    std::array<Boundary, D> even;
    even.fill(Boundary::neumann);
    for (int d = 0; d < D; ++d) {
      half[d] = (static_cast<std::ptrdiff_t>(0.5 * (static_cast<double>(cells[d]) + radius)) / 16 + 1) * 16;
    }
    detail::BoxTransform<D, double, E> transform(even, half, execution);
    double scale = std::pow(h, 2.0);  // of the kernel: k in waves per spacing
    for (int d = 0; d < D; ++d) scale /= static_cast<double>(half[d]);
    const bool cube = half == Index<D>::constant(half[0]);  // then k^2 is a multiple of one number: a table serves
    std::vector<double> table(cube ? static_cast<std::size_t>(D * half[0] * half[0] + 1) : 0);
    for_each(execution, table.size(), [&](std::size_t square_of_k) {
      const double k = std::sqrt(static_cast<double>(square_of_k)) / static_cast<double>(half[0]);
      table[square_of_k] = scale * symbol<D>(radius, h, std::numbers::pi * k);
    });
    transform.to_waves([&](const Index<D>& m, double* values) {
      for (std::ptrdiff_t i = 0; i <= half[0]; ++i) {
        if (cube) {
          values[i] = table[static_cast<std::size_t>(dot(m, m) + i * i)];
          continue;
        }
        double k = 0.0;
        for (int d = 0; d < D; ++d) {
          const double one = static_cast<double>(d == 0 ? i : m[d]) / static_cast<double>(half[d]);
          k += one * one;
        }
        values[i] = scale * symbol<D>(radius, h, std::numbers::pi * std::sqrt(k));
      }
    });
    return nodes_of(transform, cells);
  }

 private:
  /// Of the kernel cut off at `radius` spacings; the logarithm is that of the radius in the units of h.
  template <int D>
  static double symbol(double radius, double h, double k) {
    if constexpr (D == 3) {
      const double s = k > 0.0 ? std::sin(0.5 * radius * k) / k : 0.5 * radius;
      return 2.0 * s * s;
    } else {
      const double logarithm = std::log(radius * h);
      if (k == 0.0) return radius * radius * (0.25 - 0.5 * logarithm);
      return (1.0 - ::j0(radius * k)) / (k * k) - radius * logarithm * ::j1(radius * k) / k;
    }
  }
  template <int D, Execution E>
  static AlignedVector<double> nodes_of(detail::BoxTransform<D, double, E>& transform, const Index<D>& cells) {
    using Transform = detail::BoxTransform<D, double, E>;
    const Index<D> count = cells + Index<D>::constant(1);
    AlignedVector<double> result(static_cast<std::size_t>(product(count)));
    transform.change_waves([&](const Index<D>& m, const double* tile) {
      for (std::ptrdiff_t k = 0; k < count[D - 1]; ++k) {
        for (std::ptrdiff_t i = m[0]; i < std::min(m[0] + static_cast<std::ptrdiff_t>(Transform::lines), count[0]);
             ++i) {
          if (D == 3 && m[1] >= count[1]) continue;
          const std::ptrdiff_t row = D == 3 ? k * count[1] + m[1] : k;
          result[static_cast<std::size_t>(row * count[0] + i)] =
              tile[static_cast<std::size_t>(k) * Transform::lines + static_cast<std::size_t>(i - m[0])];
        }
      }
    });
    return result;
  }
};

}  // namespace cambium
