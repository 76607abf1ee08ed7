// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE field
#include <boost/test/unit_test.hpp>
#include <cstdint>
#include <tuple>
#include <utility>

#include <cambium/core/field.hpp>

using namespace cambium;

namespace {

template <int D, class T>
struct Case {
  static constexpr int dimension = D;
  using Value = T;
};
using Cases = std::tuple<Case<1, double>, Case<2, float>, Case<3, double>, Case<2, Vec<3>>, Case<3, Vec<2, float>>>;

template <class V>
V value_at(double x) {
  V value{};
  for (int c = 0; c < Components<V>::count; ++c) component(value, c) = static_cast<ScalarOf<V>>(x + c);
  return value;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(nodes_hold_what_was_sampled, C, Cases) {
  constexpr int D = C::dimension;
  using V = typename C::Value;
  const auto lattice = Lattice<D>::bounded_box(Box<D>::cube(), 8);
  const auto f = [](const Vec<D>& x) { return value_at<V>(dot(x, Vec<D>::constant(1.0))); };
  const auto field = sample(lattice, f);
  static_assert(std::is_same_v<decltype(field), const Field<V, D>>);
  BOOST_TEST(field.size() == lattice.size());
  BOOST_TEST((field.lattice() == lattice));
  BOOST_TEST(reinterpret_cast<std::uintptr_t>(field.data()) % 64 == 0u);
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Index<D> node = lattice.node(i);
    BOOST_TEST((field(node) == f(lattice.position(node))));
    BOOST_TEST(&field(node) == &field[i]);
    BOOST_TEST(&field[i] == &field.values()[i]);
  }
}

BOOST_AUTO_TEST_CASE(writing_and_filling) {
  Field<double, 2> field(Lattice<2>::periodic_box(Box<2>::cube(), 4), 3.0);
  for (const double q : field.values()) BOOST_TEST(q == 3.0);
  field({1, 2}) = 5.0;
  BOOST_TEST(field[9] == 5.0);
  field[9] = 6.0;
  BOOST_TEST(std::as_const(field)({1, 2}) == 6.0);
  field.fill(-1.0);
  for (const double q : field.values()) BOOST_TEST(q == -1.0);
}
