// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE neumann
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <limits>
#include <random>
#include <support/count_allocations.hpp>
#include <vector>

#include "neumann_scenes.hpp"

using namespace cambium;
using scenes::band_of;

namespace {

template <class F, class M>
struct Case {
  using Shape = F;
  using Flux = M;
};
using Cases = std::tuple<Case<scenes::Oval<2>, FaceCentroid>, Case<scenes::Oval<2>, FaceCentre>,
                         Case<scenes::Star, FaceCentroid>, Case<scenes::Oval<3>, FaceCentroid>,
                         Case<scenes::Oval<3>, FaceCentre>, Case<scenes::Ring, FaceCentroid>>;

Lattice<2> square(std::ptrdiff_t cells) { return Lattice<2>::bounded_box(Box<2>::cube(), cells); }

const auto still = [](const Vec<2>&) { return 0.0; };

}  // namespace

// Theory: 2, and h^2 log h (1.8 here) with fluxes in the middle of faces. How lattices cut the shape changes the
// constant: in 2D the mean over shifted ones.
BOOST_AUTO_TEST_CASE_TEMPLATE(second_order_in_the_largest_error, C, Cases) {
  constexpr int D = C::Shape::dimension;
  const typename C::Shape shape;
  constexpr int shifts = D == 2 ? 4 : 1;
  for (const double shift : {1.5, 0.0}) {
    const scenes::Manufactured<D> problem{shift};
    const auto error = [&](std::ptrdiff_t cells) {
      double sum = 0.0;
      for (int k = 0; k < shifts; ++k) {
        const double by = (0.3 * k) / static_cast<double>(cells);
        const Box<D> box{Vec<D>::constant(by), Vec<D>::constant(1.0 + by)};
        sum += scenes::neumann_error<typename C::Flux>(Lattice<D>::bounded_box(box, cells), shape, problem);
      }
      return sum / shifts;
    };
    const std::ptrdiff_t cells = D == 2 ? 48 : 36, finer = D == 2 ? 4 : 2;
    const double coarse = error(cells), fine = error(finer * cells);
    const double order = support::observed_order(coarse, fine, static_cast<double>(finer));
    BOOST_TEST_MESSAGE(D << "D s " << shift << " errors " << coarse << ' ' << fine << " order " << order);
    BOOST_CHECK_GT(order, (std::is_same_v<typename C::Flux, FaceCentre> ? 1.75 : 1.85));
    if (D == 3) break;
  }
}

BOOST_AUTO_TEST_CASE(second_order_around_a_shape_in_a_periodic_box) {
  const scenes::Oval<2> shape;
  const auto error = [&](std::ptrdiff_t cells) {
    return scenes::neumann_error<FaceCentroid>(Lattice<2>::periodic_box(Box<2>::cube(), cells), shape,
                                               scenes::Waves<2>{}, Side::outside);
  };
  BOOST_CHECK_GT(support::observed_order(error(48), error(192), 4.0), 1.85);
}

// The lattice may cut the shape in any way: cells of any size.
BOOST_AUTO_TEST_CASE(errors_do_not_depend_on_how_the_lattice_cuts_the_shape) {
  std::mt19937 random(7);
  std::uniform_real_distribution<> shift(0.0, 1.0 / 48.0);
  std::vector<double> errors;
  for (int k = 0; k < 60; ++k) {
    const Ball<2> ball({0.5 + shift(random), 0.5 + shift(random)}, 0.3);
    errors.push_back(scenes::neumann_error<FaceCentroid>(square(48), ball, scenes::Manufactured<2>{1.0}));
  }
  std::ranges::sort(errors);
  BOOST_TEST_MESSAGE("median " << errors[30] << " worst " << errors.back());
  BOOST_TEST(errors.back() < 3.0 * errors[30]);
}

// What a step changes in the total is what f and q bring, to round-off and not to the tolerance of the Krylov loop; in
// every part of the domain, wherever it lies.
BOOST_AUTO_TEST_CASE_TEMPLATE(totals_are_conserved, Flux, decltype(std::tuple<FaceCentroid, FaceCentre>())) {
  const auto lattice = square(40);
  const auto balls = [](const Vec<2>& x) {
    return std::min(norm(x - Vec<2>{0.31, 0.402}) - 0.17, norm(x - Vec<2>{0.69, 0.63}) - 0.2);
  };
  const double dt = 0.01, diffusivity = 0.3, theta = 0.5;
  typename Neumann<2, Flux>::Params params;
  params.shift = 1.0 / (theta * diffusivity * dt);
  params.tolerance = 1e-4;
  Neumann<2, Flux> neumann(band_of(lattice, balls), params);
  BOOST_TEST(neumann.parts() == 2U);
  const auto part = [](const Vec<2>& x) { return x[0] + x[1] < 1.0 ? 0.0 : 1.0; };
  auto u = sample(lattice, [&](const Vec<2>& x) { return part(x) * (1.0 + std::sin(9.0 * x[0]) * x[1]); });
  const auto source = sample(lattice, [&](const Vec<2>& x) { return part(x) * x[0]; });
  const auto q = [&](const Vec<2>& x) { return part(x) * std::cos(3.0 * x[1]); };
  double before = neumann.total(u);
  for (int k = 0; k < 3; ++k) {
    neumann.step(u, source, q, diffusivity, dt, theta);
    const double now = neumann.total(u);
    const double brought = dt * (neumann.total(source) + neumann.through_interface(q));
    BOOST_TEST(std::abs(now - before - brought) < 1e-15);
    before = now;
  }
  double other = 0.0;  // the total of the part where nothing is
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Index<2> node = lattice.node(i);
    if (part(lattice.position(node)) == 0.0) other += neumann.share(node) * u[i];
  }
  BOOST_TEST(std::abs(other) < 1e-15);
}

// exp(-D k^2 t) J_0(k r), J_1(k R) = 0: the first radial mode of a closed disk (k R = 3.831705970207512).
BOOST_AUTO_TEST_CASE(a_mode_of_a_disk_decays_as_it_must) {
  const double radius = 0.35, k = 3.831705970207512 / radius, diffusivity = 0.5, end = 0.02;
  const Vec<2> centre{0.51, 0.493};
  const Ball<2> ball(centre, radius);
  const auto error = [&](std::ptrdiff_t cells, int steps, double theta) {
    const auto lattice = square(cells);
    const double dt = end / steps;
    Neumann<2> neumann(band_of(lattice, ball), {.shift = 1.0 / (theta * diffusivity * dt)});
    const auto mode = sample(lattice, [&](const Vec<2>& x) { return std::cyl_bessel_j(0.0, k * norm(x - centre)); });
    auto u = mode;
    const Field<double, 2> source(lattice);
    for (int s = 0; s < steps; ++s) neumann.step(u, source, still, diffusivity, dt, theta);
    double worst = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (ball(lattice.position(lattice.node(i))) < 0.0) {
        worst = std::max(worst, std::abs(u[i] - std::exp(-diffusivity * k * k * end) * mode[i]));
      }
    }
    return worst;
  };
  const double coarse = error(32, 8, 0.5), fine = error(128, 32, 0.5);
  BOOST_TEST_MESSAGE("Crank and Nicolson " << coarse << ' ' << fine);
  BOOST_CHECK_GT(support::observed_order(coarse, fine, 4.0), 1.85);
  const double slow = error(96, 8, 1.0), fast = error(96, 32, 1.0);
  BOOST_TEST_MESSAGE("Euler " << slow << ' ' << fast);
  BOOST_TEST(std::abs(support::observed_order(slow, fast, 4.0) - 1.0) < 0.15);
}

// Symmetry of the equations with fluxes in the middle of faces; constants do not diffuse.
BOOST_AUTO_TEST_CASE(the_operator_is_symmetric_and_keeps_constants) {
  const auto lattice = square(32);
  Neumann<2, FaceCentre> neumann(band_of(lattice, scenes::Star{}), {});
  std::mt19937 random(3);
  std::uniform_real_distribution<> value(-1.0, 1.0);
  Field<double, 2> a(lattice), b(lattice), of_a(lattice), of_b(lattice);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = value(random);
    b[i] = value(random);
  }
  neumann.negative_laplacian(a, still, of_a);
  neumann.negative_laplacian(b, still, of_b);
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    left += neumann.share(lattice.node(i)) * b[i] * of_a[i];
    right += neumann.share(lattice.node(i)) * a[i] * of_b[i];
  }
  BOOST_TEST(std::abs(left - right) < 1e-11 * std::abs(left));
  const Field<double, 2> one(lattice, 1.0);
  neumann.negative_laplacian(one, still, of_a);
  BOOST_TEST(*std::ranges::max_element(of_a.values()) < 1e-6);  // round-off over h^2 and small shares
}

BOOST_AUTO_TEST_CASE(volume_and_area_are_of_second_order) {
  const double pi = std::numbers::pi;
  const auto errors = [&](std::ptrdiff_t cells) {
    const Neumann<2> neumann(band_of(square(cells), Ball<2>({0.51, 0.493}, 0.3)), {});
    return std::pair{std::abs(neumann.volume() - pi * 0.09), std::abs(neumann.area() - pi * 0.6)};
  };
  const auto coarse = errors(32), fine = errors(128);
  BOOST_CHECK_GT(support::observed_order(coarse.first, fine.first, 4.0), 1.85);
  BOOST_CHECK_GT(support::observed_order(coarse.second, fine.second, 4.0), 1.85);
}

// Cells of which 1e-9 and less is in the domain.
BOOST_AUTO_TEST_CASE(slivers_are_harmless) {
  for (const double sliver : {0.0, 1e-12, 1e-9, 1e-6}) {
    const auto edge = [&](const Vec<2>& x) {
      return std::max(std::abs(x[0] - 0.5), std::abs(x[1] - 0.5)) - 0.25 - sliver;
    };
    const scenes::Manufactured<2> problem{1.0};
    BOOST_TEST(scenes::neumann_error<FaceCentroid>(square(32 + 2), edge, problem) < 2e-2);
    const auto shifted = [&](const Vec<2>& x) { return norm(x - Vec<2>{0.5, 0.5}) - 0.25 - 0.5 / 32.0 - sliver; };
    BOOST_TEST(scenes::neumann_error<FaceCentroid>(square(32), shifted, problem) < 2e-3);
  }
}

BOOST_AUTO_TEST_CASE(what_does_not_balance_is_refused_and_told) {
  const auto lattice = square(32);
  Neumann<2> neumann(band_of(lattice, Ball<2>({0.5, 0.5}, 0.3)), {});
  const Field<double, 2> f(lattice, 1.0);
  Field<double, 2> u(lattice, 7.0);
  // The sum it tells is the area of the disk as the cells count it.
  const auto tells = [&](const ValueError& error) {
    return std::string(error.what()).find(detail::message(neumann.volume()).substr(0, 5)) != std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(neumann.solve(f, still, u), ValueError, tells);
  BOOST_TEST(u[500] == 7.0);
  const double balanced = -neumann.volume() / neumann.area();
  neumann.solve(
      f, [&](const Vec<2>&) { return balanced; }, u);
  BOOST_TEST(std::abs(neumann.total(u)) < 1e-14);
  typename Neumann<2>::Params params;
  params.mean = MeanPart::subtract;
  Neumann<2> lenient(band_of(lattice, Ball<2>({0.5, 0.5}, 0.3)), params);
  Field<double, 2> zero(lattice);
  lenient.solve(f, still, zero);
  for (std::size_t i = 0; i < zero.size(); ++i) BOOST_CHECK_SMALL(zero[i], 1e-12);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused_and_changes_nothing) {
  const auto lattice = square(24);
  const auto band = band_of(lattice, Ball<2>({0.5, 0.5}, 0.3));
  BOOST_CHECK_THROW(Neumann<2>(band, {.shift = -1.0}), ValueError);
  // Smaller than a spacing, around a node; and closer than two spacings to the box.
  BOOST_CHECK_THROW(Neumann<2>(band_of(lattice, Ball<2>({0.5, 0.5}, 0.3 / 24.0)), {}), InterfaceError);
  BOOST_CHECK_THROW(Neumann<2>(band_of(lattice, Ball<2>({0.5, 0.35}, 0.3)), {}), InterfaceError);
  Neumann<2> neumann(band, {.shift = 1.0});
  Field<double, 2> f(lattice), u(lattice, 7.0), other(square(12));
  BOOST_CHECK_THROW(neumann.solve(other, still, u), SizeError);
  BOOST_CHECK_THROW(neumann.solve(f, still, other), SizeError);
  BOOST_CHECK_THROW(neumann.total(other), SizeError);
  BOOST_CHECK_THROW(neumann.solve(
                        f, [](const Vec<2>&) { return std::nan(""); }, u),
                    ValueError);
  BOOST_CHECK_THROW(neumann.step(u, f, still, 1.0, 0.5, 1.0), ValueError);
  f(Index<2>{12, 12}) = std::numeric_limits<double>::infinity();
  BOOST_CHECK_THROW(neumann.solve(f, still, u), ValueError);
  f(Index<2>{12, 12}) = 1.0;
  Neumann<2> hasty(band, {.shift = 1.0, .tolerance = 1e-14, .most_iterations = 1});
  BOOST_CHECK_THROW(hasty.solve(f, still, u), ConvergenceError);
  BOOST_TEST(std::ranges::count(u.values(), 7.0) == static_cast<std::ptrdiff_t>(u.size()));
}

// But for the residuals of the report; vectors are those of the first solve and the first step.
BOOST_AUTO_TEST_CASE(solutions_take_no_memory) {
  const auto lattice = square(32);
  const auto band = band_of(lattice, scenes::Oval<2>{});
  using Problem = Neumann<2, FaceCentroid, double, Serial>;
  Problem steady(band, {.mean = MeanPart::subtract}, Serial{}), unsteady(band, {.shift = 20.0}, Serial{});
  const auto f = sample(lattice, [](const Vec<2>& x) { return std::sin(5.0 * x[0]) + x[1]; });
  Field<double, 2> u(lattice), out(lattice);
  for (int k = 0; k < 2; ++k) {
    std::size_t before = support::allocations;
    const std::size_t bytes = support::allocated_bytes;
    steady.solve(f, still, u);
    if (k > 0) BOOST_TEST(support::allocations - before == support::counted(1));
    before = support::allocations;
    unsteady.step(u, f, still, 1.0, 0.1, 0.5);
    if (k > 0) BOOST_TEST(support::allocations - before == support::counted(1));
    if (k > 0) BOOST_TEST(support::allocated_bytes - bytes < 4000U);
    before = support::allocations;
    unsteady.negative_laplacian(u, still, out);
    if (k > 0) BOOST_TEST(support::allocations - before == 0U);
  }
}

BOOST_AUTO_TEST_CASE(threads_do_not_change_a_bit) {
  const auto lattice = Lattice<3>::bounded_box(Box<3>::cube(), 28);
  const auto band = band_of(lattice, scenes::Oval<3>{});
  const auto f = sample(lattice, [](const Vec<3>& x) { return std::sin(5.0 * x[0]) + x[1] * x[2]; });
  const auto run = [&](int threads) {
    Neumann<3> neumann(band, {.shift = 1.0}, OpenMP{threads});
    Field<double, 3> u(lattice);
    neumann.solve(
        f, [](const Vec<3>& x) { return x[2]; }, u);
    return u;
  };
  const auto one = run(1);
  for (const int threads : {2, 3}) {
    const auto several = run(threads);
    BOOST_TEST(std::equal(one.values().begin(), one.values().end(), several.values().begin()));
  }
}
