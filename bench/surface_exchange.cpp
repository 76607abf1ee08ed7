// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Strengths of particles on the unit sphere: errors of diffusion until t = 0.1 against cells, next to those of the band
// of second order, and of cos 3 theta on the unit circle against the width of the layer. The tables of docs/surface.md.
// Times are processor times of one thread, the level set and fit() included.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

#include "support/clock.hpp"
#include "support/surface/carrier.hpp"
#include "support/surface/exchange_modes.hpp"

namespace bench {
namespace {

using namespace cambium;

void compare(int l, std::ptrdiff_t cells) {
  const double start = cpu_seconds();
  const modes::Outcome particles = modes::decay<3, double>(l, cells);
  const double middle = cpu_seconds();
  motion::Carrier<2, 3> band{modes::unit_sphere<3>(cells)};
  const auto mode = [&](const Vec<3>& x) { return modes::harmonic<3>(l, x - modes::centre<3>()); };
  band.band.sample(mode, band.c);
  band.diffuse(0.1, Serial{});
  const double left = std::exp(-0.1 * modes::eigenvalue<3>(l));
  const double error = band.error([&](const Vec<3>& x) { return left * mode(x); }) / left;
  std::printf("l %d, %3td cells: particles %.1e (amplitude %.1e, total %.0e, area %.1e, %.2f s), band %.1e (%.2f s)\n",
              l, cells, particles.error, particles.amplitude, particles.total, particles.area, middle - start, error,
              cpu_seconds() - middle);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  bool quick = false;
  CLI::App app("Diffusion of strengths of particles on an interface");
  app.add_flag("--quick", quick, "small lattices: a test that the program runs");
  CLI11_PARSE(app, argc, argv);
  for (const int l : {1, 3}) {
    for (const std::ptrdiff_t cells :
         quick ? std::vector<std::ptrdiff_t>{24} : std::vector<std::ptrdiff_t>{24, 32, 48}) {
      bench::compare(l, cells);
    }
  }
  for (const double width : quick ? std::vector<double>{3.0} : std::vector<double>{2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    const double coarse = modes::decay<2, double>(3, 64, width).amplitude;
    std::printf("half width %g h: amplitude off by %.1e at 64 cells, %.1e at 128\n", width, coarse,
                modes::decay<2, double>(3, quick ? 64 : 128, width).amplitude);
  }
}
