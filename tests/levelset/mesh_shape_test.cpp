// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause

#define BOOST_TEST_MODULE levelset_mesh_shape
#include <boost/test/unit_test.hpp>
#include <support/meshes.hpp>
#include <support/order.hpp>
#include <support/surface_samples.hpp>

#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/cuboid.hpp>
#include <cambium/levelset/shapes/mesh_shape.hpp>

using namespace cambium;

namespace {

constexpr double pi = std::numbers::pi;

/// 2 pi times the generalised winding number: sum of the angles (in 3D half the solid angles) that facets cover.
double winding(const TriangleMesh& mesh, const Vec<3>& x) {
  double sum = 0.0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const Vec<3> a = mesh.corner(f, 0) - x, b = mesh.corner(f, 1) - x, c = mesh.corner(f, 2) - x;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    sum += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum;
}
double winding(const Polyline& mesh, const Vec<2>& x) {
  double sum = 0.0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const Vec<2> a = mesh.corner(f, 0) - x, b = mesh.corner(f, 1) - x;
    sum += std::atan2(a[0] * b[1] - a[1] * b[0], dot(a, b));
  }
  return sum;
}

/// Distance to all facets, the tree left out.
template <int D>
double distance(const SurfaceMesh<D>& mesh, const Vec<D>& x) {
  double least = 1e300;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    cambium::detail::FacetCorners<D> corners;
    for (int k = 0; k < D; ++k) corners[static_cast<std::size_t>(k)] = mesh.corner(f, k);
    least = std::min(least, norm(cambium::detail::nearest_on_facet(corners, x).point - x));
  }
  return least;
}

/// A star whose points are sharp and whose notches are sharper: vertices of all kinds.
TriangleMesh spiky() {
  TriangleMesh mesh = support::icosphere({}, 1.0, 2);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices[v] *= v % 3 == 0 ? 1.6 : v % 3 == 1 ? 0.5 : 1.0;
  return mesh;
}

}  // namespace

BOOST_AUTO_TEST_CASE(mesh_of_a_box_has_the_distance_of_the_box) {
  const Box<3> box{{0.1, 0.2, 0.3}, {0.6, 0.9, 0.5}};
  const MeshShape<3> mesh(support::box_mesh(box));
  const Cuboid<3> exact(box);
  check_shape<MeshShape<3>>();
  BOOST_TEST((mesh.bounds() == box));
  for (const auto& x : support::random_points<3>(Box<3>::cube(1.0), 4000)) {
    if (!(std::abs(mesh(x) - exact(x)) < 1e-14)) BOOST_TEST(mesh(x) == exact(x));
  }
  for (int d = 0; d < 3; ++d) {  // positions over edges and corners to the last bit
    Vec<3> x = box.hi + Vec<3>::constant(0.1);
    BOOST_TEST(std::abs(mesh(x) - exact(x)) < 1e-15);
    x[d] = box.centre()[d];
    BOOST_TEST(std::abs(mesh(x) - exact(x)) < 1e-15);
    BOOST_TEST(mesh(box.hi) == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(polyline_has_the_distance_of_its_rectangle) {
  const Box<2> box{{0.1, 0.2}, {0.6, 0.9}};
  const MeshShape<2> mesh(support::closed_polyline({box.lo, {0.6, 0.2}, box.hi, {0.1, 0.9}}));
  const Cuboid<2> exact(box);
  check_shape<MeshShape<2>>();
  for (const auto& x : support::random_points<2>(Box<2>::cube(1.0), 4000)) {
    if (!(std::abs(mesh(x) - exact(x)) < 1e-15)) BOOST_TEST(mesh(x) == exact(x));
  }
}

// All sides of sharp points and notches: the sign is that of the winding number, the distance that to all triangles.
BOOST_AUTO_TEST_CASE(signs_are_those_of_the_winding_number) {
  const TriangleMesh star = spiky();
  const MeshShape<3> shape(star);
  const Polyline saw = support::closed_polyline(
      {{0.0, 0.0}, {3.0, 0.0}, {2.0, 0.1}, {3.0, 3.0}, {1.6, 0.2}, {1.5, 2.9}, {1.4, 0.2}, {0.0, 3.0}, {0.9, 0.1}});
  const MeshShape<2> saw_shape(saw);
  int wrong_sign = 0, wrong = 0, inside = 0;
  for (const auto& x : support::random_points<3>({Vec<3>::constant(-1.8), Vec<3>::constant(1.8)}, 3000)) {
    wrong_sign += (shape(x) < 0.0) != (winding(star, x) > pi);
    wrong += std::abs(shape(x)) != distance(star, x);
    inside += shape(x) < 0.0;
  }
  for (const auto& x : support::random_points<2>({Vec<2>::constant(-1.0), Vec<2>::constant(4.0)}, 3000)) {
    wrong_sign += (saw_shape(x) < 0.0) != (winding(saw, x) > pi);
    wrong += std::abs(saw_shape(x)) != distance(saw, x);
  }
  BOOST_TEST(wrong_sign == 0);
  BOOST_TEST(wrong == 0);
  BOOST_TEST(inside > 100);
}

// Flat triangles on a sphere are off it by the square of their size.
BOOST_AUTO_TEST_CASE(icosphere_converges_to_the_ball_at_order_two) {
  const auto error = [](int levels) {
    const MeshShape<3> mesh(support::icosphere({0.5, 0.5, 0.5}, 0.3, levels));
    double most = 0.0;
    for (const auto& x : support::random_points<3>(Box<3>::cube(1.0), 3000)) {
      most = std::max(most, std::abs(mesh(x) - (norm(x - Vec<3>::constant(0.5)) - 0.3)));
    }
    return most;
  };
  const double coarse = error(3), fine = error(5);
  BOOST_TEST(fine < 3e-4);
  BOOST_TEST(support::observed_order(coarse, fine, 4.0) > 1.8);  // measured 2.0
}

BOOST_AUTO_TEST_CASE(a_level_set_is_built_from_a_mesh) {
  const MeshShape<3> mesh(support::icosphere({0.5, 0.5, 0.5}, 0.3, 4));
  const auto lattice = Lattice<3>::bounded_box(Box<3>::cube(1.0), 48);
  const LevelSet<ClosestPoint, 3, double> level_set(lattice, mesh);
  double most = 0.0;
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const double phi = level_set.band()(lattice.node(i));
    const double exact = norm(lattice.position(lattice.node(i)) - Vec<3>::constant(0.5)) - 0.3;
    if (level_set.band().in_band(phi)) most = std::max(most, std::abs(phi - exact));
  }
  BOOST_TEST(most < 2e-3);  // 0.1 h: half of it from the triangles
}

BOOST_AUTO_TEST_CASE(an_open_mesh_is_an_error) {
  auto open = support::box_mesh(Box<3>::cube(1.0));
  open.facets.pop_back();
  BOOST_CHECK_THROW(MeshShape<3>{open}, MeshError);
}
