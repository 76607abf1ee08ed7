// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/models/surface_motion.hpp>

/// The surface is carried by a uniform wind: SurfaceMotion.
template <int D>
struct Wind {
  static constexpr bool moves = true;
  static constexpr bool coupled = false;
  cambium::Vec<D> speed;

  template <class L, class B, class C, class E>
  auto velocity(const L&, const B&, const C&, const E&) const {
    return [u = speed](const auto&, double) { return u; };
  }
};
