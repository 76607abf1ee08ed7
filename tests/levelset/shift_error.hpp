// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>

#include <cambium/levelset/advection/lagrangian.hpp>

#include "levelset/advection_scenes.hpp"

namespace advection_scenes {

/// Error of the interface after four shifts that are no whole spacings. After a shift all sums of weights are 1, and
/// phi is that of the kernel's interpolant.
template <class K, int D>
double shift_error(std::ptrdiff_t n) {
  const auto lattice = Lattice<D>::periodic_box(Box<D>::cube(), n);
  LevelSet<ClosestPoint, D, double> ball(lattice, Ball<D>{}, {}, Serial{});
  Lagrangian<K> advection({.reinitialise_every = 1});
  Vec<D> u;
  for (int d = 0; d < D; ++d) u[d] = 0.11 + 0.07 * d;
  const Ball<D> moved{Ball<D>{}.centre + u, Ball<D>{}.radius};
  for (int k = 0; k < 4; ++k) {
    const auto report = advection.step(
        ball, [&](const Vec<D>&, double) { return u; }, 0.25 * k, 0.25, Serial{});
    BOOST_TEST(report.remeshings == 1u);  // a shift is no distortion, however far it goes
    BOOST_TEST(report.distortion <= 1e-12);
  }
  return interface_error(ball, moved);
}

}  // namespace advection_scenes
