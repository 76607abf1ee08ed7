// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <numbers>

#include <cambium/levelset/shapes/ball.hpp>

#include "tumour/grow.hpp"
#include "tumour/verification.hpp"

namespace bench {
namespace {

using nlohmann::json;
using namespace cambium;

/// R(1) from R(0) = 2, A = 0.5, G = 20, G_N = 1, by quadrature; a core where c < 0.5.
template <int D, class Core>
constexpr double exact = D == 2 ? 3.29084034377 : 4.40602799291;
template <>
constexpr double exact<2, Necrosis> = 2.09464002754;
template <>
constexpr double exact<3, Necrosis> = 2.88666894737;

/// In a box of 15, which has room for the largest. The ball's middle is a node: what the lattice does to it are waves
/// of l = 4 and more. Those of l = 2 and 3 of a disc with a core grow at 3.99 and 3.68 (p = 0 outside; 1.99 and 1.84 in
/// free space) by linear stability, by 50 times until t = 1: of a disc elsewhere nothing would remain that R(t) says.
template <int D, class Outside, class Core>
json run(const char* outside, const char* core, std::ptrdiff_t cells, const TumourOptions& options) {
  using T = Tumour<D, SemiImplicit, Outside, Core>;
  T tumour(tumour_box<D>(cells, 7.5), Ball<D>(Vec<D>{}, 2.0), {.parameters = {.tension = options.tension_or(1.0)}},
           OpenMP{options.threads});
  json result = grow(tumour, 1.0);
  const auto volume = result["volume"].template get<double>();
  const double radius = D == 2 ? std::sqrt(volume / std::numbers::pi) : std::cbrt(0.75 * volume / std::numbers::pi);
  const double error = radius / exact<D, Core> - 1.0;
  result.update({{"scene", "radius"}, {"dimension", D}, {"outside", outside}, {"core", core}, {"error", error}});
  std::printf("radius  %dD %-11s %-10s h = %.4f  R(%.3f) = %.6f, off by %9.2e  %4d steps %5d products %7.1f s%s\n", D,
              outside, core, tumour.lattice().spacing(), tumour.time(), radius, error,
              result["steps"].template get<int>(), result["iterations"].template get<int>(),
              result["seconds"].template get<double>(), result.contains("stopped") ? "  STOPPED" : "");
  std::fflush(stdout);
  return result;
}

template <int D>
void add(json& runs, std::ptrdiff_t cells, const TumourOptions& options) {
  runs.push_back(run<D, FreeSpace, NoNecrosis>("FreeSpace", "", cells, options));
  runs.push_back(run<D, ZeroOutside, NoNecrosis>("ZeroOutside", "", cells, options));
  runs.push_back(run<D, FreeSpace, Necrosis>("FreeSpace", "N = 0.5", cells, options));
  runs.push_back(run<D, ZeroOutside, Necrosis>("ZeroOutside", "N = 0.5", cells, options));
}

}  // namespace

json verify_radius(const TumourOptions& options) {
  json runs = json::array();
  for (const auto n : options.cells_or({40, 80})) {
    if (options.dimension != 3) add<2>(runs, n, options);
    if (options.dimension != 2) add<3>(runs, n, options);
  }
  return runs;
}

}  // namespace bench
