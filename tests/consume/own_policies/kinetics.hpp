// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/core/vec.hpp>

/// Lotka's and Volterra's prey and predators: Kinetics.
struct PreyAndPredators {
  static constexpr int species = 2;
  double births = 1.0;
  double deaths = 0.5;

  template <class T>
  cambium::Vec<2, T> operator()(const cambium::Vec<2, T>& c) const {
    return {c[0] * (T(births) - c[1]), c[1] * (c[0] - T(deaths))};
  }
};
