// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>

#include "tumour/boundary_integral.hpp"
#include "tumour/curve_distance.hpp"
#include "tumour/grow.hpp"
#include "tumour/verification.hpp"

namespace bench {
namespace {

using cambium::Vec;
using nlohmann::json;

Vec<2> turned(const Vec<2>& x, double angle) {
  return {std::cos(angle) * x[0] - std::sin(angle) * x[1], std::sin(angle) * x[0] + std::cos(angle) * x[1]};
}

struct Truth {
  Polygon curve;
  double area;
};
using Cells = std::vector<std::ptrdiff_t>;

/// The interface at a time, by many points.
Truth truth(bool free_space, double end, const TumourOptions& options) {
  const BoundaryIntegral solver(options.smoke ? 32 : 64,
                                {.tension = options.tension_or(1.0), .free_space = free_space});
  const auto start = equidistant(solver.grid(), elliptic);
  const auto curve = solver.run(start, end, solver.stable_steps(start, end));
  Truth result{{}, curve.area};
  constexpr int points = 2000;
  for (int k = 0; k < points; ++k) {
    const double alpha = 2.0 * std::numbers::pi * k / points;
    result.curve.push_back({solver.grid().at(curve.x, alpha), solver.grid().at(curve.y, alpha)});
  }
  return result;
}

template <class T>
json run(const char* outside, std::ptrdiff_t cells, double angle, const Truth& truth, double end,
         const TumourOptions& options) {
  T tumour(
      tumour_box<2>(cells, 6.0),
      [angle](const Vec<2>& x) {
        const Vec<2> y = turned(x, -angle);
        return std::hypot(1.1 * y[0], 0.9 * y[1]) - 2.0;
      },
      {.parameters = {.tension = options.tension_or(1.0)}}, cambium::OpenMP{options.threads});
  json result = grow(tumour, end);
  auto curves = interface_of(tumour.level_set().band());
  for (auto& curve : curves) {
    for (auto& x : curve) x = turned(x, -angle);
  }
  const double distance = hausdorff(curves, {truth.curve});
  const double area = result["volume"].get<double>() / truth.area - 1.0;
  const int degrees = static_cast<int>(std::lround(angle * 180.0 / std::numbers::pi));
  result.update(
      {{"scene", "ellipse"}, {"outside", outside}, {"degrees", degrees}, {"distance", distance}, {"area_error", area}});
  std::printf(
      "ellipse %-11s turned by %2d  %4td cells  t = %.3f  Hausdorff distance %.5f (%5.3f h)  area off by %9.2e  "
      "%4d steps %5d products %7.1f s\n",
      outside, degrees, cells, tumour.time(), distance, distance / tumour.lattice().spacing(), area,
      result["steps"].get<int>(), result["iterations"].get<int>(), result["seconds"].get<double>());
  std::fflush(stdout);
  if (options.smoke && !(distance < 0.1 * tumour.lattice().spacing())) {
    throw std::runtime_error("the ellipse is off by more than a tenth of a spacing");
  }
  return result;
}

}  // namespace

json verify_ellipse(const TumourOptions& options) {
  using cambium::SemiImplicit;
  const double end = options.end_or(options.smoke ? 0.03 : 1.0);
  json runs = json::array();
  const Truth free_space = truth(true, end, options);
  for (const auto n : options.cells_or(options.smoke ? Cells{48} : Cells{64, 128})) {
    runs.push_back(run<cambium::Tumour<2, SemiImplicit>>("FreeSpace", n, 0.0, free_space, end, options));
  }
#if !BENCH_SMOKE
  using Zero = cambium::Tumour<2, SemiImplicit, cambium::ZeroOutside>;
  constexpr double angle = std::numbers::pi / 6.0;
  const Truth zero = truth(false, end, options);
  for (const auto n : options.cells_or({64, 128})) {
    runs.push_back(run<cambium::Tumour<2, SemiImplicit>>("FreeSpace", n, angle, free_space, end, options));
    runs.push_back(run<Zero>("ZeroOutside", n, 0.0, zero, end, options));
    runs.push_back(run<Zero>("ZeroOutside", n, angle, zero, end, options));
  }
#endif
  return runs;
}

}  // namespace bench
