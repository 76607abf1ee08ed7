// expect: cambium: a geometry policy.s Method is made from Params and called as method\(band, geometry, execution\)
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/geometry/band_geometry.hpp>

struct Flat {
  struct Params {};
  template <class T, int D>
  struct Method {
    explicit Method(const Params&) {}
#ifdef CAMBIUM_CONTROL
    template <cambium::Execution E>
    void operator()(const cambium::NarrowBand<T, D>&, cambium::BandGeometry<T, D>&, const E&) {}
#endif
    void operator()(const cambium::NarrowBand<T, D>&, cambium::BandGeometry<T, D>&) {}
  };
};

int main() { cambium::check_geometry_policy<Flat>(); }
