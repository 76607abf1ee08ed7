// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include <cambium/levelset/advection/cutoff.hpp>
#include <cambium/levelset/level_set.hpp>
#include <cambium/models/tumour/policy.hpp>

namespace cambium {

/// Moves the interface by the speed at nodes: phi := phi - dt V, then the distance to its zero set. The default.
///
/// V is extended along normals, so that grad V . grad phi = 0 and phi stays a distance to O(dt^2) while it moves:
/// particles along normals need neither stencils nor a remeshing. The source's mollifier chi (11.69) takes V to zero
/// between two distances from the interface; it is not needed for this motion and left out as long as they are
/// infinite.
struct AlongNormals {
  using Kind = tumour_kind::Motion;

  struct Params {
    double inner = std::numeric_limits<double>::infinity();  ///< beta of (11.69), in spacings
    double outer = std::numeric_limits<double>::infinity();  ///< gamma of (11.69), in spacings
  };

  template <int D>
  class Method {
   public:
    explicit Method(const Lattice<D>&, const Params& params) : params_(params) {}

    /// \param speed  NaN at nodes that have none. \throws InterfaceError if the interface vanishes or comes too near to
    ///               a bounded face; the level set is then unchanged, or as moved but not a distance
    template <class L>
    void operator()(L& level_set, const Field<double, D, Sparse>& speed, double, double dt, const OpenMP& execution) {
      const auto& old = level_set.band();
      const double h = old.spacing();
      const Cutoff<double> chi{params_.inner * h, params_.outer * h};
      level_set.replace(
          [&](auto& marks) {
            for (std::size_t b = 0; b < old.blocks(); ++b) {
              marks.mark(old.values().block_origin(b), old.values().block_origin(b));
            }
          },
          [&](auto& band, std::size_t b, std::size_t) {
            const auto from = static_cast<std::size_t>(old.values().find(band.values().block_index(b)));
            const auto phi = old.values().block(from);
            const auto to = band.values().block(b);
            for (std::size_t i = 0; i < phi.size(); ++i) {
              const double v = speed.block(from)[i];
              to[i] = std::isnan(v) ? phi[i] : phi[i] - dt * chi(phi[i]) * v;
            }
            return true;
          },
          execution);
      level_set.reinitialise(execution);
    }

   private:
    Params params_;
  };
};

}  // namespace cambium
