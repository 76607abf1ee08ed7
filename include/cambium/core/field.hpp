// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <span>
#include <utility>

#include <cambium/core/aligned.hpp>
#include <cambium/core/lattice.hpp>

namespace cambium {

/// Storage of every node of the lattice in one aligned array, axis 0 fastest.
struct Dense {};
/// Storage of blocks of nodes where they are needed; see sparse.hpp.
struct Sparse {};

/// Values of type T (a scalar or a Vec) at the nodes of a lattice. Defined for Storage = Dense and Sparse.
template <class T, int D, class Storage = Dense>
class Field;

/// Dense field: a value for every node.
template <class T, int D>
class Field<T, D, Dense> {
 public:
  using value_type = T;
  using storage = Dense;
  static constexpr int dimension = D;

  explicit Field(const Lattice<D>& lattice, T initial = T{}) : lattice_(lattice), values_(lattice.size(), initial) {}

  const Lattice<D>& lattice() const { return lattice_; }
  std::size_t size() const { return values_.size(); }

  T& operator[](std::size_t number) { return values_[number]; }
  const T& operator[](std::size_t number) const { return values_[number]; }
  T& operator()(const Index<D>& node) { return values_[lattice_.number(node)]; }
  const T& operator()(const Index<D>& node) const { return values_[lattice_.number(node)]; }

  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }

  void fill(const T& value) { std::fill(values_.begin(), values_.end(), value); }

  /// Sets every node to f(position of the node).
  template <class F>
  Field& sample(F&& f) {
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = f(lattice_.position(lattice_.node(i)));
    return *this;
  }

 private:
  Lattice<D> lattice_;
  AlignedVector<T> values_;
};

/// A dense field that holds f at the nodes of `lattice`.
template <int D, class F>
auto sample(const Lattice<D>& lattice, F&& f) {
  using T = std::remove_cvref_t<decltype(f(Vec<D>{}))>;
  Field<T, D> field(lattice);
  field.sample(std::forward<F>(f));
  return field;
}

}  // namespace cambium
