// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE jump_free_space
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <tuple>

#include <cambium/interface.hpp>
#include <cambium/levelset.hpp>
#include <cambium/poisson.hpp>

#include "support/fed_ball.hpp"
#include "support/order.hpp"

using namespace cambium;

namespace {

struct Errors {
  double speed = 0.0;  ///< of V at the interface from either side, relative, largest
  double jump = 0.0;   ///< of p_in - p_out there
};

template <int D>
Errors errors(std::ptrdiff_t cells) {
  using Case = support::FedBall<D>;
  const auto lattice = Case::lattice(cells);
  const LevelSet<ClosestPoint, D> level_set(lattice, Ball<D>(Case::centre(), Case::radius));
  const auto& band = level_set.band();
  Field<double, D> f(lattice), p(lattice);
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Index<D> node = lattice.node(i);
    if (band(node) < 0.0) f[i] = Case::source(lattice.position(node));
  }
  Jump<D> jump(lattice);
  jump.attach(band, level_set.method().points());
  constexpr double pressure = Case::surface_pressure;
  jump.set([](const Vec<D>&) { return -pressure; }, NoJump{}, [](const Vec<D>& x) { return -Case::source(x); });
  jump.correct(f);
  FreeSpacePoisson<D>(lattice).solve(f, p);
  InterfaceSides<D> sides(lattice);
  jump.at_interface(p, sides);

  Errors largest;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (std::abs(band.values().block(b)[i]) > lattice.spacing()) continue;
      const Vec<D> x = lattice.position(band.values().node(b, i)) - Case::centre();
      const Vec<D> normal = x / norm(x);
      for (const auto* gradient : {&sides.gradient_inside, &sides.gradient_outside}) {
        const double speed = -dot(gradient->block(b)[i], normal);
        largest.speed = std::max(largest.speed, std::abs(speed / Case::speed() - 1.0));
      }
      const double found = sides.inside.block(b)[i] - sides.outside.block(b)[i];
      largest.jump = std::max(largest.jump, std::abs(found - pressure));
    }
  }
  return largest;
}

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(a_fed_ball_grows_as_fast_as_it_should, I, Dimensions) {
  constexpr int D = I::value;
  const Errors coarse = errors<D>(32), fine = errors<D>(64);
  BOOST_TEST_MESSAGE(D << "D: speed " << coarse.speed << " to " << fine.speed << ", order "
                       << support::observed_order(coarse.speed, fine.speed) << ", jump " << fine.jump);
  BOOST_TEST(fine.speed < 0.01);
  BOOST_TEST(support::observed_order(coarse.speed, fine.speed) > 1.8);
  BOOST_TEST(fine.jump < 1e-12);  // it is what was put in
}
