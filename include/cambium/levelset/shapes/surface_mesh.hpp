// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// A mesh does not bound a body: it has no facets, is open, not oriented, degenerate or not finite.
class MeshError : public Error {
 public:
  using Error::Error;
};

/// A surface of facets: triangles in 3D, segments in 2D.
template <int D>
struct SurfaceMesh {
  static_assert(D == 2 || D == 3, "cambium::SurfaceMesh: the dimension must be 2 or 3");
  using Facet = std::array<std::size_t, static_cast<std::size_t>(D)>;

  std::vector<Vec<D>> vertices;
  /// Numbers of vertices. Triangles counter-clockwise as seen from outside, segments with the inside on their left.
  std::vector<Facet> facets;

  /// Position of corner k of a facet.
  const Vec<D>& corner(std::size_t facet, int k) const { return vertices[facets[facet][static_cast<std::size_t>(k)]]; }
};

using TriangleMesh = SurfaceMesh<3>;
using Polyline = SurfaceMesh<2>;

/// Outward normal of a facet, as long as its measure: the length of a segment, twice the area of a triangle.
inline Vec<2> facet_normal(const SurfaceMesh<2>& mesh, std::size_t facet) {
  const Vec<2> along = mesh.corner(facet, 1) - mesh.corner(facet, 0);
  return {along[1], -along[0]};
}
inline Vec<3> facet_normal(const SurfaceMesh<3>& mesh, std::size_t facet) {
  return cross(mesh.corner(facet, 1) - mesh.corner(facet, 0), mesh.corner(facet, 2) - mesh.corner(facet, 0));
}

/// Volume (in 2D area) inside a closed mesh; negative if it is inside out.
template <int D>
double enclosed_volume(const SurfaceMesh<D>& mesh) {
  double sum = 0.0;
  if (mesh.vertices.empty()) return sum;
  // Cones to a vertex of the mesh rather than to the origin, which may be far away.
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    sum += dot(facet_normal(mesh, f), mesh.corner(f, 0) - mesh.vertices[0]);
  }
  return D == 2 ? sum / 2.0 : sum / 6.0;
}

namespace detail {

/// Where facets meet: in 3D an edge, in 2D a vertex.
template <int D>
struct Ridge {
  std::array<std::size_t, static_cast<std::size_t>(D - 1)> vertices;  ///< in ascending order
  bool ascending;                                                     ///< the way that the facet goes round
  std::size_t facet;
  int opposite;  ///< corner of the facet that is not on the ridge

  friend bool operator<(const Ridge& a, const Ridge& b) {
    return a.vertices != b.vertices ? a.vertices < b.vertices : a.facet < b.facet;
  }
};

template <int D>
std::vector<Ridge<D>> ridges(const SurfaceMesh<D>& mesh) {
  std::vector<Ridge<D>> result;
  result.reserve(mesh.facets.size() * D);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto& facet = mesh.facets[f];
    for (int k = 0; k < D; ++k) {
      if constexpr (D == 2) {
        result.push_back({{facet[static_cast<std::size_t>(1 - k)]}, k == 0, f, k});
      } else {
        const std::size_t a = facet[static_cast<std::size_t>((k + 1) % 3)];
        const std::size_t b = facet[static_cast<std::size_t>((k + 2) % 3)];
        result.push_back({{std::min(a, b), std::max(a, b)}, a < b, f, k});
      }
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

template <int D>
void check_vertices(const SurfaceMesh<D>& mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    for (int d = 0; d < D; ++d) {
      if (std::isfinite(mesh.vertices[v][d])) continue;
      throw MeshError(message("vertex ", v, " of the mesh is at ", mesh.vertices[v], ": it must be finite"));
    }
  }
}

template <int D>
void check_facets(const SurfaceMesh<D>& mesh) {
  if (mesh.facets.empty()) throw MeshError("the mesh has no facets: there is no surface");
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    double longest = 0.0;
    for (const std::size_t v : mesh.facets[f]) {
      if (v < mesh.vertices.size()) continue;
      throw MeshError(message("facet ", f, " of the mesh has vertex ", v, " of ", mesh.vertices.size(),
                              ": numbers of vertices start from 0"));
    }
    for (int k = 0; k < D; ++k) longest = std::fmax(longest, norm(mesh.corner(f, (k + 1) % D) - mesh.corner(f, k)));
    const double flattest = D == 2 ? 0.0 : 1e-12 * longest * longest;
    if (norm(facet_normal(mesh, f)) > flattest) continue;
    throw MeshError(message("facet ", f, " of the mesh is degenerate, with corners at ", mesh.corner(f, 0), " and ",
                            mesh.corner(f, 1), ": merge its vertices"));
  }
}

/// The ridge at `begin` of a sorted list, which holds those up to `end`.
template <int D>
std::string describe_ridge(const SurfaceMesh<D>& mesh, const Ridge<D>& ridge, std::size_t count) {
  std::string text = D == 2 ? "vertex " : "edge ";
  for (const std::size_t v : ridge.vertices) text += message(v, " at ", mesh.vertices[v], ", ");
  return text + message("first in facet ", ridge.facet, ", belongs to ", count, D == 2 ? " segments" : " triangles");
}

/// Names the bad ridge of the first facet that has one.
template <int D>
void check_ridges(const SurfaceMesh<D>& mesh) {
  const std::vector<Ridge<D>> all = ridges(mesh);
  std::size_t bad = all.size();
  std::size_t bad_count = 0;
  for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end].vertices == all[i].vertices) ++end;
    const bool good = end - i == 2 && all[i].ascending != all[i + 1].ascending;
    if (good || (bad < all.size() && all[bad].facet <= all[i].facet)) continue;
    bad = i;
    bad_count = end - i;
  }
  if (bad == all.size()) return;
  const std::string what = describe_ridge(mesh, all[bad], bad_count);
  if (bad_count == 1) throw MeshError(what + ": the mesh is not closed; fill its holes and merge equal vertices");
  if (bad_count > 2) throw MeshError(what + ": the surface branches there; split it into closed surfaces");
  throw MeshError(what + " that go the same way round: turn one of them over");
}

/// The facets around a vertex must be one fan: where two bodies touch in a vertex no normal tells inside from outside.
inline void check_fans(const SurfaceMesh<2>&) {}
inline void check_fans(const SurfaceMesh<3>& mesh) {
  struct Spoke {
    std::size_t hub, from, to;
  };
  std::vector<Spoke> spokes;
  for (const auto& facet : mesh.facets) {
    for (std::size_t k = 0; k < 3; ++k) spokes.push_back({facet[k], facet[(k + 1) % 3], facet[(k + 2) % 3]});
  }
  const auto before = [](const Spoke& a, const Spoke& b) { return a.hub != b.hub ? a.hub < b.hub : a.from < b.from; };
  std::sort(spokes.begin(), spokes.end(), before);
  for (std::size_t i = 0, end = 0; i < spokes.size(); i = end) {
    while (end < spokes.size() && spokes[end].hub == spokes[i].hub) ++end;
    std::size_t steps = 0;
    Spoke at = spokes[i];
    do {
      at = *std::lower_bound(spokes.begin() + static_cast<std::ptrdiff_t>(i),
                             spokes.begin() + static_cast<std::ptrdiff_t>(end), Spoke{at.hub, at.to, 0}, before);
    } while (++steps < end - i && at.from != spokes[i].from);
    if (steps == end - i) continue;
    throw MeshError(message("vertex ", at.hub, " of the mesh at ", mesh.vertices[at.hub],
                            " joins two surfaces that touch nowhere else around it: give each a vertex of its own"));
  }
}

}  // namespace detail

/// Throws unless the mesh bounds a body: facets are not degenerate, every edge (in 2D vertex) belongs to exactly two of
/// them that go round it opposite ways, all around a vertex are one fan, the volume is positive, everything is finite.
/// Whether the surface intersects itself is not checked.
/// \throws MeshError that names the first offender
template <int D>
void check_closed(const SurfaceMesh<D>& mesh) {
  detail::check_vertices(mesh);
  detail::check_facets(mesh);
  detail::check_ridges(mesh);
  detail::check_fans(mesh);
  const double volume = enclosed_volume(mesh);
  if (!(volume > 0.0)) {
    throw MeshError(
        detail::message("the mesh encloses a volume of ", volume, ": it is inside out; turn every facet over"));
  }
}

}  // namespace cambium
