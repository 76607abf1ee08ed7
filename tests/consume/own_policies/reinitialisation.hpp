// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/reinitialisation.hpp>

/// Brings a multiple of a distance back to the distance, by its steepest slope along an axis: Reinitialisation.
struct Rescaled {
  struct Params {
    double least_slope = 1e-3;  ///< flatter functions are left as they are
  };
  template <class T, int D>
  class Method {
   public:
    explicit Method(const Params& params) : params_(params) {}

    template <cambium::Execution E>
    cambium::ReinitReport operator()(cambium::NarrowBand<T, D>& band, const E&) {
      const T slope = steepest(band);
      if (!(slope > params_.least_slope)) return {};
      const T edge = static_cast<T>(band.half_width());
      for (std::size_t b = 0; b < band.blocks(); ++b) {
        for (T& phi : band.values().block(b)) phi = std::clamp(phi / slope, -edge, edge);
      }
      return {};
    }

   private:
    /// Along axis 0, within the rows of the blocks, where the interface passes between two nodes.
    static T steepest(cambium::NarrowBand<T, D>& band) {
      constexpr auto row = static_cast<std::size_t>(cambium::NarrowBand<T, D>::extent);
      T largest{};
      for (std::size_t b = 0; b < band.blocks(); ++b) {
        const auto phi = band.values().block(b);
        for (std::size_t i = 1; i < phi.size(); ++i) {
          if (i % row == 0 || (phi[i] < T(0)) == (phi[i - 1] < T(0))) continue;
          largest = std::max(largest, std::abs(phi[i] - phi[i - 1]));
        }
      }
      return largest / static_cast<T>(band.spacing());
    }

    Params params_;
  };
};
