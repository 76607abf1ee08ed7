// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include <cambium/surface/place_batch.hpp>
#include <cambium/surface/sheet_plan.hpp>

namespace cambium::detail {

/// One thread's view of a group: its patch filled with values, and what stencils and interpolation make of it.
template <class Stencil, class T, int D>
class GroupValues {
 public:
  using Plan = SheetPlan<T, D>;
  using Group = typename Plan::Group;
  using Kernel = typename Stencil::Kernel;
  using Batch = PlaceBatch<Kernel, T, D>;

  /// Makes room for `fields` values at each entry.
  void fit(const Plan& plan, int fields) {
    const std::size_t size = plan.largest_patch + padding;
    if (patch_.size() < static_cast<std::size_t>(fields)) patch_.resize(static_cast<std::size_t>(fields));
    for (auto& patch : patch_) {
      if (patch.size() < size) patch.assign(size, T(0));
    }
    if (result_.size() < size) result_.assign(size, T(0));
  }
  void read(const Plan& plan, const Group& group, const T* values, int field = 0) {
    const std::uint16_t* entry = plan.entry.data() + group.first_entry;
    const std::int32_t* source = plan.source.data() + group.first_entry;
    T* to = patch_[static_cast<std::size_t>(field)].data();
    for (std::size_t e = 0; e < group.entries; ++e) to[entry[e]] = values[source[e]];
  }
  /// result := (h^2 Laplacian + shift) of the field at the entries that interpolation reads.
  void apply(const Group& group, T shift, int field = 0) {
    const Index<D> stride = stride_of(group);
    const T* from = patch_[static_cast<std::size_t>(field)].data();
    const std::ptrdiff_t rows = product(group.inner) / group.inner[0];
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      std::ptrdiff_t at = Stencil::reach, rest = row;
      for (int d = 1; d < D; ++d) {
        at += (rest % group.inner[d] + Stencil::reach) * stride[d];
        rest /= group.inner[d];
      }
      Stencil::template row<T, D>(from, result_.data(), at, group.inner[0], stride, shift);
    }
  }
  /// Calls f(k, value) with the result of apply() at the closest point of every value k of the group.
  template <class F>
  void interpolate_result(const Plan& plan, const Group& group, F&& f) const {
    interpolate(plan, group, result_.data(), f);
  }
  /// Calls f(k, value) with a field at the closest point of every value k of the group.
  template <class F>
  void interpolate_field(const Plan& plan, const Group& group, F&& f, int field = 0) const {
    interpolate(plan, group, patch_[static_cast<std::size_t>(field)].data(), f);
  }

  /// One field's patch.
  const T* patch(int field) const { return patch_[static_cast<std::size_t>(field)].data(); }
  static Index<D> stride_of(const Group& group) {
    Index<D> stride;
    stride[0] = 1;
    for (int d = 1; d < D; ++d) stride[d] = stride[d - 1] * group.edge[d - 1];
    return stride;
  }

 private:
  /// Vectors reach beyond the last entry, and begin before the first.
  static constexpr std::size_t padding = 32;

  template <class F>
  static void interpolate(const Plan& plan, const Group& group, const T* values, F&& f) {
    const Index<D> stride = stride_of(group);
    const std::size_t end = group.first_value + group.values;
    for (std::size_t first = group.first_value; first < end; first += Batch::places) {
      std::array<const T*, D> place;
      for (int d = 0; d < D; ++d) place[d] = plan.place[d].data() + first;
      const Batch batch(place, stride);
      const std::size_t count = std::min(Batch::places, end - first);
      alignas(64) std::array<T, Batch::places> value;
      batch(values, count, value.data());
      for (std::size_t p = 0; p < count; ++p) f(first + p, value[p]);
    }
  }

  std::vector<AlignedVector<T>> patch_;
  AlignedVector<T> result_;
};

}  // namespace cambium::detail
