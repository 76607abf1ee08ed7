// expect: a right-hand side is callable as rhs\(state, t, derivative\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include <cambium/time.hpp>

int main() {
  std::vector<double> state{1.0};
  cambium::RK4 stepper(state);
#ifdef CAMBIUM_CONTROL
  stepper.step(state, 0.0, 0.1, [](const auto& y, double, auto& d) { d[0] = -y[0]; });
#else
  stepper.step(state, 0.0, 0.1, [](const std::vector<double>& y, double) { return y; });
#endif
}
