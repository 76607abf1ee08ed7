// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/interface/jump_rule.hpp>

/// The jump continued linearly along the normal, without curvature: JumpRule.
struct LinearJump {
  template <class T>
  static T at_node(T distance, T, T a, T b, T, T) {
    return a + distance * b;
  }
  template <class T>
  static T on_leg(T, T far, T, T) {
    return far;
  }
  template <class T, int D>
  static cambium::Vec<D, T> gradient(const cambium::Vec<D, T>& along, const cambium::Vec<D, T>& normal, T b) {
    return along + b * normal;
  }
};
