// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#define BOOST_TEST_MODULE levelset_surface_mesh
#include <boost/test/unit_test.hpp>
#include <limits>
#include <support/meshes.hpp>

using namespace cambium;

namespace {

/// A predicate for BOOST_CHECK_EXCEPTION: the message has `text` in it.
auto says(const std::string& text) {
  return [text](const Error& error) {
    const bool found = std::string(error.what()).find(text) != std::string::npos;
    if (!found) BOOST_TEST_MESSAGE(error.what());
    return found;
  };
}

TriangleMesh cube() { return support::box_mesh(Box<3>::cube(2.0)); }

}  // namespace

BOOST_AUTO_TEST_CASE(closed_meshes_pass_and_enclose_their_volume) {
  check_closed(cube());
  BOOST_TEST(std::abs(enclosed_volume(cube()) - 8.0) < 1e-14);
  const auto sphere = support::icosphere({10.0, -5.0, 3.0}, 0.5, 4);
  check_closed(sphere);
  BOOST_TEST(sphere.facets.size() == 5120U);
  BOOST_TEST(std::abs(enclosed_volume(sphere) / (std::numbers::pi / 6.0) - 1.0) < 3e-3);
  const auto square = support::closed_polyline({{0.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}, {0.0, 3.0}});
  check_closed(square);
  BOOST_TEST(std::abs(enclosed_volume(square) - 6.0) < 1e-14);
}

BOOST_AUTO_TEST_CASE(the_first_bad_edge_is_named) {
  TriangleMesh open = cube();
  open.facets.erase(open.facets.begin() + 5);  // 1, 5, 4: next to facets 2, 4 and 10
  BOOST_CHECK_EXCEPTION(check_closed(open), MeshError, says("edge 4 at (0, 0, 2), 5 at (2, 0, 2), first in facet 2"));
  BOOST_CHECK_EXCEPTION(check_closed(open), MeshError, says("the mesh is not closed"));

  TriangleMesh turned = cube();
  std::swap(turned.facets[5][0], turned.facets[5][1]);
  BOOST_CHECK_EXCEPTION(check_closed(turned), MeshError,
                        says("first in facet 2, belongs to 2 triangles that go the same"));

  TriangleMesh branched = cube();
  branched.vertices.push_back({3.0, 3.0, 3.0});
  branched.facets.push_back({0, 1, 8});
  BOOST_CHECK_EXCEPTION(check_closed(branched), MeshError, says("belongs to 3 triangles: the surface branches"));

  Polyline line = support::closed_polyline({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}});
  line.facets.pop_back();
  BOOST_CHECK_EXCEPTION(check_closed(line), MeshError,
                        says("vertex 0 at (0, 0), first in facet 0, belongs to 1 segments"));
}

BOOST_AUTO_TEST_CASE(what_bounds_no_body_is_an_error) {
  BOOST_CHECK_EXCEPTION(check_closed(TriangleMesh{}), MeshError, says("no facets"));

  TriangleMesh broken = cube();
  broken.vertices[3][1] = std::numeric_limits<double>::quiet_NaN();
  BOOST_CHECK_EXCEPTION(check_closed(broken), MeshError, says("vertex 3"));

  TriangleMesh flat = cube();
  flat.facets[7] = {2, 6, 2};
  BOOST_CHECK_EXCEPTION(check_closed(flat), MeshError, says("facet 7 of the mesh is degenerate"));

  TriangleMesh beyond = cube();
  beyond.facets[4][2] = 8;
  BOOST_CHECK_EXCEPTION(check_closed(beyond), MeshError, says("facet 4 of the mesh has vertex 8 of 8"));

  TriangleMesh inside_out = cube();
  for (auto& facet : inside_out.facets) std::swap(facet[0], facet[1]);
  BOOST_CHECK_EXCEPTION(check_closed(inside_out), MeshError, says("inside out"));
  BOOST_CHECK_THROW(check_closed(support::closed_polyline({{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}})), MeshError);

  TriangleMesh touching = cube();  // two cubes that share vertex 7 of the first
  for (const auto& x : support::box_mesh(Box<3>::cube(1.0)).vertices) {
    touching.vertices.push_back(x + Vec<3>::constant(2.0));
  }
  for (auto facet : cube().facets) {
    for (auto& v : facet) v = v == 0 ? 7 : v + 8;
    touching.facets.push_back(facet);
  }
  BOOST_CHECK_EXCEPTION(check_closed(touching), MeshError,
                        says("vertex 7 of the mesh at (2, 2, 2) joins two surfaces"));
}
