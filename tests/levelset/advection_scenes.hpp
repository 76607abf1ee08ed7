// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include <cambium/kernels/m4_prime.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/level_set.hpp>

/// Shapes, flows and measures that tests of advection share.
namespace advection_scenes {

using namespace cambium;

template <int D>
struct Ball {
  Vec<D> centre = Vec<D>::constant(0.5);
  double radius = 0.2;
  double operator()(const Vec<D>& x) const { return norm(x - centre) - radius; }
};

/// One turn about the middle of the unit box in the time 1, in the plane of axes 0 and 1.
template <int D>
struct Rotation {
  double centre = 0.5;
  Vec<D> operator()(const Vec<D>& x, double) const {
    const double rate = 2.0 * std::numbers::pi;
    Vec<D> u{};
    u[0] = rate * (centre - x[1]);
    u[1] = rate * (x[0] - centre);
    return u;
  }
};

/// LeVeque's single vortex, back at the start after `period`.
template <class T>
struct Vortex {
  double period;
  Vec<2, T> operator()(const Vec<2, T>& x, double t) const {
    const T pi = std::numbers::pi_v<T>;
    const T turn = static_cast<T>(std::cos(std::numbers::pi * t / period));
    const T a = std::sin(pi * x[0]), b = std::sin(pi * x[1]);
    return {-a * a * std::sin(T(2) * pi * x[1]) * turn, b * b * std::sin(T(2) * pi * x[0]) * turn};
  }
};

/// Zalesak's disk of radius 15 with a slot 5 wide and 25 long, about (50, 75) of a box of 100; not a distance.
struct SlottedDisk {
  double operator()(const Vec<2>& x) const {
    const double across = std::abs(x[0] - 50.0) - 2.5, along = x[1] - 85.0;
    const double slot = across > 0.0 && along > 0.0 ? std::hypot(across, along) : std::max(across, along);
    return std::max(norm(x - Vec<2>{50.0, 75.0}) - 15.0, -slot);
  }
};

/// Calls f(node, phi) for the nodes of a band.
template <class T, int D, class F>
void for_each_band_node(const NarrowBand<T, D>& band, F&& f) {
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const Index<D> node = band.values().node(b, i);
      const T phi = band.values().block(b)[i];
      if (band.lattice().contains(node) && band.in_band(phi)) f(node, phi);
    }
  }
}

/// Largest distance between the zero set of a level set, where lattice lines cross it, and that of a signed distance:
/// the exact distance at the point where the interpolant of sixth order along the line is zero. Or the mean of these.
template <class L, class F>
double interface_error(const L& level_set, F&& exact, bool mean = false) {
  constexpr int D = L::dimension;
  const auto& band = level_set.band();
  double error = 0.0, sum_of_errors = 0.0, crossings = 0.0;
  for_each_band_node(band, [&](const Index<D>& node, double phi) {
    for (int d = 0; d < D; ++d) {
      double value[6];
      for (int k = 0; k < 6; ++k) {
        Index<D> at = node;
        at[d] += k - 2;
        value[k] = static_cast<double>(band(band.inside(at)));
      }
      if ((phi < 0.0) == (value[3] < 0.0)) continue;
      const auto along = [&](double s) {
        double sum = 0.0;
        for (int k = 0; k < 6; ++k) {
          double weight = value[k];
          for (int j = 0; j < 6; ++j) weight *= j == k ? 1.0 : (s + 2.0 - j) / (k - j);
          sum += weight;
        }
        return sum;
      };
      double low = 0.0, high = 1.0;
      for (int bisection = 0; bisection < 50; ++bisection) {
        const double middle = 0.5 * (low + high);
        ((along(middle) < 0.0) == (phi < 0.0) ? low : high) = middle;
      }
      Vec<D> x = band.lattice().position(node);
      x[d] += low * band.spacing();
      error = std::max(error, std::abs(exact(x)));
      sum_of_errors += std::abs(exact(x));
      crossings += 1.0;
    }
  });
  return mean ? sum_of_errors / crossings : error;
}

/// Volume where phi < 0: a node counts by the smoothed step of Towers' kind, exact to second order for a distance.
template <class L>
double enclosed(const L& level_set) {
  constexpr int D = L::dimension;
  const auto& band = level_set.band();
  const Lattice<D>& lattice = band.lattice();
  const double width = 2.0 * band.spacing();
  double sum = 0.0;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    const double s = -static_cast<double>(band(lattice.node(k))) / width;
    sum += s <= -1.0 ? 0.0 : s >= 1.0 ? 1.0 : 0.5 * (1.0 + s + std::sin(std::numbers::pi * s) / std::numbers::pi);
  }
  return sum * lattice.cell_volume();
}

/// Area between the zero sets of a 2D level set and of a function, by 8^2 points of each cell.
template <class L, class F>
double symmetric_difference(const L& level_set, F&& exact) {
  const auto& band = level_set.band();
  const Lattice<2>& lattice = band.lattice();
  Patch<double, 2> patch;
  patch.read(band, {-2, -2}, lattice.nodes() + Index<2>::constant(4));
  double sum = 0.0;
  for (std::size_t k = 0; k < lattice.size(); ++k) {
    const Index<2> node = lattice.node(k);
    if (node[0] + 1 >= lattice.nodes()[0] || node[1] + 1 >= lattice.nodes()[1]) continue;
    const Vec<2> corner = lattice.position(node);
    if (std::abs(band(node)) > 2.0 * band.spacing() && std::abs(exact(corner)) > 2.0 * band.spacing()) continue;
    for (int s = 0; s < 64; ++s) {
      const Vec<2> in_cell{(s % 8 + 0.5) / 8.0, (s / 8 + 0.5) / 8.0};
      const Vec<2> u = in_cell + Vec<2>{static_cast<double>(node[0] + 2), static_cast<double>(node[1] + 2)};
      const double phi = Interpolant<M4Prime, double, 2>::value(patch.data(), patch.stride(), u);
      sum += (phi < 0.0) != (exact(corner + band.spacing() * in_cell) < 0.0) ? 1.0 / 64.0 : 0.0;
    }
  }
  return sum * lattice.cell_volume();
}

/// True if two bands have the same blocks with the same bits.
template <class T, int D>
bool same_bits(const NarrowBand<T, D>& a, const NarrowBand<T, D>& b) {
  if (a.blocks() != b.blocks()) return false;
  for (std::size_t k = 0; k < a.blocks(); ++k) {
    if (!(a.values().block_index(k) == b.values().block_index(k))) return false;
    if (std::memcmp(a.values().block(k).data(), b.values().block(k).data(), a.volume * sizeof(T)) != 0) return false;
  }
  return true;
}

}  // namespace advection_scenes
