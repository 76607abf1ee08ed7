// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/interface/cell_geometry.hpp>
#include <cambium/interface/finite_volumes.hpp>
#include <cambium/multigrid/krylov.hpp>

namespace cambium {

/// Fluxes in the middle of whole faces: symmetric equations, and conjugate gradients. The error of a flux at a cut
/// face, O(h) there, leaves O(h^2 log h) in the solution (Ng, Min & Gibou 2009, J. Comput. Phys. 228).
struct FaceCentre {
  using Krylov = ConjugateGradient;

  template <int D>
  class Method {
   public:
    explicit Method(const std::vector<detail::CutFace<D>>&, const detail::FiniteVolumes<double, D>&) {}
    void add(const detail::FiniteVolumes<double, D>&, const double*, double*) const {}
  };
};

/// Fluxes in the middle of the open part of faces, interpolated between those of whole faces beside (Johansen & Colella
/// 1998, J. Comput. Phys. 147; in 3D Schwartz et al. 2006, J. Comput. Phys. 211): second order, not symmetric.
struct FaceCentroid {
  using Krylov = BiCGStab;

  template <int D>
  class Method {
   public:
    Method(const std::vector<detail::CutFace<D>>& faces, const detail::FiniteVolumes<double, D>& cells) {
      for (const auto& face : faces) {
        if (face.open > 0.0 && face.open < 1.0) add_face(face, cells);
      }
    }
    /// out -= what interpolation changes in the fluxes into the cells.
    void add(const detail::FiniteVolumes<double, D>& cells, const double* x, double* out) const {
      for (const Face& face : faces_) {
        const auto step = static_cast<std::size_t>(cells.grid.stride[face.axis]);
        double flux = 0.0;
        for (std::size_t k = 0; k < points; ++k) {
          if (face.weight[k] != 0.0) flux += face.weight[k] * (x[face.from[k] + step] - x[face.from[k]]);
        }
        out[face.low] -= flux;
        out[face.high] += flux;
      }
    }

   private:
    static constexpr std::size_t points = 1 << (D - 1);
    struct Face {
      std::size_t low, high;  ///< entries of the cells on both sides, in the lattice
      int axis;
      std::array<std::size_t, points> from{};
      std::array<double, points> weight{};  ///< 0 where a point is not used
    };

    /// The (bi)linear weights of the faces beside, less the face itself; an axis on which a cell is missing is left
    /// out.
    void add_face(const detail::CutFace<D>& cut, const detail::FiniteVolumes<double, D>& cells) {
      const auto& grid = cells.grid;
      Face face{grid.at(cut.node), 0, cut.axis, {}, {}};
      Index<D> next = cut.node + Index<D>::unit(cut.axis);
      if (next[cut.axis] == grid.nodes[cut.axis]) next[cut.axis] = 0;
      face.high = grid.at(next);
      std::array<double, D - 1> aside{};
      std::array<std::ptrdiff_t, D - 1> step{};
      for (int d = 0, e = 0; d < D; ++d) {
        if (d == cut.axis) continue;
        aside[e] = std::abs(cut.aside[d]);
        step[e++] = cut.aside[d] < 0.0 ? -grid.stride[d] : grid.stride[d];
      }
      const auto open = [&](std::ptrdiff_t by) {
        const auto low = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(face.low) + by);
        return cells.inverse[low] > 0.0 && cells.inverse[low + static_cast<std::size_t>(grid.stride[cut.axis])] > 0.0;
      };
      for (std::size_t e = 0; e < D - 1; ++e) {
        if (!open(step[e])) aside[e] = 0.0;
      }
      if constexpr (D == 3) {
        if (aside[0] > 0.0 && aside[1] > 0.0 && !open(step[0] + step[1])) {
          (aside[0] < aside[1] ? aside[0] : aside[1]) = 0.0;
        }
      }
      for (std::size_t k = 0; k < points; ++k) {
        double weight = cut.open;
        std::ptrdiff_t by = 0;
        for (std::size_t e = 0; e < D - 1; ++e) {
          const bool beside = k >> e & 1;
          weight *= beside ? aside[e] : 1.0 - aside[e];
          if (beside) by += step[e];
        }
        face.from[k] = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(face.low) + by);
        face.weight[k] = k == 0 ? weight - cut.open : weight;
      }
      faces_.push_back(face);
    }

    std::vector<Face> faces_;
  };
};

}  // namespace cambium
