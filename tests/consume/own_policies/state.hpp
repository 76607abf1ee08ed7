// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

/// Angles and rates of pendulums that swing a little: State.
struct Pendulums {
  std::vector<double> angle, rate;

  auto arrays() { return std::tuple(std::span(angle), std::span(rate)); }
  auto arrays() const { return std::tuple(std::span(angle), std::span(rate)); }
};
