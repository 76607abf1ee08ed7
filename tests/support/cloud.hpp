// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/core/domain.hpp>

namespace support {

/// Particles of a test in the unit box: positions and volumes, one array for each axis.
template <int D, class T = double>
struct Cloud {
  std::array<std::vector<T>, D> x;
  std::vector<T> volume;
  double spacing = 0.0;

  std::size_t size() const { return volume.size(); }
  cambium::Columns<D, const T> positions() const {
    std::array<std::span<const T>, D> spans;
    for (int d = 0; d < D; ++d) spans[d] = x[d];
    return cambium::Columns<D, const T>(spans);
  }
  cambium::Vec<D> position(std::size_t p) const {
    cambium::Vec<D> result;
    for (int d = 0; d < D; ++d) result[d] = static_cast<double>(x[d][p]);
    return result;
  }
};

/// n^D particles at displace(X), X the nodes of a lattice, with volumes volume(X).
template <int D, class T = double, class F, class G>
Cloud<D, T> cloud(int n, F&& displace, G&& volume) {
  Cloud<D, T> result;
  result.spacing = 1.0 / n;
  std::size_t count = 1;
  for (int d = 0; d < D; ++d) count *= static_cast<std::size_t>(n);
  for (std::size_t p = 0; p < count; ++p) {
    cambium::Vec<D> node;
    std::size_t rest = p;
    for (int d = 0; d < D; ++d, rest /= static_cast<std::size_t>(n)) {
      node[d] = (static_cast<double>(rest % static_cast<std::size_t>(n)) + 0.5) / n;
    }
    const cambium::Vec<D> x = displace(node);
    for (int d = 0; d < D; ++d) result.x[d].push_back(static_cast<T>(x[d]));
    result.volume.push_back(static_cast<T>(volume(node)));
  }
  return result;
}

template <int D, class T = double>
Cloud<D, T> lattice_cloud(int n) {
  return cloud<D, T>(
      n, [](const cambium::Vec<D>& x) { return x; }, [n](const cambium::Vec<D>&) { return std::pow(1.0 / n, D); });
}

/// Displaced by amplitude * h along every axis with the smooth periodic map x_d = X_d + a sin(2 pi sum X + d). Its
/// Jacobian is the identity plus a matrix of rank one; times h^D it is the volume, so sums stay accurate integrals.
template <int D>
Cloud<D> smooth_cloud(int n, double amplitude) {
  const double a = amplitude / n;
  const auto phase = [](const cambium::Vec<D>& x) {
    double sum = 0.0;
    for (int d = 0; d < D; ++d) sum += x[d];
    return 2.0 * std::numbers::pi * sum;
  };
  return cloud<D>(
      n,
      [=](cambium::Vec<D> x) {
        const double s = phase(x);
        for (int d = 0; d < D; ++d) x[d] += a * std::sin(s + d);
        return x;
      },
      [=](const cambium::Vec<D>& x) {
        double jacobian = 1.0;
        for (int d = 0; d < D; ++d) jacobian += 2.0 * std::numbers::pi * a * std::cos(phase(x) + d);
        return jacobian * std::pow(1.0 / n, D);
      });
}

/// Displaced at random by up to amplitude * h along every axis; every volume is h^D.
template <int D>
Cloud<D> random_cloud(int n, double amplitude, unsigned seed = 1) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> shift(-amplitude / n, amplitude / n);
  return cloud<D>(
      n,
      [&](cambium::Vec<D> x) {
        for (int d = 0; d < D; ++d) x[d] += shift(generator);
        return x;
      },
      [n](const cambium::Vec<D>&) { return std::pow(1.0 / n, D); });
}

/// Particles anywhere, with volumes that fit nothing.
template <int D>
Cloud<D> disorderly_cloud(int n) {
  auto cloud = random_cloud<D>(n, 3.0);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> factor(0.2, 2.0);
  for (std::size_t p = 0; p < cloud.size(); ++p) {
    cloud.volume[p] *= factor(generator);
    for (int d = 0; d < D; ++d) cloud.x[d][p] -= std::floor(cloud.x[d][p]);
  }
  return cloud;
}

/// sin(k . x + phase) with its derivatives.
template <int D>
struct Wave {
  cambium::Vec<D> k;
  double phase = 0.0;

  /// Component `c` of a vector of different waves of period 1 along every axis.
  static Wave component(int c) {
    Wave result{{}, 0.3 + 0.7 * c};
    for (int d = 0; d < D; ++d) result.k[d] = 2.0 * std::numbers::pi * ((d + c) % 2 == 0 ? 1.0 : -1.0);
    return result;
  }
  double value(const cambium::Vec<D>& x) const { return std::sin(dot(k, x) + phase); }
  double derivative(const cambium::Vec<D>& x, int i) const { return k[i] * std::cos(dot(k, x) + phase); }
  double derivative(const cambium::Vec<D>& x, int i, int j) const { return -k[i] * k[j] * value(x); }
  double laplacian(const cambium::Vec<D>& x) const { return -dot(k, k) * value(x); }
};

/// max_p |found_p - exact(x_p)|
template <int D, class T, class F>
double max_error(const Cloud<D, T>& particles, const std::vector<T>& found, F&& exact) {
  double error = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    error = std::max(error, std::abs(static_cast<double>(found[p]) - exact(particles.position(p))));
  }
  return error;
}

/// Square root of the mean of the squared errors.
template <int D, class F>
double rms_error(const Cloud<D>& particles, const std::vector<double>& found, F&& exact) {
  double sum = 0.0;
  for (std::size_t p = 0; p < particles.size(); ++p) sum += std::pow(found[p] - exact(particles.position(p)), 2);
  return std::sqrt(sum / static_cast<double>(particles.size()));
}

/// Several arrays of the same length, and their view.
template <int C>
struct Arrays {
  std::array<std::vector<double>, C> array;

  explicit Arrays(std::size_t size) {
    for (auto& a : array) a = std::vector<double>(size);
  }
  cambium::Columns<C, double> columns() {
    std::array<std::span<double>, C> spans;
    for (int c = 0; c < C; ++c) spans[c] = array[c];
    return cambium::Columns<C, double>(spans);
  }
};

}  // namespace support
