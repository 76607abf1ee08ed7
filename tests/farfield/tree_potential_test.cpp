// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE tree_potential
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <support/cloud.hpp>
#include <tuple>

#include <cambium/farfield/tree_potential.hpp>

using cambium::Columns;
using cambium::direct_potential;
using cambium::OpenMP;
using cambium::TreePotential;
using cambium::Vec;

namespace {

using Dimensions = std::tuple<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

/// Points of the unit box, one half of them in a corner a tenth as long, and numbers of one sign or of both.
template <int D>
struct Points {
  support::Arrays<D> x;
  std::vector<double> q;

  Points(std::size_t count, bool signs, unsigned seed) : x(count), q(count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<> any;
    for (std::size_t p = 0; p < count; ++p) {
      for (auto& axis : x.array) axis[p] = (p % 2 == 0 ? 1.0 : 0.1) * any(random);
      q[p] = signs ? 2.0 * any(random) - 1.0 : any(random);
    }
  }
  Columns<D, const double> positions() { return x.columns(); }
};

template <int D>
struct Result {
  std::vector<double> potential;
  support::Arrays<D> gradient;
  explicit Result(std::size_t count) : potential(count), gradient(count) {}
};

/// sum |q| / (norm r^power)
template <int D>
double scale(Points<D>& sources, const Vec<D>& x, int power) {
  double sum = 0.0;
  for (std::size_t s = 0; s < sources.q.size(); ++s) {
    const double r = norm(x - sources.positions()[s]);
    if (r > 0.0) sum += std::abs(sources.q[s]) / (power == 1 ? r : r * r);
  }
  return sum / cambium::detail::far_norm<D>;
}

}  // namespace

// The formula, written out; a source on a target is left out. Round-off of sums of 60 numbers.
BOOST_AUTO_TEST_CASE_TEMPLATE(the_plain_sum_is_the_formula, Which, Dimensions) {
  constexpr int D = Which::value;
  Points<D> sources(60, true, 1), targets(21, true, 2);
  for (auto& axis : targets.x.array)
    axis[3] = sources.x.array[static_cast<std::size_t>(&axis - &targets.x.array[0])][7];
  Result<D> found(21);
  direct_potential<D>(sources.positions(), sources.q, targets.positions(), found.potential, found.gradient.columns());
  for (std::size_t t = 0; t < 21; ++t) {
    double potential = 0.0;
    Vec<D> gradient;
    for (std::size_t s = 0; s < 60; ++s) {
      const Vec<D> away = targets.positions()[t] - sources.positions()[s];
      const double r = norm(away), norm = cambium::detail::far_norm<D>;
      if (r == 0.0) continue;
      potential += sources.q[s] / norm * (D == 2 ? -std::log(r) : 1.0 / r);
      gradient -= away * (sources.q[s] / (norm * std::pow(r, D)));
    }
    BOOST_TEST(std::abs(found.potential[t] - potential) < 1e-13 * scale<D>(sources, targets.positions()[t], 1));
    BOOST_TEST(norm(found.gradient.columns()[t] - gradient) < 1e-12 * scale<D>(sources, targets.positions()[t], D - 1));
  }
}

// The error is a bound: at no target above `tolerance` times the scale. Sources of one sign come nearest to it;
// measured 1/30 to 1/2000 of it. That far clusters do act by expansions is asked for, too. Round-off: 1e-13.
BOOST_AUTO_TEST_CASE_TEMPLATE(errors_stay_below_the_tolerance, Which, Dimensions) {
  constexpr int D = Which::value;
  const std::size_t count = 3000, targets_count = 300;
  for (const bool signs : {false, true}) {
    Points<D> sources(count, signs, 3), targets(targets_count, signs, 4);
    for (auto& axis : targets.x.array) axis[0] = 3.0;  // outside, too
    Result<D> exact(targets_count), found(targets_count);
    direct_potential<D>(sources.positions(), sources.q, targets.positions(), exact.potential, exact.gradient.columns());
    std::vector<double> unit(targets_count), gradient_unit(targets_count);
    double total = 0.0;
    for (const double q : sources.q) total += std::abs(q) / cambium::detail::far_norm<D>;
    for (std::size_t t = 0; t < targets_count; ++t) {
      unit[t] = D == 2 ? total : scale<D>(sources, targets.positions()[t], 1);
      gradient_unit[t] = scale<D>(sources, targets.positions()[t], D - 1);
    }
    double before = 1.0;
    for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9}) {
      TreePotential<D> tree({tolerance});
      tree.set_sources(sources.positions(), sources.q);
      const auto worst = [&] {
        double error = 0.0;
        for (std::size_t t = 0; t < targets_count; ++t) {
          error = std::max(error, std::abs(found.potential[t] - exact.potential[t]) / unit[t]);
        }
        return error;
      };
      tree.evaluate(targets.positions(), found.potential);
      const double potential_error = worst();
      BOOST_TEST(tree.work().expansions > 5 * targets_count);
      tree.evaluate(targets.positions(), found.potential, found.gradient.columns());
      double gradient_error = 0.0;
      for (std::size_t t = 0; t < targets_count; ++t) {
        const Vec<D> error = found.gradient.columns()[t] - exact.gradient.columns()[t];
        gradient_error = std::max(gradient_error, norm(error) / gradient_unit[t]);
      }
      BOOST_TEST_MESSAGE(D << "D tolerance " << tolerance << " errors " << potential_error << ' ' << worst() << ' '
                           << gradient_error);
      BOOST_TEST(potential_error < tolerance);
      BOOST_TEST(worst() < tolerance);
      BOOST_TEST(gradient_error < tolerance);
      BOOST_TEST(potential_error < 0.1 * before);
      before = potential_error;
    }
  }
}

// Interactions for each target grow like log N: by less than a half from N to 4 N, where the plain sum's grow by 4.
// Measured 1.2 in the plane, 1.35 in space.
BOOST_AUTO_TEST_CASE_TEMPLATE(work_grows_like_n_log_n, Which, Dimensions) {
  constexpr int D = Which::value;
  const auto work = [](std::size_t count) {
    Points<D> sources(count, true, 5), targets(320, true, 6);
    TreePotential<D> tree({1e-3});
    tree.set_sources(sources.positions(), sources.q);
    std::vector<double> potential(320);
    tree.evaluate(targets.positions(), potential);
    return static_cast<double>(tree.work().direct + tree.work().terms) / 320.0;
  };
  const double growth = work(100000) / work(25000);
  BOOST_TEST_MESSAGE(D << "D growth " << growth);
  BOOST_TEST(growth < 1.5);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(threads_do_not_change_a_bit, Which, Dimensions) {
  constexpr int D = Which::value;
  Points<D> sources(2500, true, 7), targets(1001, true, 8);
  const auto run = [&](int threads) {
    Result<D> found(1001);
    TreePotential<D> tree({1e-5}, OpenMP{threads});
    tree.set_sources(sources.positions(), sources.q);
    tree.evaluate(targets.positions(), found.potential, found.gradient.columns());
    return found;
  };
  const auto one = run(1);
  for (const int threads : {2, 3}) {
    const auto several = run(threads);
    BOOST_TEST((one.potential == several.potential));
    BOOST_TEST((one.gradient.array == several.gradient.array));
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(odd_sources_are_served_and_bad_ones_refused, Which, Dimensions) {
  constexpr int D = Which::value;
  Points<D> sources(300, true, 9), targets(9, true, 10);
  for (auto& axis : sources.x.array) std::fill(axis.begin() + 50, axis.end(), 0.25);  // 250 at one place
  Result<D> exact(9), found(9);
  TreePotential<D> tree({1e-8});
  tree.evaluate(targets.positions(), found.potential);  // of no sources
  BOOST_TEST(found.potential == std::vector<double>(9), boost::test_tools::per_element());
  tree.set_sources(sources.positions(), sources.q);
  tree.evaluate(targets.positions(), found.potential, found.gradient.columns());
  direct_potential<D>(sources.positions(), sources.q, targets.positions(), exact.potential, exact.gradient.columns());
  for (std::size_t t = 0; t < 9; ++t) BOOST_TEST(std::abs(found.potential[t] - exact.potential[t]) < 1e-5);

  BOOST_CHECK_THROW(TreePotential<D>({0.0}), cambium::ValueError);
  BOOST_CHECK_THROW(TreePotential<D>({std::nan("")}), cambium::ValueError);
  const auto before = found.potential;
  auto bad = sources;
  bad.q[4] = std::nan("");
  BOOST_CHECK_THROW(tree.set_sources(bad.positions(), bad.q), cambium::ValueError);
  bad = sources;
  bad.x.array[1][5] = std::numeric_limits<double>::infinity();
  BOOST_CHECK_THROW(tree.set_sources(bad.positions(), bad.q), cambium::PositionError);
  BOOST_CHECK_THROW(tree.set_sources(sources.positions(), std::span(sources.q).first(7)), cambium::SizeError);
  auto outside = targets;
  outside.x.array[0][2] = std::nan("");
  BOOST_CHECK_THROW(tree.evaluate(outside.positions(), found.potential), cambium::PositionError);
  BOOST_CHECK_THROW(tree.evaluate(targets.positions(), std::span(found.potential).first(3)), cambium::SizeError);
  BOOST_TEST(found.potential == before, boost::test_tools::per_element());
  tree.evaluate(targets.positions(), found.potential, found.gradient.columns());
  BOOST_TEST(found.potential == before, boost::test_tools::per_element());
}
