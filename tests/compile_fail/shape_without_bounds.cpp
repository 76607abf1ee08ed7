// expect: cambium: a shape is called with a position, shape\(x\) < 0 inside, and has Box<D> bounds\(\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/shapes/shape.hpp>

struct Disk {
  static constexpr int dimension = 2;
  static constexpr double lipschitz = 1.0;
  double operator()(const cambium::Vec<2>& x) const { return norm(x) - 1.0; }
#ifdef CAMBIUM_CONTROL
  cambium::Box<2> bounds() const { return {{-1.0, -1.0}, {1.0, 1.0}}; }
#endif
};

int main() { cambium::check_shape<Disk>(); }
