// expect: a difference symbol needs static constexpr int order, second\(theta\) and first\(theta\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/poisson.hpp>

struct Second {
  static constexpr int order = 2;
  static double second(double theta) { return theta * theta; }
#ifdef CAMBIUM_CONTROL
  static double first(double theta) { return theta; }
#endif
};

int main() {
  cambium::PeriodicPoisson<2, Second> poisson(cambium::Lattice<2>::periodic_box(cambium::Box<2>::cube(), 8));
  return poisson.lattice().nodes()[0] == 8 ? 0 : 1;
}
