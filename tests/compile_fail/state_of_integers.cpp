// expect: every array of a state is a std::span of float, double, or Vec of them
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <vector>

#include <cambium/time.hpp>

#ifdef CAMBIUM_CONTROL
using Number = double;
#else
using Number = int;
#endif

int main() { cambium::Euler<std::vector<Number>> stepper; }
