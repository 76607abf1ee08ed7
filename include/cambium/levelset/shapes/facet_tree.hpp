// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <cambium/levelset/shapes/facet_point.hpp>
#include <cambium/levelset/shapes/surface_mesh.hpp>

namespace cambium::detail {

/// The facets of a mesh in a binary tree of boxes, for the nearest of them to a position.
template <int D>
class FacetTree {
 public:
  /// What is nearest: which facet of the mesh, and which of its points.
  struct Nearest {
    std::size_t facet = 0;
    double square = std::numeric_limits<double>::infinity();  ///< of the distance
    FacetPoint<D> at;
  };

  explicit FacetTree(const SurfaceMesh<D>& mesh) : order_(mesh.facets.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    nodes_.reserve(order_.size());
    build(mesh, 0, order_.size());
    for (const std::size_t f : order_) {
      FacetCorners<D> corners;
      for (int k = 0; k < D; ++k) corners[static_cast<std::size_t>(k)] = mesh.corner(f, k);
      corners_.push_back(corners);
    }
  }

  const Box<D>& bounds() const { return nodes_[0].box; }

  /// Of facets at the same distance the one met first, always the same.
  Nearest nearest(const Vec<D>& x) const {
    struct Visit {
      std::size_t node;
      double square;
    };
    Nearest best;
    std::array<Visit, deepest> stack;
    std::size_t size = 0;
    stack[size++] = {0, square_distance(nodes_[0].box, x)};
    while (size > 0) {
      const Visit visit = stack[--size];
      if (!(visit.square < best.square)) continue;
      const Node& node = nodes_[visit.node];
      if (node.right == 0) {
        for (std::size_t i = node.begin; i < node.end; ++i) offer(i, x, best);
        continue;
      }
      Visit near{visit.node + 1, square_distance(nodes_[visit.node + 1].box, x)};
      Visit far{node.right, square_distance(nodes_[node.right].box, x)};
      if (far.square < near.square) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
    }
    return best;
  }

 private:
  static constexpr std::size_t leaf = 2;
  /// Halves of halves: as many levels as a number of facets has bits, each with two visits waiting.
  static constexpr std::size_t deepest = 128;

  struct Node {
    Box<D> box;
    std::size_t begin, end;
    std::size_t right = 0;  ///< the left child follows its parent; 0 for a leaf
  };

  void offer(std::size_t i, const Vec<D>& x, Nearest& best) const {
    const FacetPoint<D> at = nearest_on_facet(corners_[i], x);
    const double square = dot(at.point - x, at.point - x);
    if (square < best.square) best = {order_[i], square, at};
  }
  static double square_distance(const Box<D>& box, const Vec<D>& x) {
    double sum = 0.0;
    for (int d = 0; d < D; ++d) {
      const double beyond = std::max({box.lo[d] - x[d], x[d] - box.hi[d], 0.0});
      sum += beyond * beyond;
    }
    return sum;
  }
  static Vec<D> middle(const SurfaceMesh<D>& mesh, std::size_t facet) {
    Vec<D> sum{};
    for (int k = 0; k < D; ++k) sum += mesh.corner(facet, k);
    return sum;
  }
  std::size_t build(const SurfaceMesh<D>& mesh, std::size_t begin, std::size_t end) {
    const std::size_t number = nodes_.size();
    Box<D> box{mesh.corner(order_[begin], 0), mesh.corner(order_[begin], 0)};
    for (std::size_t i = begin; i < end; ++i) {
      for (int k = 0; k < D; ++k) box = hull(box, {mesh.corner(order_[i], k), mesh.corner(order_[i], k)});
    }
    nodes_.push_back({box, begin, end, 0});
    if (end - begin <= leaf) return number;
    int axis = 0;
    for (int d = 1; d < D; ++d) axis = box.extent()[d] > box.extent()[axis] ? d : axis;
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(half), at(end), [&](std::size_t a, std::size_t b) {
      const double xa = middle(mesh, a)[axis], xb = middle(mesh, b)[axis];
      return xa != xb ? xa < xb : a < b;
    });
    build(mesh, begin, half);
    const std::size_t right = build(mesh, half, end);
    nodes_[number].right = right;
    return number;
  }

  std::vector<Node> nodes_;
  std::vector<std::size_t> order_;
  std::vector<FacetCorners<D>> corners_;
};

}  // namespace cambium::detail
