// expect: cambium: a jump rule has on_leg\(here, far, distance_here, distance_far\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cambium/interface/jump_rule.hpp>

struct Rule {
  template <class T>
  static T at_node(T, T, T a, T, T, T) {
    return a;
  }
#ifdef CAMBIUM_CONTROL
  template <class T>
  static T on_leg(T, T far, T, T) {
    return far;
  }
#endif
  template <class T, int D>
  static cambium::Vec<D, T> gradient(const cambium::Vec<D, T>& t, const cambium::Vec<D, T>&, T) {
    return t;
  }
};

int main() { cambium::check_jump_rule<Rule>(); }
