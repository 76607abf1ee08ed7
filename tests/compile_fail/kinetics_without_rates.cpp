// expect: kinetics are called as kinetics\(c\) const with a Vec<species>
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/reaction.hpp>

struct Decay {
  static constexpr int species = 1;
#ifdef CAMBIUM_CONTROL
  cambium::Vec<1> operator()(const cambium::Vec<1>& c) const { return -c; }
#else
  double operator()(double c) const { return -c; }
#endif
};

int main() {
  cambium::check_kinetics<Decay>();
  return 0;
}
