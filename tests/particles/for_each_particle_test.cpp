// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE for_each_particle
#include <boost/test/unit_test.hpp>

#include <cambium/particles/for_each_particle.hpp>

using namespace cambium;

BOOST_AUTO_TEST_CASE(every_particle_is_visited_once_with_its_position) {
  Particles<2, float> particles(5000);
  const auto visits = particles.add<double>("visits");
  for (std::size_t p = 0; p < particles.size(); ++p) particles.positions().set(p, {static_cast<float>(p), 0.5f});
  const auto visit = [&](std::size_t p, const Vec<2, float>& x) { particles[visits][p] += 1.0 + x[0]; };
  for_each_particle(particles, visit);
  for_each_particle(particles, visit, Serial{});
  for (int threads = 1; threads <= 3; ++threads) for_each_particle(particles, visit, OpenMP{threads});
  for (std::size_t p = 0; p < particles.size(); ++p)
    BOOST_TEST(particles[visits][p] == 5.0 * (1.0 + static_cast<double>(p)));
  for_each_particle(Particles<3>(), [](std::size_t, const Vec<3>&) { BOOST_TEST(false); });
}
