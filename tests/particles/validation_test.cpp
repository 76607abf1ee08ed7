// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE validation
#include <boost/test/unit_test.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <cambium/particles/particles.hpp>
#include <cambium/particles/validation.hpp>

using namespace cambium;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class E, class F>
void refuses(F&& f, const std::string& part) {
  BOOST_CHECK_EXCEPTION(f(), E, [&](const Error& error) {
    BOOST_TEST_MESSAGE(error.what());
    return std::string(error.what()).find(part) != std::string::npos;
  });
}

}  // namespace

BOOST_AUTO_TEST_CASE(positions) {
  const Domain<2> domain{{{0.0, 0.0}, {1.0, 1.0}}, {false, true}};
  require_position(domain, Vec<2>{0.0, 57.0}, 0);  // faces belong to the box; periodic axes have no outside
  require_position(domain, Vec<2>{1.0, -3.0}, 0);
  refuses<PositionError>(
      [&] {
        require_position(domain, Vec<2>{1.0 + 1e-15, 0.0}, 12);
      },
      "particle 12 at (1.0000000000000011, 0)");
  refuses<PositionError>(
      [&] {
        require_position(domain, Vec<2>{-1e-300, 0.0}, 12);
      },
      "outside the bounded box (0, 0) to (1, 1) along axis 0: enlarge");
  refuses<PositionError>(
      [&] {
        require_position(domain, Vec<2>{0.5, nan_value}, 3);
      },
      "particle 3 has position (0.5, nan): component 1 is not finite; check");
  refuses<PositionError>(
      [&] {
        require_position(domain, Vec<2, float>{0.5f, std::numeric_limits<float>::infinity()}, 3);
      },
      "(0.5, inf)");

  Particles<2> particles(5000);
  require_positions(domain, std::as_const(particles).positions());
  particles.positions().set(4500, {2.0, 0.0});
  particles.positions().set(1500, {3.0, 0.0});
  for (int threads = 1; threads <= 3; ++threads) {
    refuses<PositionError>([&] { require_positions(domain, std::as_const(particles).positions(), OpenMP{threads}); },
                           "particle 1500 at (3, 0)");
  }
}

BOOST_AUTO_TEST_CASE(values) {
  std::vector<float> volumes(3000, 1.0f);
  const std::span<const float> view(volumes);
  require_finite(view, "volume");
  volumes[2100] = std::numeric_limits<float>::infinity();
  volumes[40] = -volumes[2100];
  for (int threads = 1; threads <= 3; ++threads) {
    refuses<ValueError>([&] { require_finite(view, "volume", OpenMP{threads}); },
                        "volume of particle 40 is -inf: it must be finite");
  }
  Particles<2> particles(3);
  const auto velocity = particles.add<Vec<3>>("velocity");
  particles[velocity].set(1, {0.0, 0.0, nan_value});
  refuses<ValueError>([&] { require_finite(std::as_const(particles)[velocity], "velocity"); },
                      "velocity of particle 1 is nan in component 2:");
}

BOOST_AUTO_TEST_CASE(extents) {
  require_extent(Domain<3>::bounded_box(Box<3>::cube()));
  refuses<LatticeError>(
      [] {
        require_extent(Domain<2>::bounded_box({{0.0, 1.0}, {1.0, 1.0}}));
      },
      "box has extent 0 along axis 1 (from 1 to 1)");
  refuses<LatticeError>(
      [] {
        require_extent(Domain<1>::bounded_box({{0.0}, {infinity}}));
      },
      "box has extent inf along axis 0");
  refuses<LatticeError>(
      [] {
        require_extent(Domain<1>::bounded_box({{nan_value}, {1.0}}));
      },
      "box has extent nan along axis 0");
}
