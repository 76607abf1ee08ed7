// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <cambium/levelset/shapes/facet_tree.hpp>

namespace cambium {

/// The body inside a closed mesh: the exact signed distance to its facets, at any position.
///
/// The side is told by the normal of what the nearest point lies on, of an edge the sum of the normals of its facets,
/// of a vertex their sum weighted by angles (Baerentzen and Aanaes 2005): it is exact for closed meshes that do not
/// intersect themselves and comes with the nearest point, where a winding number would be a sum over all facets.
template <int D>
class MeshShape {
 public:
  static constexpr int dimension = D;
  static constexpr double lipschitz = 1.0;

  /// Keeps what it needs of the mesh. \throws MeshError if the mesh does not bound a body, see check_closed()
  explicit MeshShape(const SurfaceMesh<D>& mesh) : facets_((check_closed(mesh), mesh.facets)), tree_(mesh) {
    find_normals(mesh);
  }

  double operator()(const Vec<D>& x) const {
    const auto nearest = tree_.nearest(x);
    const double distance = std::sqrt(nearest.square);
    return dot(x - nearest.at.point, normal(nearest.facet, nearest.at)) < 0.0 ? -distance : distance;
  }
  Box<D> bounds() const { return tree_.bounds(); }

 private:
  const Vec<D>& normal(std::size_t facet, const detail::FacetPoint<D>& at) const {
    if (at.corner >= 0) return vertex_normal_[facets_[facet][static_cast<std::size_t>(at.corner)]];
    if (D == 3 && at.opposite >= 0) return edge_normal_[facet][static_cast<std::size_t>(at.opposite)];
    return normal_[facet];
  }
  /// Angle of a facet at a corner; ends of segments all count the same.
  static double angle(const SurfaceMesh<D>& mesh, std::size_t facet, int corner) {
    if constexpr (D == 2) {
      return 1.0;
    } else {
      const Vec<3> a = mesh.corner(facet, (corner + 1) % 3) - mesh.corner(facet, corner);
      const Vec<3> b = mesh.corner(facet, (corner + 2) % 3) - mesh.corner(facet, corner);
      return std::atan2(norm(cross(a, b)), dot(a, b));
    }
  }
  void find_normals(const SurfaceMesh<D>& mesh) {
    vertex_normal_.resize(mesh.vertices.size());
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const Vec<D> outward = facet_normal(mesh, f);
      normal_.push_back(outward / norm(outward));
      for (int k = 0; k < D; ++k) {
        vertex_normal_[facets_[f][static_cast<std::size_t>(k)]] += angle(mesh, f, k) * normal_[f];
      }
    }
    if constexpr (D == 3) {
      edge_normal_.resize(facets_.size());
      const auto ridges = detail::ridges(mesh);
      for (std::size_t i = 0; i < ridges.size(); i += 2) {
        const Vec<D> sum = normal_[ridges[i].facet] + normal_[ridges[i + 1].facet];
        for (const auto& ridge : {ridges[i], ridges[i + 1]}) {
          edge_normal_[ridge.facet][static_cast<std::size_t>(ridge.opposite)] = sum;
        }
      }
    }
  }

  std::vector<typename SurfaceMesh<D>::Facet> facets_;
  detail::FacetTree<D> tree_;
  std::vector<Vec<D>> normal_;
  std::vector<std::array<Vec<D>, 3>> edge_normal_;  ///< in 3D: by facet and opposite corner
  std::vector<Vec<D>> vertex_normal_;
};

}  // namespace cambium
