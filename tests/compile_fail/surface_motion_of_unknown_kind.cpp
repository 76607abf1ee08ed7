// expect: cambium: a motion of a surface says whether it moves and whether it is coupled
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/models/surface_motion.hpp>

struct Drift {
  static constexpr bool moves = true;
#ifdef CAMBIUM_CONTROL
  static constexpr bool coupled = false;
#endif
};

int main() { cambium::check_surface_motion<Drift>(); }
