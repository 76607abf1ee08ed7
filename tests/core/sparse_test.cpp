// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE sparse
#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <cambium/core/sparse.hpp>

using namespace cambium;

namespace {

template <int D>
struct Dim {
  static constexpr int dimension = D;
};
using Dims = std::tuple<Dim<1>, Dim<2>, Dim<3>>;

/// Nodes along the axes are no multiples of the block: the last blocks stick out.
template <int D>
Lattice<D> ragged() {
  Box<D> box;
  std::array<bool, D> periodic{};
  for (int d = 0; d < D; ++d) {
    box.hi[d] = (D == 1 ? 150.0 : D == 2 ? 37.0 : 19.0) + 2.0 * d;
    periodic[d] = d == 1;
  }
  return Lattice<D>(box, 1.0, periodic);
}

}  // namespace

BOOST_AUTO_TEST_CASE_TEMPLATE(blocks_tile_the_lattice, C, Dims) {
  constexpr int D = C::dimension;
  const Lattice<D> lattice = ragged<D>();
  Field<double, D, Sparse> field(lattice, -1.0);
  for (int d = 0; d < D; ++d) {
    const std::ptrdiff_t n = lattice.nodes()[d], extent = BlockShape<D>::extent;
    BOOST_TEST(field.block_grid()[d] == n / extent + (n % extent > 0 ? 1 : 0));
  }
  for (std::size_t i = 0; i < lattice.size(); ++i) field.set(lattice.node(i), static_cast<double>(i));
  BOOST_TEST(field.blocks() == static_cast<std::size_t>(product(field.block_grid())));
  std::vector<int> seen(lattice.size(), 0);
  std::size_t padding = 0;
  for (std::size_t b = 0; b < field.blocks(); ++b) {
    BOOST_TEST(field.find(field.block_index(b)) == static_cast<std::ptrdiff_t>(b));
    BOOST_TEST((field.node(b, 0) == field.block_origin(b)));
    BOOST_TEST(field.block(b).size() == BlockShape<D>::volume);
    for (std::size_t k = 0; k < field.block(b).size(); ++k) {
      const Index<D> node = field.node(b, k);
      BOOST_TEST((field.block_of(node) == field.block_index(b)));
      BOOST_TEST(field.offset(node) == k);
      if (lattice.contains(node)) {
        ++seen[lattice.number(node)];
        BOOST_TEST(field.block(b)[k] == static_cast<double>(lattice.number(node)));
        BOOST_TEST(&std::as_const(field)(node) == &field.block(b)[k]);
      } else {
        ++padding;
        BOOST_TEST(field.block(b)[k] == -1.0);
      }
    }
  }
  BOOST_TEST(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
  BOOST_TEST(padding == field.blocks() * BlockShape<D>::volume - lattice.size());
}

BOOST_AUTO_TEST_CASE_TEMPLATE(only_activated_blocks_exist, C, Dims) {
  constexpr int D = C::dimension;
  const Lattice<D> lattice = ragged<D>();
  Field<Vec<2>, D, Sparse> field(lattice, {3.0, 4.0});
  const Index<D> first = Index<D>::constant(BlockShape<D>::extent + 1);
  BOOST_TEST(field.blocks() == 0u);
  BOOST_TEST(field.find(field.block_of(first)) == -1);
  BOOST_TEST((field(first) == Vec<2>{3.0, 4.0}));

  field.set(first, {1.0, 2.0});
  BOOST_TEST(field.blocks() == 1u);
  BOOST_TEST((field(first) == Vec<2>{1.0, 2.0}));
  BOOST_TEST((field(first + Index<D>::unit(0)) == Vec<2>{3.0, 4.0}));  // its block, not set
  BOOST_TEST((field(Index<D>{}) == Vec<2>{3.0, 4.0}));                 // no block
  BOOST_TEST(field.activate_node(first) == 0u);                        // a second time changes nothing
  BOOST_TEST(field.activate(Index<D>{}) == 1u);                        // blocks are numbered as they come
  BOOST_TEST((field(first) == Vec<2>{1.0, 2.0}));
  BOOST_TEST(field.blocks() == 2u);

  field.fill({5.0, 6.0});
  BOOST_TEST((field(first) == Vec<2>{5.0, 6.0}));
  BOOST_TEST((field.background() == Vec<2>{3.0, 4.0}));
  field.clear();
  BOOST_TEST(field.blocks() == 0u);
  BOOST_TEST((field(first) == Vec<2>{3.0, 4.0}));
  field.activate_node(first);
  BOOST_TEST((field(first) == Vec<2>{3.0, 4.0}));  // not what the block held before
}

BOOST_AUTO_TEST_CASE(memory_of_cleared_blocks_is_used_again) {
  Field<double, 2, Sparse> field(ragged<2>());
  for (std::ptrdiff_t b = 0; b < 3; ++b) field.activate({b, 1});
  const double* values = field.block(0).data();
  field.clear();
  for (std::ptrdiff_t b = 0; b < 3; ++b) field.activate({b, 0});
  BOOST_TEST(field.block(0).data() == values);
}

BOOST_AUTO_TEST_CASE(nodes_beyond_the_lattice_are_refused) {
  Field<double, 2, Sparse> field(ragged<2>());  // 38 x 39 nodes in 3 x 3 blocks of 16 x 16
  const auto refuses = [&](auto&& f, const std::string& part) {
    BOOST_CHECK_EXCEPTION(f(), LatticeError, [&](const Error& error) {
      return std::string(error.what()).find(part) != std::string::npos;
    });
    BOOST_TEST(field.blocks() == 0u);
  };
  refuses([&] { field.set({-1, 0}, 1.0); }, "node (-1, 0) is outside the lattice of (38, 39) nodes");
  refuses([&] { field.set({0, 39}, 1.0); }, "node (0, 39) is outside");
  refuses([&] { field.activate_node({38, 0}); }, "node (38, 0) is outside");
  refuses([&] { field.activate({0, 3}); }, "block (0, 3) is outside the grid of (3, 3) blocks along axis 1");
  refuses([&] { field.activate({-1, 0}); }, "block (-1, 0) is outside");
}
