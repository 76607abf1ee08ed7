// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

namespace bench {

/// What a verification of the tumour is to be run with.
struct TumourOptions {
  std::vector<std::ptrdiff_t> cells;  ///< along an axis; those of the verification if none
  int threads = 1;
  double end = 0.0;      ///< time to run to; that of the verification if 0
  double tension = 0.0;  ///< gamma; that of the verification if 0
  int dimension = 0;     ///< 2 or 3 alone; both if 0
  bool smoke = false;    ///< as little as shows that it works

  std::vector<std::ptrdiff_t> cells_or(std::vector<std::ptrdiff_t> usual) const {
    return cells.empty() ? usual : cells;
  }
  double end_or(double usual) const { return end > 0.0 ? end : usual; }
  double tension_or(double usual) const { return tension > 0.0 ? tension : usual; }
};

// Each gives a list of runs, and prints a line for each of them.

/// The integral equations along the interface against the radial equation, linear stability and themselves.
nlohmann::json verify_reference(const TumourOptions& options);
/// (11.72) in the plane, straight and turned by 30 degrees, against the integral equations.
nlohmann::json verify_ellipse(const TumourOptions& options);
/// Rates of growth of waves on balls, and of their decay without growth.
nlohmann::json verify_rates(const TumourOptions& options);
/// Mean error of the speed of balls, of growth alone and of surface tension alone.
nlohmann::json verify_speed(const TumourOptions& options);
/// R(t) of discs and balls, with and without a core.
nlohmann::json verify_radius(const TumourOptions& options);
/// Surface tension alone: a ball at rest, and a wave of l = 2 that decays.
nlohmann::json verify_relaxation(const TumourOptions& options);
/// Boxes of 24 and 48 with one spacing.
nlohmann::json verify_box(const TumourOptions& options);
/// One tumour in space on lattices that are finer and finer: how far its interfaces are apart.
nlohmann::json verify_convergence(const TumourOptions& options);
/// Error against time of the compositions.
nlohmann::json compare_compositions(const TumourOptions& options);
/// What a step in space costs, part by part, in pairs of transforms of the doubled box, and the memory of a tumour.
nlohmann::json measure_cost(const TumourOptions& options);

}  // namespace bench
