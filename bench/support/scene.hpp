// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/columns.hpp>
#include <cambium/core/lattice.hpp>
#include <cambium/particles/cell_order.hpp>

namespace bench {

/// Order in which particles lie in memory.
enum class Order { sorted, random };

/// As many particles as lattice cells, placed at random (so 0, 1, 2, ... in a cell, after Poisson), in the periodic
/// unit box, each with `components` strengths.
template <int D, class T>
struct Cloud {
  static constexpr int components = 3;

  Cloud(std::ptrdiff_t cells, Order order)
      : lattice(cambium::Lattice<D>::periodic_box(cambium::Box<D>::cube(), cells)) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    const T below_one = std::nextafter(T(1), T(0));
    for (auto& axis : x) axis.resize(lattice.size());
    for (auto& column : strength) column.resize(lattice.size());
    for (std::size_t p = 0; p < lattice.size(); ++p) {
      for (auto& axis : x) axis[p] = std::min(static_cast<T>(uniform(engine)), below_one);
      for (auto& column : strength) column[p] = static_cast<T>(uniform(engine));
    }
    if (order == Order::sorted) sort();
  }

  cambium::Columns<D, const T> positions() const { return {pointers(), lattice.size()}; }
  std::array<const T*, D> pointers() const {
    std::array<const T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = x[d].data();
    return first;
  }
  template <int C>
  cambium::Columns<C, const T> strengths() const {
    std::array<const T*, C> first;
    for (int c = 0; c < C; ++c) first[c] = strength[c].data();
    return {first, lattice.size()};
  }

  cambium::Lattice<D> lattice;
  std::array<cambium::AlignedVector<T>, D> x;
  std::array<cambium::AlignedVector<T>, components> strength;

 private:
  void sort() {
    cambium::CellOrder<D> order;
    order.sort(cambium::CellGrid<D>::cells_of(lattice), positions());
    const auto move = [&](cambium::AlignedVector<T>& array) {
      cambium::AlignedVector<T> moved(array.size());
      order.gather(std::span<const T>(array), std::span<T>(moved));
      array.swap(moved);
    };
    for (auto& axis : x) move(axis);
    for (auto& column : strength) move(column);
  }
};

/// An object that is made when it is first asked for.
template <class Object>
class Lazy {
 public:
  explicit Lazy(std::function<std::unique_ptr<Object>()> make) : make_(std::move(make)) {}
  Object& operator*() {
    if (!object_) object_ = make_();
    return *object_;
  }
  Object* operator->() { return &**this; }

 private:
  std::function<std::unique_ptr<Object>()> make_;
  std::unique_ptr<Object> object_;
};

/// A shared object made from `arguments` when it is first asked for.
template <class Object, class... Arguments>
auto lazily(Arguments... arguments) {
  return std::make_shared<Lazy<Object>>([=] { return std::make_unique<Object>(arguments...); });
}

}  // namespace bench
