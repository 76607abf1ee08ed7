// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <type_traits>
#include <utility>

#include <cambium/core/field.hpp>
#include <cambium/kernels/m4.hpp>
#include <cambium/kernels/m4_prime.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/levelset/narrow_band.hpp>
#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// What an image shows, as a function of the position: kernel K applied to levels at the nodes of a lattice.
///
/// Beyond a bounded face a level is that of the nearest point on the face; periodic axes repeat. Made by
/// shape_from_labels() and shape_from_grey().
template <class K, class T, int D>
class ImageShape {
 public:
  static constexpr int dimension = D;

  /// \param levels  negative inside
  explicit ImageShape(const Field<T, D>& levels) : lattice_(levels.lattice()) {
    Index<D> edge;
    for (int d = 0; d < D; ++d) edge[d] = lattice_.nodes()[d] + before + behind;
    stride_[0] = 1;
    for (int d = 1; d < D; ++d) stride_[d] = stride_[d - 1] * edge[d - 1];
    // A vector that starts at the last stencil of a row reaches beyond the last node.
    levels_.resize(static_cast<std::size_t>(product(edge)) + 16);
    for (std::ptrdiff_t k = 0; k < product(edge); ++k) {
      Index<D> node;
      for (int d = 0; d < D; ++d) node[d] = inside(k / stride_[d] % edge[d] - before, d);
      levels_[static_cast<std::size_t>(k)] = levels(node);
    }
  }

  double operator()(const Vec<D>& x) const {
    Vec<D, T> u;
    std::ptrdiff_t first = 0;
    for (int d = 0; d < D; ++d) {
      const double n = static_cast<double>(lattice_.nodes()[d]);
      double at = (x[d] - lattice_.box().lo[d]) / lattice_.spacing();
      at = lattice_.periodic(d) ? at - n * std::floor(at / n) : std::clamp(at, 0.0, n - 1.0);
      const double cell = std::floor(at);
      first += static_cast<std::ptrdiff_t>(cell) * stride_[d];
      u[d] = static_cast<T>(at - cell) + static_cast<T>(before);
    }
    return static_cast<double>(Interpolant<K, T, D>::value(levels_.data() + first, stride_, u));
  }

 private:
  static constexpr std::ptrdiff_t before = Interpolant<K, T, D>::before;
  /// A position that rounds to the end of a period takes one node more.
  static constexpr std::ptrdiff_t behind = K::support - before + 1;

  std::ptrdiff_t inside(std::ptrdiff_t i, int d) const {
    return lattice_.periodic(d) ? lattice_.wrap(d, i) : std::clamp<std::ptrdiff_t>(i, 0, lattice_.nodes()[d] - 1);
  }

  Lattice<D> lattice_;
  Index<D> stride_{};
  AlignedVector<T> levels_;
};

/// How labels are made smooth.
struct LabelParams {
  /// Times that M4 smooths the marks before it spreads them to positions. Every time takes away more of the steps
  /// between voxels, and more of what is as small as they are.
  int smoothing = 8;
};

/// Which grey values are inside.
enum class Inside { bright, dark };

namespace detail {

/// \throws InterfaceError if an image shows nothing or nothing else
inline void require_both(bool foreground, bool background, const std::string& what) {
  if (!foreground) {
    throw InterfaceError("the image has no foreground: no node " + what + "; there is no interface");
  }
  if (!background) {
    throw InterfaceError("the image has no background: every node " + what + "; there is no interface");
  }
}

/// One pass of M4 on the nodes, (1, 4, 1) / 6 along each axis; bounded faces repeat their value.
template <class T, int D>
void smooth_by_m4(Field<T, D>& field) {
  const Lattice<D>& lattice = field.lattice();
  std::ptrdiff_t stride = 1;
  for (int d = 0; d < D; ++d) {
    const std::ptrdiff_t n = lattice.nodes()[d];
    for (std::ptrdiff_t line = 0; line < static_cast<std::ptrdiff_t>(field.size()) / n; ++line) {
      T* const at = field.data() + line / stride * stride * n + line % stride;
      const T first = at[0];
      T previous = lattice.periodic(d) ? at[(n - 1) * stride] : first;
      for (std::ptrdiff_t i = 0; i < n; ++i) {
        const T here = at[i * stride];
        const T next = i + 1 < n ? at[(i + 1) * stride] : lattice.periodic(d) ? first : here;
        at[i * stride] = (previous + T(4) * here + next) / T(6);
        previous = here;
      }
    }
    stride *= n;
  }
}

/// field := (1 - variance Laplacian) field. A smoothing of variance s^2 moves the level 1/2 of the marks of a body of
/// curvature kappa inward by kappa s^2 / 2, as heat would; this brings it back where it was, to fourth order in s.
template <class T, int D>
void sharpen(Field<T, D>& field, double variance) {
  const Lattice<D>& lattice = field.lattice();
  const Field<T, D> smooth = field;
  const T weight = static_cast<T>(variance);
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Index<D> node = lattice.node(i);
    T sum(0);
    for (int d = 0; d < D; ++d) {
      for (const int way : {-1, 1}) {
        Index<D> next = node;
        next[d] += way;
        next[d] = lattice.periodic(d) ? lattice.wrap(d, next[d])
                                      : std::clamp<std::ptrdiff_t>(next[d], 0, lattice.nodes()[d] - 1);
        sum += smooth(next) - smooth[i];
      }
    }
    field[i] -= weight * sum;
  }
}

}  // namespace detail

/// The region of a label in an image whose voxels have their middles at the nodes of a lattice.
///
/// phi = 1/2 - marks smoothed by the B-spline M4 and sharpened so that curved surfaces stay where they are, scaled to a
/// slope of about one at the surface: a smooth function, constant further away, of which the reinitialisation makes the
/// distance. The surface is within half a voxel of a smooth body that the voxels were made from and on average on it
/// (for a ball of radius 20 h by 0.001 h); walls of one voxel are lost, those of two are kept.
/// \param image  one value for every node of the lattice, axis 0 fastest
/// \throws SizeError if sizes differ; InterfaceError if no node has the label or all have; ValueError if smoothing < 0
template <int D, class Array, class V>
ImageShape<M4, float, D> shape_from_labels(const Lattice<D>& lattice, const Array& image, const V& label,
                                           const LabelParams& params = {}) {
  const auto labels = std::span(image);
  require_size(labels.size(), lattice.size(), "the image");
  if (params.smoothing < 0) {
    throw ValueError(detail::message("labels are to be smoothed ", params.smoothing, " times: it must be at least 0"));
  }
  std::size_t marked = 0;
  Field<float, D> levels(lattice);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    levels[i] = labels[i] == label ? -0.5f : 0.5f;
    marked += levels[i] < 0.0f;
  }
  detail::require_both(marked > 0, marked < labels.size(), detail::message("has label ", +label));
  for (int pass = 0; pass < params.smoothing; ++pass) detail::smooth_by_m4(levels);
  // Marks of a half space become the integral of a bell of variance s^2 = 1/3 for every time M4 is applied, whose slope
  // 1 / (sqrt(2 pi) s) the sharpening doubles.
  const double variance = (params.smoothing + 1) / 3.0;
  detail::sharpen(levels, variance);
  const auto scale = static_cast<float>(lattice.spacing() * std::sqrt(2.0 * std::numbers::pi * variance) / 2.0);
  for (float& level : levels.values()) level *= scale;
  return ImageShape<M4, float, D>(levels);
}
template <class V, int D>
auto shape_from_labels(const Field<V, D>& image, const V& label, const LabelParams& params = {}) {
  return shape_from_labels(image.lattice(), image.values(), label, params);
}

/// The region of a grey-valued image above (Inside::bright) or below a threshold, interpolated by M4' between nodes: at
/// the nodes themselves phi is the difference from the threshold. Images with noise are to be smoothed before.
/// \param image  one value for every node of the lattice, axis 0 fastest
/// \throws SizeError if sizes differ; ValueError if a value or the threshold is not finite; InterfaceError if no node
/// is
///         inside or all are
template <int D, class Array>
auto shape_from_grey(const Lattice<D>& lattice, const Array& image, double threshold, Inside inside = Inside::bright) {
  const auto grey = std::span(image);
  using V = std::remove_cvref_t<decltype(grey[0])>;
  using T = std::conditional_t<std::is_same_v<V, float> || sizeof(V) <= 2, float, double>;
  require_size(grey.size(), lattice.size(), "the image");
  detail::finite(Vec<1>{threshold}, "threshold");
  Field<T, D> levels(lattice);
  std::size_t below = 0;
  for (std::size_t i = 0; i < grey.size(); ++i) {
    const auto value = static_cast<double>(grey[i]);
    if (!std::isfinite(value)) {
      throw ValueError(detail::message("the image is ", value, " at node ", lattice.node(i), ": it must be finite"));
    }
    levels[i] = static_cast<T>(inside == Inside::bright ? threshold - value : value - threshold);
    below += levels[i] < T(0);
  }
  const char* side = inside == Inside::bright ? "is above " : "is below ";
  detail::require_both(below > 0, below < grey.size(), detail::message(side, threshold));
  return ImageShape<M4Prime, T, D>(levels);
}
template <class V, int D>
auto shape_from_grey(const Field<V, D>& image, double threshold, Inside inside = Inside::bright) {
  return shape_from_grey(image.lattice(), image.values(), threshold, inside);
}

}  // namespace cambium
