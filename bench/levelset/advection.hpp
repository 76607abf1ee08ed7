// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/measures.hpp>
#include <cambium/levelset/symmetric_difference.hpp>

#include "levelset/deformation.hpp"
#include "levelset/options.hpp"
#include "support/clock.hpp"

namespace bench {

/// Takes errors of bands in the deformation, whoever moved them, by one measure.
class DeformationErrors {
 public:
  using Band = cambium::NarrowBand<double, 3>;

  DeformationErrors(const std::string& family, const std::string& method, std::ptrdiff_t cells) {
    row_ = {{"family", family}, {"method", method}, {"cells", cells}};
  }
  void half(const Band& band) { row_["volume_half"] = volume_error(band); }
  void end(const Band& band) {
    row_["volume_end"] = volume_error(band);
    row_["distance"] =
        cambium::symmetric_difference(band, Deformation::distance, {}, cambium::Serial{}) / area / band.spacing();
  }
  void lost(const char* why) { row_["lost"] = why; }
  /// \param steps  calls or steps of the method, `work` what they were cut into
  void enter(Rows& rows, std::size_t steps, std::size_t work, double seconds) {
    row_["steps"] = steps;
    row_["work"] = work;
    row_["seconds"] = seconds;
    const auto number = [&](const char* key) { return row_.contains(key) ? row_[key].get<double>() : std::nan(""); };
    std::printf("%-32s %4td %5zu %5zu %9.3f%% %9.3f%% %8.3f h %9.3f s\n", row_["method"].get<std::string>().c_str(),
                row_["cells"].get<std::ptrdiff_t>(), steps, work, 100.0 * number("volume_half"),
                100.0 * number("volume_end"), number("distance"), seconds);
    std::fflush(stdout);
    rows.push_back(row_);
  }

 private:
  static constexpr double r = Deformation::radius;
  static constexpr double volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  static constexpr double area = 4.0 * std::numbers::pi * r * r;

  static double volume_error(const Band& band) {
    return cambium::measures(band, cambium::Serial{}).volume / volume - 1.0;
  }

  nlohmann::json row_;
};

inline cambium::Lattice<3> deformation_lattice(std::ptrdiff_t cells) {
  return cambium::Lattice<3>::bounded_box(cambium::Box<3>::cube(), cells);
}

/// Runs the deformation in `steps` calls of advection.step(); work(report) is what a call was cut into. A method that
/// loses the interface on the way has a row that says so.
template <class Reinit, class Advection, class Work>
void advect(const char* family, const std::string& name, std::ptrdiff_t cells, int steps, Advection advection,
            const typename cambium::LevelSet<Reinit, 3>::Params& params, Work&& work, const Options& options,
            Rows& rows) {
  if (name.find(options.only) == std::string::npos) return;
  cambium::LevelSet<Reinit, 3> level_set(deformation_lattice(cells), Deformation::distance, params, cambium::Serial{});
  DeformationErrors errors(family, name, cells);
  const double dt = Deformation::period / steps;
  double seconds = 0.0;
  std::size_t parts = 0;
  try {
    for (int n = 0; n < steps; ++n) {
      const double begin = cpu_seconds();
      parts += work(advection.step(level_set, Deformation::velocity, n * dt, dt, cambium::Serial{}));
      seconds += cpu_seconds() - begin;
      if (2 * (n + 1) == steps) errors.half(level_set.band());
    }
    errors.end(level_set.band());
  } catch (const cambium::InterfaceError& error) {
    errors.lost(error.what());
  }
  errors.enter(rows, static_cast<std::size_t>(steps), parts, seconds);
}

}  // namespace bench
