// expect: a state is a std::vector, .* or a copyable struct with arrays\(\) and arrays\(\) const
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include <cambium/time.hpp>

struct Pendulum {
  std::vector<double> angle;
#ifdef CAMBIUM_CONTROL
  auto arrays() const { return std::tuple(std::span(angle)); }
#endif
  auto arrays() { return std::tuple(std::span(angle)); }
};

int main() { cambium::RK4<Pendulum> stepper; }
