// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE jump_data
#include <boost/test/unit_test.hpp>
#include <cstring>

#include "interface/jump_scenes.hpp"

using namespace cambium;
using namespace scenes;

namespace {

/// True if two sparse fields of one band have the same bits.
template <class V, int D>
bool same_bits(const Field<V, D, Sparse>& a, const Field<V, D, Sparse>& b) {
  bool same = a.blocks() == b.blocks();
  for (std::size_t k = 0; same && k < a.blocks(); ++k) {
    same = std::memcmp(a.block(k).data(), b.block(k).data(), a.block(k).size_bytes()) == 0;
  }
  return same;
}

}  // namespace

BOOST_AUTO_TEST_CASE(fields_do_as_functions) {
  const auto level_set = level_set_of<2>(Ellipse{}, 48);
  const auto& band = level_set.band();
  const auto& points = level_set.method().points();
  const auto a = [](const Vec<2>& x) { return std::sin(5.0 * x[0]) + x[1]; };
  Field<double, 2, Sparse> field(level_set.lattice());
  take_blocks(field, band);
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      const Vec<2> x = level_set.lattice().position(band.values().node(b, i));
      if (points.found(b, i)) field.block(b)[i] = a(x + points.offset(b, i) * level_set.spacing());
    }
  }
  Jump<2> by_function(level_set.lattice()), by_field(level_set.lattice());
  by_function.attach(band, points);
  by_function.set(a, a, a);
  by_field.attach(band, points);
  by_field.set(field, field, field);
  double worst = 0.0;
  for (std::size_t b = 0; b < band.blocks(); ++b) {
    for (std::size_t i = 0; i < band.volume; ++i) {
      worst = std::max(worst, std::abs(by_function.extension().block(b)[i] - by_field.extension().block(b)[i]));
    }
  }
  BOOST_TEST(worst < 1e-14);  // the positions of points are computed in another order
}

BOOST_AUTO_TEST_CASE(threads_change_nothing) {
  const auto level_set = level_set_of<2>(Ellipse{}, 96);
  const auto a = [](const Vec<2>& x) { return x[0] * x[1]; };
  const auto run = [&](int threads, Field<double, 2>& f, Field<Vec<2>, 2>& g, InterfaceSides<2>& sides) {
    Jump<2> jump(level_set.lattice());
    jump.attach(level_set.band(), OpenMP{threads});
    jump.set(a, a, a, OpenMP{threads});
    jump.correct(f, OpenMP{threads});
    jump.gradient(f, g, OpenMP{threads});
    jump.at_interface(f, sides, OpenMP{threads});
  };
  Field<double, 2> f(level_set.lattice());
  Field<Vec<2>, 2> g(level_set.lattice());
  InterfaceSides<2> sides(level_set.lattice());
  run(1, f, g, sides);
  for (const int threads : {2, 3}) {
    Field<double, 2> other(level_set.lattice());
    Field<Vec<2>, 2> other_g(level_set.lattice());
    InterfaceSides<2> other_sides(level_set.lattice());
    run(threads, other, other_g, other_sides);
    BOOST_TEST(std::memcmp(f.data(), other.data(), f.values().size_bytes()) == 0);
    BOOST_TEST(std::memcmp(g.data(), other_g.data(), g.values().size_bytes()) == 0);
    BOOST_TEST(same_bits(sides.inside, other_sides.inside));
    BOOST_TEST(same_bits(sides.gradient_outside, other_sides.gradient_outside));
  }
}

BOOST_AUTO_TEST_CASE(single_precision_solves) {
  const auto lattice = Lattice<2>::periodic_box(Box<2>::cube(), 64);
  const LevelSet<ClosestPoint, 2, float> level_set(lattice, Ball<2>({0.5, 0.5}, 0.3));
  Jump<2, float> jump(lattice);
  jump.attach(level_set.band());
  jump.set([](const Vec<2>& x) { return std::sin(3.0 * x[0]); });
  InterfaceSides<2, float> sides(lattice);
  Field<float, 2> f(lattice), p(lattice);
  jump.correct(f);
  PeriodicPoisson<2, SecondOrder, float>(lattice, {.mean = MeanPart::subtract}).solve(f, p);
  jump.at_interface(p, sides);
  const auto& points = level_set.method().points();
  float worst = 0.0F;
  for (std::size_t b = 0; b < level_set.band().blocks(); ++b) {
    for (std::size_t i = 0; i < level_set.band().volume; ++i) {
      if (!points.found(b, i) || norm(points.offset(b, i)) > 2.0F) continue;
      const double x = lattice.position(level_set.band().values().node(b, i))[0] +
                       static_cast<double>(points.offset(b, i)[0]) * lattice.spacing();
      const float jump_found = sides.outside.block(b)[i] - sides.inside.block(b)[i];
      worst = std::max(worst, std::abs(jump_found - static_cast<float>(std::sin(3.0 * x))));
    }
  }
  BOOST_TEST(worst < 1e-5F);
}
