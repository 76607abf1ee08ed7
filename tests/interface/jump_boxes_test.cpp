// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE jump_boxes
#include <boost/test/unit_test.hpp>

#include "interface/jump_scenes.hpp"
#include "support/order.hpp"

using namespace cambium;
using namespace scenes;

namespace {

/// Largest errors in the unit box with exact values or derivatives of the outer solution on its faces.
template <int D>
JumpErrors solve_in_box(const AnyShape<D>& shape, std::ptrdiff_t cells, const std::array<Boundary, D>& boundary) {
  using Solution = ProductAndExponential<D>;
  std::array<bool, D> periodic{};
  bool unique = false;
  for (int d = 0; d < D; ++d) {
    periodic[d] = boundary[d] == Boundary::periodic;
    unique = unique || boundary[d] == Boundary::dirichlet;
  }
  const Lattice<D> lattice(Box<D>::cube(), 1.0 / static_cast<double>(cells), periodic);
  FaceValues<D> given(lattice);
  given.sample([](int d, int side, const Vec<D>& x) { return (2 * side - 1) * Solution::gradient(false, x)[d]; });
  return solve_jump_with<Jump<D>, Solution, SecondOrder>(shape, lattice, !unique, [&](const auto& f, auto& p) {
    p.sample([](const Vec<D>& x) { return Solution::value(false, x); });  // read at Dirichlet faces alone
    BoxPoisson<D>(lattice, boundary, {.mean = MeanPart::subtract}).solve(f, given, p);
  });
}

template <int D>
void check_box(const AnyShape<D>& shape, std::ptrdiff_t cells, const std::array<Boundary, D>& boundary) {
  const JumpErrors coarse = solve_in_box<D>(shape, cells, boundary), fine = solve_in_box<D>(shape, 2 * cells, boundary);
  const double p = support::observed_order(coarse.p, fine.p);
  const double there = support::observed_order(coarse.gradient_at_interface, fine.gradient_at_interface);
  BOOST_TEST_MESSAGE(D << "D: p " << fine.p << " order " << p << ", gradient at the interface "
                       << fine.gradient_at_interface << " order " << there);
  BOOST_TEST(p > 1.9);
  BOOST_TEST(there > 1.8);
}

constexpr Boundary values = Boundary::dirichlet, slopes = Boundary::neumann, closed = Boundary::periodic;

}  // namespace

// The solvers of boxes are used as they are.
BOOST_AUTO_TEST_CASE(second_order_in_boxes_of_the_plane) {
  check_box<2>(Ellipse{}, 64, {values, values});
  check_box<2>(Ellipse{}, 64, {slopes, slopes});
  check_box<2>(Circle{}, 64, {slopes, values});
  check_box<2>(Circle{}, 64, {closed, values});
  check_box<2>(Star{}, 128, {closed, slopes});
}

BOOST_AUTO_TEST_CASE(second_order_in_boxes_of_space) {
  check_box<3>(LongEllipsoid{}, 32, {values, values, values});
  check_box<3>(Sphere{}, 32, {slopes, closed, values});
}
