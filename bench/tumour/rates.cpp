// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tumour/grow.hpp"
#include "tumour/verification.hpp"
#include "tumour/wave.hpp"

namespace bench {
namespace {

using nlohmann::json;
using namespace cambium;

/// Linear stability, R = 2, A = 0.5, gamma = 1: of l = 2, 3, ... with G = 20; the part of the surface tension is what
/// there is with G = 0.
struct Exact {
  double with_growth[5];
  double tension[5];
};
template <int D, bool FreeSpaceOutside>
constexpr Exact exact() {
  if constexpr (D == 2 && FreeSpaceOutside) {
    return {{0.492599428618, -0.141614086840, -2.07927492585, -5.61411627449, -11.0823123195},
            {-0.375, -1.5, -3.75, -7.5, -13.125}};
  } else if constexpr (D == 2) {
    return {{-0.992547722405, -4.23872133296, -10.0917895906, -19.1392188675, -32.0533575372},
            {-0.75, -3.0, -7.5, -15.0, -26.25}};
  } else if constexpr (FreeSpaceOutside) {
    return {{-0.415788189990, -1.82117419999, -4.58058871011, -9.05446853982, -15.6086139789},
            {-0.6, -15.0 / 7.0, -5.0, -105.0 / 11.0, -210.0 / 13.0}};
  } else {
    return {{-2.05285623261, -6.24677566090, -13.1406129757, -23.3992385695, -37.7294854206},
            {-1.0, -3.75, -9.0, -17.5, -30.0}};
  }
}

/// What the speed has of a wave, by least squares next to the interface.
template <class T>
double share_of_wave(std::ptrdiff_t cells, int l, double delta, double growth, int threads) {
  constexpr int D = T::dimension;
  const Wave<D> wave{l};
  const T tumour(
      tumour_box<D>(cells, 6.0), [&](const Vec<D>& x) { return wave.shape(x, delta); },
      {.parameters = {.growth = growth}}, OpenMP{threads});
  const auto& band = tumour.level_set().band();
  WaveFit fit;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      if (std::abs(band.values().block(b)[i]) > band.spacing()) continue;
      fit.add(wave(band.lattice().position(band.values().node(b, i))), tumour.speed().block(b)[i]);
    }
  }
  return fit.part();
}

/// Rate of a wave, exact to O(delta^4): from waves of two heights. Lower ones, of a fraction of a spacing, are lost in
/// what the interface itself is off by.
template <class T>
json rate(const char* outside, std::ptrdiff_t cells, int l, bool grows, const Exact& exact, int threads) {
  constexpr double delta = 0.05;
  const double start = wall_seconds();
  const auto at = [&](double height) {
    const double growth = grows ? 20.0 : 0.0;
    return (share_of_wave<T>(cells, l, height, growth, threads) -
            share_of_wave<T>(cells, l, -height, growth, threads)) /
           (2.0 * height);
  };
  const double found = (4.0 * at(delta) - at(2.0 * delta)) / 3.0;
  const double tension = exact.tension[l - 2], right = grows ? exact.with_growth[l - 2] : tension;
  const double error = (found - right) / std::max(std::abs(right), std::abs(tension));
  std::printf("rate    %dD %-11s G = %2d  %4td cells  l = %d  %9.4f (%9.4f), off by %6.2f%%  %.1f s\n", T::dimension,
              outside, grows ? 20 : 0, cells, l, found, right, 100.0 * error, wall_seconds() - start);
  std::fflush(stdout);
  return {{"scene", "rate"},    {"dimension", T::dimension},
          {"outside", outside}, {"cells", cells},
          {"grows", grows},     {"l", l},
          {"found", found},     {"exact", right},
          {"error", error}};
}

template <int D>
void add_rates(json& runs, std::ptrdiff_t cells, const TumourOptions& options) {
  for (int l = 2; l <= (D == 2 ? 6 : 5); ++l) {
    runs.push_back(rate<Tumour<D, SemiImplicit>>("FreeSpace", cells, l, true, exact<D, true>(), options.threads));
    runs.push_back(
        rate<Tumour<D, SemiImplicit, ZeroOutside>>("ZeroOutside", cells, l, true, exact<D, false>(), options.threads));
  }
  runs.push_back(rate<Tumour<D, SemiImplicit>>("FreeSpace", cells, 2, false, exact<D, true>(), options.threads));
}

}  // namespace

json verify_rates(const TumourOptions& options) {
  json runs = json::array();
  for (const auto n : options.cells_or({64, 128, 192})) {
    if (options.dimension != 3) add_rates<2>(runs, n, options);
  }
  for (const auto n : options.cells_or({32, 48, 64})) {
    if (options.dimension != 2) add_rates<3>(runs, n, options);
  }
  return runs;
}

}  // namespace bench
