// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include <cambium/core/error.hpp>
#include <cambium/core/vec.hpp>

namespace cambium {

/// View of `size` vectors of C components stored as C separate arrays (structure of arrays).
///
/// Reading gives a Vec by value, writing goes through set() and add(); column(c) is the contiguous array of one
/// component. T may be const.
template <int C, class T>
class Columns {
 public:
  using Scalar = std::remove_const_t<T>;
  using value_type = Vec<C, Scalar>;
  static constexpr int count = C;

  Columns() = default;
  Columns(const std::array<T*, C>& first, std::size_t size) : first_(first), size_(size) {}
  /// View of C spans. \throws SizeError unless all have the same length
  explicit Columns(const std::array<std::span<T>, C>& spans) : size_(spans[0].size()) {
    for (int c = 0; c < C; ++c) {
      require_size(spans[c].size(), size_, "a component array");
      first_[c] = spans[c].data();
    }
  }
  /// A scalar array is a view of one column.
  Columns(std::span<T> scalar) requires(C == 1) : first_{scalar.data()}, size_(scalar.size()) {}

  /// A view of mutable data reads as a view of const data.
  operator Columns<C, const Scalar>() const requires(!std::is_const_v<T>) {
    std::array<const Scalar*, C> first;
    for (int c = 0; c < C; ++c) first[c] = first_[c];
    return {first, size_};
  }

  std::size_t size() const { return size_; }
  std::span<T> column(int c) const { return {first_[c], size_}; }

  value_type operator[](std::size_t p) const {
    value_type result;
    for (int c = 0; c < C; ++c) result[c] = first_[c][p];
    return result;
  }
  void set(std::size_t p, const value_type& value) const {
    for (int c = 0; c < C; ++c) first_[c][p] = value[c];
  }
  void add(std::size_t p, const value_type& value) const {
    for (int c = 0; c < C; ++c) first_[c][p] += value[c];
  }

 private:
  std::array<T*, C> first_{};
  std::size_t size_ = 0;
};

/// Columns for reading: Columns as they are, an array or span of scalars as one column.
template <int C, class T>
Columns<C, const std::remove_const_t<T>> read_columns(const Columns<C, T>& columns) {
  return columns;
}
template <class Array>
auto read_columns(const Array& array) requires requires {
  std::span(array);
}
{
  const auto span = std::span(array);
  using Scalar = std::remove_const_t<typename decltype(span)::element_type>;
  return Columns<1, const Scalar>(std::span<const Scalar>(span));
}

namespace detail {

template <class V>
inline constexpr bool is_columns = false;
template <int C, class T>
inline constexpr bool is_columns<Columns<C, T>> = true;

/// View of particle data as columns: Columns stay as they are, an array or span of scalars becomes one column.
template <class V>
auto columns_of(V&& values) {
  if constexpr (is_columns<std::remove_cvref_t<V>>) {
    return values;
  } else {
    auto span = std::span(values);
    return Columns<1, typename decltype(span)::element_type>(span);
  }
}

}  // namespace detail

}  // namespace cambium
