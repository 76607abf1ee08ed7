// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <cambium/levelset/shapes/surface_mesh.hpp>

namespace support {

/// The faces of a box, two triangles each, seen counter-clockwise from outside.
inline cambium::TriangleMesh box_mesh(const cambium::Box<3>& box) {
  cambium::TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    cambium::Vec<3> x;
    for (int d = 0; d < 3; ++d) x[d] = (k >> d) % 2 == 0 ? box.lo[d] : box.hi[d];
    mesh.vertices.push_back(x);
  }
  mesh.facets = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A sphere of 20 * 4^levels triangles: an icosahedron whose triangles are cut into four, again and again.
inline cambium::TriangleMesh icosphere(const cambium::Vec<3>& centre, double radius, int levels) {
  cambium::TriangleMesh mesh;
  const double g = std::numbers::phi;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.facets = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
    const auto middle = [&](std::size_t a, std::size_t b) {
      const auto [at, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, mesh.vertices.size());
      if (is_new) mesh.vertices.push_back(mesh.vertices[a] + mesh.vertices[b]);
      if (is_new) mesh.vertices.back() *= norm(mesh.vertices[a]) / norm(mesh.vertices.back());
      return at->second;
    };
    const auto facets = std::exchange(mesh.facets, {});
    for (const auto& [a, b, c] : facets) {
      const std::size_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& facet : {std::array{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
        mesh.facets.push_back(facet);
      }
    }
  }
  for (auto& x : mesh.vertices) x = centre + radius / norm(x) * x;
  return mesh;
}

/// The closed polyline through points, in the order given.
inline cambium::Polyline closed_polyline(std::vector<cambium::Vec<2>> points) {
  cambium::Polyline mesh{std::move(points), {}};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.facets.push_back({v, (v + 1) % mesh.vertices.size()});
  return mesh;
}

}  // namespace support
