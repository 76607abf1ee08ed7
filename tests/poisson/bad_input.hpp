// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>
#include <limits>

#include <cambium/core/error.hpp>
#include <cambium/core/field.hpp>

namespace support {

/// A solver in free space refuses periodic lattices, fields of another lattice and numbers that are not finite, and
/// leaves its result as it was.
template <class Solver, int D>
void check_bad_input_is_refused() {
  using cambium::Box, cambium::Field, cambium::Lattice;
  BOOST_CHECK_THROW(Solver(Lattice<D>::periodic_box(Box<D>::cube(), 8)), cambium::LatticeError);
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), 8);
  Solver poisson(lattice);
  Field<double, D> f(lattice), u(lattice, 9.0), other(Lattice<D>::bounded_box(Box<D>::cube(2.0), 8));
  BOOST_CHECK_THROW(poisson.solve(other, u), cambium::SizeError);
  BOOST_CHECK_THROW(poisson.solve(f, other), cambium::SizeError);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    f[37] = bad;
    BOOST_CHECK_THROW(poisson.solve(f, u), cambium::ValueError);
  }
  BOOST_TEST(u[5] == 9.0);
}

}  // namespace support
