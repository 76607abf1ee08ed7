// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/shapes/mesh_shape.hpp>
#include <cambium/levelset/surface.hpp>

#include "mesh_file.hpp"

namespace tumour {

using cambium::Vec;

namespace {

constexpr double same_place = 1e-4;  ///< in spacings

}  // namespace

cambium::TriangleMesh mesh_of(const Shape<3>& shape, double box, int cells) {
  const auto lattice =
      cambium::Lattice<3>::bounded_box({Vec<3>::constant(-0.5 * box), Vec<3>::constant(0.5 * box)}, cells);
  const cambium::LevelSet<> body(lattice, shape);
  const auto surface = cambium::extract_surface(body.band());
  // Where the surface runs through a node there are corners all around it, next to each other: they become one.
  const auto settled = [&](Vec<3> x) {
    Vec<3> node;
    for (int d = 0; d < 3; ++d) {
      node[d] = lattice.box().lo[d] + lattice.spacing() * std::round((x[d] - lattice.box().lo[d]) / lattice.spacing());
    }
    return norm(x - node) < same_place * lattice.spacing() ? node : x;
  };
  std::vector<Triangle> triangles;
  for (const auto& e : surface.elements) {
    triangles.push_back(
        {settled(surface.vertices[e[0]]), settled(surface.vertices[e[1]]), settled(surface.vertices[e[2]])});
  }
  return join(triangles);
}

Shape<3> shape_from_mesh(const cambium::TriangleMesh& mesh, double scale) {
  cambium::TriangleMesh moved = mesh;
  cambium::check_closed(mesh);
  Vec<3> moment;
  double volume = 0.0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const Vec<3> a = mesh.corner(f, 0), b = mesh.corner(f, 1), c = mesh.corner(f, 2);
    const double part = dot(a, cross(b, c)) / 6.0;
    volume += part;
    moment = moment + 0.25 * part * (a + b + c);
  }
  for (auto& x : moved.vertices) x = scale * (x - moment / volume);
  return cambium::MeshShape<3>(moved);
}

}  // namespace tumour
