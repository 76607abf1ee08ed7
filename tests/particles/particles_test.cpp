// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE particles
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <cambium/particles/particles.hpp>

using namespace cambium;

namespace {

template <class F>
void refuses(F&& f, const std::string& part) {
  BOOST_CHECK_EXCEPTION(f(), AttributeError, [&](const Error& error) {
    BOOST_TEST_MESSAGE(error.what());
    return std::string(error.what()).find(part) != std::string::npos;
  });
}

/// Five particles at (p, 10 p) with mass p / 2 and velocity (p, -p, 0.5).
struct Five {
  Particles<2> particles{5};
  Attribute<float> mass = particles.add<float>("mass", 3.0f);
  Attribute<Vec<3>> velocity = particles.add<Vec<3>>("velocity", {7.0, 8.0, 9.0});

  Five() {
    for (std::size_t p = 0; p < 5; ++p) {
      const double u = static_cast<double>(p);
      particles.positions().set(p, {u, 10.0 * u});
      particles[mass][p] = static_cast<float>(0.5 * u);
      particles[velocity].set(p, {u, -u, 0.5});
    }
  }
  /// Particle `p` is the one that was made with number `made`.
  bool is(std::size_t p, double made) const {
    return particles.positions()[p] == Vec<2>{made, 10.0 * made} &&
           particles[mass][p] == static_cast<float>(0.5 * made) && particles[velocity][p] == Vec<3>{made, -made, 0.5};
  }
  bool is_initial(std::size_t p) const {
    return particles.positions()[p] == Vec<2>{} && particles[mass][p] == 3.0f &&
           particles[velocity][p] == Vec<3>{7.0, 8.0, 9.0};
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(attributes_are_found_by_name_and_type) {
  Five five;
  auto& particles = five.particles;
  BOOST_TEST(particles.has("mass"));
  BOOST_TEST(!particles.has("charge"));
  BOOST_TEST((particles.names() == std::vector<std::string>{"mass", "velocity"}));
  BOOST_TEST(particles.attribute<float>("mass").id == five.mass.id);
  BOOST_TEST(particles.attribute<Vec<3>>("velocity").id == five.velocity.id);
}

BOOST_AUTO_TEST_CASE(every_array_is_aligned_and_of_one_length) {
  Five five;
  int arrays = 0;
  for (const std::size_t count : {5, 1000, 3}) {
    five.particles.resize(count);
    five.particles.for_each_array([&](auto& array) {
      BOOST_TEST(array.size() == count);
      BOOST_TEST(reinterpret_cast<std::uintptr_t>(array.data()) % 64 == 0u);
      ++arrays;
    });
  }
  BOOST_TEST(arrays == 3 * (2 + 1 + 3));
}

BOOST_AUTO_TEST_CASE(resizing_keeps_data_and_fills_with_initial_values) {
  Five five;
  five.particles.resize(8);
  BOOST_TEST(five.particles.size() == 8u);
  for (std::size_t p = 0; p < 8; ++p) BOOST_TEST((p < 5 ? five.is(p, static_cast<double>(p)) : five.is_initial(p)));
  five.particles.resize(2);
  five.particles.resize(3);
  BOOST_TEST((five.is(0, 0) && five.is(1, 1) && five.is_initial(2)));
  five.particles.resize(0);
  BOOST_TEST(five.particles.empty());
  BOOST_TEST(five.particles.has("mass"));
}

BOOST_AUTO_TEST_CASE(appending) {
  Five five;
  BOOST_TEST(five.particles.append(2) == 5u);
  BOOST_TEST((five.is(4, 4) && five.is_initial(5) && five.is_initial(6)));

  // Attributes in another order are matched by name.
  Particles<2> other(1);
  const auto velocity = other.add<Vec<3>>("velocity");
  const auto mass = other.add<float>("mass");
  other.positions().set(0, {9.0, 90.0});
  other[velocity].set(0, {9.0, -9.0, 0.5});
  other[mass][0] = 4.5f;
  five.particles.append(other);
  BOOST_TEST(five.particles.size() == 8u);
  BOOST_TEST(five.is(7, 9));

  Five twice;
  twice.particles.append(twice.particles);
  BOOST_TEST(twice.particles.size() == 10u);
  for (std::size_t p = 0; p < 10; ++p) BOOST_TEST(twice.is(p, static_cast<double>(p % 5)));
}

BOOST_AUTO_TEST_CASE(keeping_some_preserves_their_order) {
  Five five;
  const auto odd_mass = [&](std::size_t p) { return static_cast<int>(2.0f * five.particles[five.mass][p]) % 2 == 1; };
  BOOST_TEST(five.particles.keep_if(odd_mass) == 3u);
  BOOST_TEST(five.particles.size() == 2u);
  BOOST_TEST((five.is(0, 1) && five.is(1, 3)));
  BOOST_TEST(five.particles.keep_if([](std::size_t) { return true; }) == 0u);
  BOOST_TEST((five.is(0, 1) && five.is(1, 3)));
  BOOST_TEST(five.particles.keep_if([](std::size_t) { return false; }) == 2u);
  BOOST_TEST(five.particles.empty());

  Five whole;
  BOOST_CHECK_THROW(
      whole.particles.keep_if([](std::size_t p) { return p == 4 ? throw std::runtime_error("") : false; }),
      std::runtime_error);
  for (std::size_t p = 0; p < 5; ++p) BOOST_TEST(whole.is(p, static_cast<double>(p)));
}

BOOST_AUTO_TEST_CASE(attribute_errors) {
  Five five;
  auto& particles = five.particles;
  refuses([&] { particles.add<double>("mass"); }, "particles have an attribute \"mass\" already: choose another name");
  refuses([&] { (void)particles.attribute<float>("charge"); }, "particles have no attribute \"charge\"");
  refuses([&] { (void)particles.attribute<double>("mass"); }, "attribute \"mass\" has 1 component(s) of another type");
  refuses([&] { (void)particles.attribute<Vec<2>>("velocity"); }, "attribute \"velocity\" has 3 component(s)");
  refuses([&] { (void)particles[Attribute<float>{2}]; }, "attribute handle belongs to other particles");
  refuses([&] { (void)particles[Attribute<double>{0}]; }, "attribute handle belongs to other particles");

  Particles<2> other(1);
  refuses([&] { particles.append(other); }, "particles to append have no attribute \"mass\" of 1 component(s)");
  other.add<double>("mass");
  other.add<Vec<3>>("velocity");
  refuses([&] { particles.append(other); }, "no attribute \"mass\" of 1 component(s) of the same type");
  Particles<2> more(1);
  more.add<float>("mass");
  more.add<Vec<3>>("velocity");
  more.add<float>("charge");
  refuses([&] { particles.append(more); }, "have an attribute \"charge\" that these have not");
  BOOST_TEST(particles.size() == 5u);
  for (std::size_t p = 0; p < 5; ++p) BOOST_TEST(five.is(p, static_cast<double>(p)));
}
