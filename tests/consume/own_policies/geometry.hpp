// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/geometry/centred_differences.hpp>

/// Normals that point inwards, as some papers have them: GeometryPolicy.
struct Inwards {
  struct Params {};

  template <class T, int D>
  class Method {
   public:
    explicit Method(const Params& = {}) {}

    template <cambium::Execution E>
    void operator()(const cambium::NarrowBand<T, D>& band, cambium::BandGeometry<T, D>& geometry, const E& execution) {
      outwards_(band, geometry, execution);
      for (std::size_t b = 0; b < band.blocks(); ++b) {
        for (auto& n : geometry.normal.block(b)) n *= T(-1);
        for (T& curvature : geometry.mean.block(b)) curvature *= T(-1);
      }
    }

   private:
    typename cambium::CentredDifferences<2>::template Method<T, D> outwards_{{}};
  };
};
