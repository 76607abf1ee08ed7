// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <type_traits>
#include <vector>

#include <cambium/core/columns.hpp>
#include <cambium/core/sparse.hpp>
#include <cambium/kernels.hpp>

namespace support {

/// True if two kernels are one function: the same support and the same polynomials.
template <class K, class L>
constexpr bool same_kernel() {
  if (K::support != L::support || K::moments != L::moments || K::pieces.degree != L::pieces.degree) return false;
  for (int i = 0; i < K::pieces.count; ++i) {
    for (int m = 0; m <= K::pieces.degree; ++m) {
      if (K::pieces.centred(i, m) != L::pieces.centred(i, m)) return false;
    }
  }
  return true;
}
// So that tests of every kernel need not compile Lambda21 and Lambda42.
static_assert(same_kernel<cambium::M4Prime, cambium::Lambda21>() && same_kernel<cambium::M6, cambium::Lambda42>());
static_assert(!same_kernel<cambium::M4Prime, cambium::Lambda22>());

/// C arrays of one length.
template <int C, class T>
struct Table {
  std::array<std::vector<T>, C> array;

  explicit Table(std::size_t size, T value = T(0)) {
    for (auto& a : array) a.assign(size, value);
  }
  std::size_t size() const { return array[0].size(); }
  cambium::Columns<C, T> write() {
    std::array<T*, C> first;
    for (int c = 0; c < C; ++c) first[c] = array[c].data();
    return {first, size()};
  }
  cambium::Columns<C, const T> read() const {
    std::array<const T*, C> first;
    for (int c = 0; c < C; ++c) first[c] = array[c].data();
    return {first, size()};
  }
  friend bool operator==(const Table&, const Table&) = default;
};

/// C arrays of random numbers in [lo, hi).
template <int C, class T>
Table<C, T> random_table(std::size_t size, double lo, double hi, unsigned seed) {
  Table<C, T> result(size);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> number(lo, hi);
  for (auto& array : result.array) {
    for (auto& value : array) value = static_cast<T>(number(generator));
  }
  return result;
}

/// What a mesh holds for C components of type T.
template <int C, class T>
using ValueOf = std::conditional_t<C == 1, T, cambium::Vec<C, T>>;

/// A lattice of the given numbers of nodes, away from the origin and with a spacing that is not a binary fraction.
/// Axis d is periodic if bit d of `periodic` is set.
template <int D>
cambium::Lattice<D> lattice_of(const cambium::Index<D>& nodes, unsigned periodic, double spacing = 0.07) {
  cambium::Box<D> box;
  std::array<bool, D> flags{};
  for (int d = 0; d < D; ++d) {
    flags[d] = (periodic >> d) % 2 == 1;
    box.lo[d] = -0.3 + 0.5 * d;
    box.hi[d] = box.lo[d] + spacing * static_cast<double>(nodes[d] - (flags[d] ? 0 : 1));
  }
  return {box, spacing, flags};
}

/// Random positions in the part [from, to) of the box along every axis (as fractions of its extent), on periodic axes
/// moved by whole periods at random.
template <int D, class P = double>
Table<D, P> random_positions(const cambium::Lattice<D>& lattice, std::size_t count, unsigned seed, double from = 0.0,
                             double to = 1.0) {
  auto result = random_table<D, P>(count, from, to, seed);
  for (int d = 0; d < D; ++d) {
    const double lo = lattice.box().lo[d];
    const double length = lattice.box().hi[d] - lo;
    for (std::size_t p = 0; p < count; ++p) {
      P& x = result.array[d][p];
      const double image = lattice.periodic(d) ? static_cast<double>((p * 7 + d) % 5) - 2.0 : 0.0;
      x = static_cast<P>(lo + length * (static_cast<double>(x) + image));
      if (!lattice.periodic(d) && static_cast<double>(x) > lattice.box().hi[d]) x = static_cast<P>(lattice.box().hi[d]);
      if (!lattice.periodic(d) && static_cast<double>(x) < lo) x = std::nextafter(x, static_cast<P>(1e9));
    }
  }
  return result;
}

/// Calls f(node) for every node of the lattice.
template <int D, class F>
void for_each_lattice_node(const cambium::Lattice<D>& lattice, F&& f) {
  for (std::size_t i = 0; i < lattice.size(); ++i) f(lattice.node(i));
}

}  // namespace support
