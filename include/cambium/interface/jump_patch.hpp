// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

#include <cambium/core/aligned.hpp>
#include <cambium/levelset/narrow_band.hpp>

namespace cambium::detail {

/// A solution with a jump, made smooth across it: the mean (p_in + p_out) / 2 of both sides, each continued to the
/// other side by the extension of the jump. That is p + D / 2 inside and p - D / 2 outside.
///
/// What D leaves out beyond the second order, |phi|^3 c, enters the mean alike on both sides and so hardly its gradient
/// at the interface.
template <int D, class T>
struct SmoothedJump {
  const Field<T, D>& p;
  const Field<T, D, Sparse>& extension;
  const NarrowBand<T, D>& band;

  T operator()(const Index<D>& node) const {
    const T half = T(0.5) * extension(node);
    return band(node) < T(0) ? p(node) + half : p(node) - half;
  }
};

/// Copy of a box of nodes of a smoothed solution, as Patch is for phi.
template <class T, int D>
class JumpPatch {
 public:
  const Index<D>& stride() const { return stride_; }
  const T* data() const { return values_.data(); }

  /// Copies the nodes first, ..., first + edge - 1.
  void read(const SmoothedJump<D, T>& source, const Index<D>& first, const Index<D>& edge) {
    stride_[0] = 1;
    for (int d = 1; d < D; ++d) stride_[d] = stride_[d - 1] * edge[d - 1];
    const auto size = static_cast<std::size_t>(product(edge));
    // A vector that starts at the last stencil of a row may reach beyond the last node.
    if (values_.size() < size + 16) values_.resize(size + 16);
    for (std::size_t at = 0; at < size; ++at) {
      Index<D> node = first;
      for (int d = 0; d < D; ++d) node[d] += static_cast<std::ptrdiff_t>(at) / stride_[d] % edge[d];
      values_[at] = source(source.band.inside(node));
    }
  }

 private:
  Index<D> stride_{};
  AlignedVector<T> values_;
};

}  // namespace cambium::detail
