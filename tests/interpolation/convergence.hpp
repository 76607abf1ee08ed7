// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>
#include <numbers>

#include <cambium/interpolation.hpp>

#include "support/order.hpp"
#include "support/scattered.hpp"

/// Resolutions of an order test: four in 1D and 2D, each twice the one before; in 3D each 1.4 times.
template <int D>
constexpr std::array<std::ptrdiff_t, 4> resolutions =
    D < 3 ? std::array<std::ptrdiff_t, 4>{12, 24, 48, 96} : std::array<std::ptrdiff_t, 4>{20, 28, 40, 56};

/// Order over the last two refinements.
template <int D>
double order_over(const std::array<double, 4>& error) {
  return support::observed_order(error[1], error[3],
                                 static_cast<double>(resolutions<D>[3]) / static_cast<double>(resolutions<D>[1]));
}

/// A wave along the diagonal with a whole number of periods along every axis.
template <int D>
double wave(const cambium::Vec<D>& x, int periods) {
  return std::sin(0.4 + 2.0 * std::numbers::pi * periods * dot(x, cambium::Vec<D>::constant(1.0)));
}

/// Periods that keep the errors of Lambda84 above round-off, and those of M6 with three primes, whose leading term is
/// small, asymptotic.
template <class K, int D>
constexpr int periods_inside = K::moments > 6 && D < 3 ? 2 : 1;

/// Largest error of the wave read from a lattice of n cells at random points, or at points in the outermost cells.
template <class K, int D>
double reading_error(std::ptrdiff_t n, bool periodic, bool near_faces) {
  const auto box = cambium::Box<D>::cube();
  const auto lattice = periodic ? cambium::Lattice<D>::periodic_box(box, n) : cambium::Lattice<D>::bounded_box(box, n);
  auto x = support::random_positions<D>(lattice, 2000, 10);
  for (std::size_t p = 0; near_faces && p < x.size(); ++p) {
    double& along = x.array[static_cast<int>(p) % D][p];
    along = p % 4 < 2 ? along / static_cast<double>(n) : 1.0 - along / static_cast<double>(n);
  }
  const int periods = periodic ? periods_inside<K, D> : 1;  // errors near faces are much larger
  const auto mesh = cambium::sample(lattice, [&](const cambium::Vec<D>& at) { return wave(at, periods); });
  support::Table<1, double> read(x.size());
  cambium::Interpolator<K>().m2p(mesh, x.read(), read.write(), cambium::Serial{});
  double error = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    error = std::max(error, std::abs(read.array[0][p] - wave(x.read()[p], periods)));
  }
  return error;
}

/// Values read from a lattice are of order moments + 1, on bounded lattices up to the faces.
template <class K, int D>
void check_reading_order() {
  for (const int boundary : {0, 1, 2}) {
    std::array<double, 4> error;
    for (std::size_t r = 0; r < 4; ++r) {
      error[r] = reading_error<K, D>(resolutions<D>[r], boundary == 0, boundary == 2);
    }
    BOOST_TEST(order_over<D>(error) >= K::moments + 1 - 0.2,
               "reading, D = " << D << ", support " << K::support << ", boundary " << boundary << ": order "
                               << order_over<D>(error) << " from " << error[0] << " to " << error[3]);
  }
}

/// Largest error of the density of particles that carried wave(X) h^D from the nodes X of a periodic lattice to
/// X + displacement(X), against the exact density wave(X) / J at the nodes. The displacement is along all axes alike
/// and depends on x_0 + ... + x_{D-1}.
template <class K, int D, class Displacement, class Derivative>
double remeshing_error(std::ptrdiff_t n, Displacement&& displacement, Derivative&& derivative) {
  const auto lattice = cambium::Lattice<D>::periodic_box(cambium::Box<D>::cube(), n);
  const auto sum = [](const cambium::Vec<D>& x) { return dot(x, cambium::Vec<D>::constant(1.0)); };
  support::Table<D, double> x(lattice.size());
  support::Table<1, double> strength(lattice.size());
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const auto node = lattice.position(lattice.node(p));
    x.write().set(p, node + cambium::Vec<D>::constant(displacement(sum(node))));
    strength.array[0][p] = wave(node, periods_inside<K, D>) * lattice.cell_volume();
  }
  cambium::Field<double, D> mesh(lattice);
  cambium::Interpolator<K>().p2m(x.read(), strength.read(), mesh, cambium::Serial{});
  double error = 0.0;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const auto at = lattice.position(lattice.node(i));
    double s = sum(at);  // of the point that has come here: s + D displacement(s) = sum(at)
    for (int iteration = 0; iteration < 50; ++iteration)
      s += (sum(at) - s - D * displacement(s)) / (1.0 + D * derivative(s));
    const auto from = at - cambium::Vec<D>::constant(displacement(s));
    const double exact = wave(from, periods_inside<K, D>) / (1.0 + D * derivative(s));
    error = std::max(error, std::abs(mesh[i] / lattice.cell_volume() - exact));
  }
  return error;
}

/// All particles moved by the same part of a spacing: order moments + 1.
template <class K, int D>
void check_shift_order() {
  std::array<double, 4> error;
  for (std::size_t r = 0; r < 4; ++r) {
    const double shift = 1.37 / static_cast<double>(resolutions<D>[r]);
    error[r] = remeshing_error<K, D>(
        resolutions<D>[r], [&](double) { return shift; }, [](double) { return 0.0; });
  }
  BOOST_TEST(order_over<D>(error) >= K::moments + 1 - 0.2,
             "shifted particles, D = " << D << ", support " << K::support << ": order " << order_over<D>(error));
}

/// Particles moved by up to half a spacing, smoothly, so that the strain is of the order of a spacing: neighbours have
/// different offsets, and the smoothness of the weights matters. A kernel in C^r with p moments gives order
/// min(p, r) + 1 (Cottet, Etancelin, Perignon & Picard 2014), here between 160 and 1280 nodes.
template <class K>
double strained_order() {
  std::array<double, 4> error;
  for (std::size_t r = 0; r < 4; ++r) {
    const std::ptrdiff_t n = 160 << r;
    const double amplitude = 0.5 / static_cast<double>(n);
    constexpr double pi = std::numbers::pi;
    error[r] = remeshing_error<K, 1>(
        n, [&](double s) { return amplitude * std::sin(2.0 * pi * s + 1.0); },
        [&](double s) { return amplitude * 2.0 * pi * std::cos(2.0 * pi * s + 1.0); });
  }
  return support::observed_order(error[0], error[3], 8.0);
}

/// Particles of a lattice that carry a step, moved by a part of a spacing: smallest and largest value after remeshing.
template <class K, int D>
std::pair<double, double> step_range() {
  const auto lattice = support::lattice_of<D>(cambium::Index<D>::constant(2 * K::support + 6), 7);
  support::Table<D, double> x(lattice.size());
  support::Table<1, double> strength(lattice.size());
  for (std::size_t p = 0; p < lattice.size(); ++p) {
    const auto node = lattice.node(p);
    x.write().set(p, lattice.position(node) + cambium::Vec<D>::constant(0.4 * lattice.spacing()));
    for (int d = 0; d < D; ++d) strength.array[0][p] += node[d] < K::support + 3 ? 1.0 / D : 0.0;
  }
  cambium::Field<double, D> mesh(lattice);
  cambium::Interpolator<K>().p2m(x.read(), strength.read(), mesh, cambium::Serial{});
  const auto [lowest, highest] = std::minmax_element(mesh.values().begin(), mesh.values().end());
  return {*lowest, *highest};
}

/// An interpolating kernel gives values on the nodes back, both ways: its weights there are 0 and 1 to round-off of
/// their polynomials, summed over the stencil.
template <class K, int D>
void check_nodes_are_reproduced() {
  const auto box = cambium::Box<D>::cube();
  for (const bool periodic : {true, false}) {
    const auto lattice =
        periodic ? cambium::Lattice<D>::periodic_box(box, 16) : cambium::Lattice<D>::bounded_box(box, 16);
    const auto value = support::random_table<1, double>(lattice.size(), -1.0, 1.0, 11);
    support::Table<D, double> x(lattice.size());
    cambium::Field<double, D> mesh(lattice), spread(lattice);
    for (std::size_t p = 0; p < lattice.size(); ++p) {
      x.write().set(p, lattice.position(lattice.node(p)));
      mesh[p] = value.array[0][p];
    }
    support::Table<1, double> read(lattice.size());
    cambium::Interpolator<K> interpolate;
    interpolate.m2p(mesh, x.read(), read.write(), cambium::Serial{});
    interpolate.p2m(x.read(), value.read(), spread, cambium::Serial{});
    double error = 0.0;
    for (std::size_t p = 0; p < lattice.size(); ++p) {
      error = std::max({error, std::abs(read.array[0][p] - mesh[p]), std::abs(spread[p] - mesh[p])});
    }
    // Measured: 1e-16, and 1.6e-14 where round-off of Lambda64 is multiplied by its extrapolation.
    BOOST_TEST(error <= (periodic ? 1e-15 : 5e-14));
  }
}
