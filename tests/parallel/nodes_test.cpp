// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE nodes
#include <boost/test/unit_test.hpp>
#include <tuple>
#include <vector>

#include <cambium/parallel/nodes.hpp>

using namespace cambium;

namespace {

template <int D, class S>
struct Case {
  static constexpr int dimension = D;
  using Storage = S;
};
using Cases =
    std::tuple<Case<1, Dense>, Case<2, Dense>, Case<3, Dense>, Case<1, Sparse>, Case<2, Sparse>, Case<3, Sparse>>;

/// 151 nodes in 1D, 38 x 38 in 2D, 21^3 in 3D: blocks stick out of the lattice.
template <int D>
Lattice<D> lattice_of() {
  return Lattice<D>::bounded_box(Box<D>::cube(), D == 1 ? 150 : D == 2 ? 37 : 20);
}

/// A field with all, or a few, nodes in memory.
template <int D, class Storage>
Field<double, D, Storage> field_of() {
  Field<double, D, Storage> field(lattice_of<D>(), -1.0);
  if constexpr (std::is_same_v<Storage, Sparse>) {
    field.activate(field.block_grid() - Index<D>::constant(1));  // the corner block sticks out along every axis
    field.activate({});
  }
  return field;
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(every_node_in_memory_is_visited_once, C, Cases) {
  constexpr int D = C::dimension;
  const auto visit_all = [](const auto& execution) {
    auto field = field_of<D, typename C::Storage>();
    const Lattice<D> lattice = field.lattice();
    std::vector<int> visits(lattice.size(), 0);
    for_each_node(
        field,
        [&](const Index<D>& node, double& value) {
          if (!lattice.contains(node)) return;  // seen by padding_is_left_alone
          ++visits[lattice.number(node)];
          value = static_cast<double>(lattice.number(node));
        },
        execution);
    for (std::size_t i = 0; i < lattice.size(); ++i) {
      const Index<D> node = lattice.node(i);
      bool stored = true;
      if constexpr (std::is_same_v<typename C::Storage, Sparse>) stored = field.find(field.block_of(node)) >= 0;
      BOOST_TEST(visits[i] == (stored ? 1 : 0));
      BOOST_TEST(field(node) == (stored ? static_cast<double>(i) : -1.0));
    }
  };
  visit_all(Serial{});
  for (int threads = 1; threads <= 4; ++threads) visit_all(OpenMP{threads});
}

BOOST_AUTO_TEST_CASE(padding_is_left_alone) {
  auto field = field_of<2, Sparse>();
  for_each_node(field, [](const Index<2>&, double& value) { value = 1.0; });
  const auto corner = field.block(0);
  for (std::size_t k = 0; k < corner.size(); ++k) {
    BOOST_TEST(corner[k] == (field.lattice().contains(field.node(0, k)) ? 1.0 : -1.0));
  }
}

BOOST_AUTO_TEST_CASE(every_block_is_visited_once) {
  auto field = field_of<3, Sparse>();
  for (int threads = 1; threads <= 4; ++threads) {
    std::vector<int> visits(field.blocks(), 0);
    for_each_block(
        field, [&](std::size_t b) { ++visits[b]; }, OpenMP{threads});
    BOOST_TEST((visits == std::vector<int>(2, 1)));
  }
}
