// expect: cambium: a shape bounds its slope: static constexpr double lipschitz
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/shapes/shape.hpp>

struct Disk {
  static constexpr int dimension = 2;
#ifdef CAMBIUM_CONTROL
  static constexpr double lipschitz = 1.0;
#endif
  double operator()(const cambium::Vec<2>& x) const { return norm(x) - 1.0; }
  cambium::Box<2> bounds() const { return {{-1.0, -1.0}, {1.0, 1.0}}; }
};

int main() { cambium::check_shape<Disk>(); }
