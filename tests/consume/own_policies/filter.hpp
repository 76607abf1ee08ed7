// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/models/tumour/policy.hpp>

/// No tissue grows faster than this: TumourPolicy of the kind Filter.
template <int Most>
struct SpeedLimit {
  using Kind = cambium::tumour_kind::Filter;

  template <int D>
  class Method {
   public:
    explicit Method(const cambium::Lattice<D>&) {}

    void operator()(const cambium::NarrowBand<double, D>&, cambium::Field<double, D, cambium::Sparse>& speed,
                    const cambium::OpenMP&) const {
      for (std::size_t b = 0; b < speed.blocks(); ++b) {
        for (double& v : speed.block(b)) v = v > Most ? Most : v;  // NaN, at nodes without a speed, stays
      }
    }
  };
};
