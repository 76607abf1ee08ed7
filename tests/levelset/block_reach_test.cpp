// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE block_reach
#include <boost/test/unit_test.hpp>
#include <set>
#include <tuple>

#include <cambium/levelset/band_builder.hpp>

using namespace cambium;

namespace {

template <int D>
std::set<std::array<std::ptrdiff_t, D>> marked(const detail::BlockMarks<D>& marks) {
  std::set<std::array<std::ptrdiff_t, D>> result;
  marks.for_each([&](const Index<D>& block) {
    std::array<std::ptrdiff_t, D> entry;
    for (int d = 0; d < D; ++d) entry[d] = block[d];
    result.insert(entry);
  });
  return result;
}

/// The blocks of all nodes within `reach` of a node, one node after another.
template <int D>
std::set<std::array<std::ptrdiff_t, D>> blocks_near(const Lattice<D>& lattice, const Index<D>& centre, double reach) {
  std::set<std::array<std::ptrdiff_t, D>> result;
  const auto r = static_cast<std::ptrdiff_t>(reach);
  const Index<D> edge = Index<D>::constant(2 * r + 1);
  for (std::ptrdiff_t k = 0; k < product(edge); ++k) {
    std::ptrdiff_t rest = k;
    double square = 0.0;
    bool inside = true;
    std::array<std::ptrdiff_t, D> block;
    for (int d = 0; d < D; ++d, rest /= edge[0]) {
      const std::ptrdiff_t step = rest % edge[0] - r, n = lattice.nodes()[d];
      std::ptrdiff_t node = centre[d] + step;
      if (lattice.periodic(d)) node = ((node % n) + n) % n;
      inside &= node >= 0 && node < n;
      square += static_cast<double>(step * step);
      block[d] = node / BlockShape<D>::extent;
    }
    if (inside && square <= reach * reach) result.insert(block);
  }
  return result;
}

template <int D>
std::set<std::array<std::ptrdiff_t, D>> blocks_marked(const Lattice<D>& lattice, const Index<D>& node, double reach) {
  const detail::BlockReach<D> near(lattice, reach);
  detail::BlockMarks<D> marks(lattice);
  auto set = near.empty_set();
  near.add(Field<char, D, Sparse>::offset(node), set);
  marks.mark(Field<char, D, Sparse>::block_of(node), near, set);
  return marked(marks);
}

template <int D>
void check(const Lattice<D>& lattice, bool exactly) {
  const std::ptrdiff_t n = lattice.nodes()[0];
  for (const double reach : {0.0, 1.0, 2.5, 5.0, 13.0}) {
    for (std::ptrdiff_t i = 0; i < n; i += 3) {
      Index<D> node = Index<D>::constant(n / 2);
      node[0] = i;
      node[D - 1] = (2 * i + 1) % n;
      const auto wanted = blocks_near(lattice, node, reach), found = blocks_marked(lattice, node, reach);
      BOOST_REQUIRE(std::ranges::includes(found, wanted));
      if (exactly) BOOST_REQUIRE(found.size() == wanted.size());
    }
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(as_one_node_after_another) {
  // Distances to nodes behind a bounded face count, too: their block may be marked for nodes that are not there.
  check(Lattice<2>::bounded_box(Box<2>::cube(), 63), true);
  check(Lattice<3>::bounded_box(Box<3>::cube(), 39), true);
  check(Lattice<2>::bounded_box(Box<2>::cube(), 66), false);
  check(Lattice<2>::periodic_box(Box<2>::cube(), 64), true);
  check(Lattice<3>::periodic_box(Box<3>::cube(), 40), true);
  check(Lattice<2>::periodic_box(Box<2>::cube(), 50), false);
  check(Lattice<3>::periodic_box(Box<3>::cube(), 27), false);
}
