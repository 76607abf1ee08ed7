// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <benchmark/benchmark.h>
#include <cmath>
#include <memory>
#include <type_traits>

#include <cambium/interpolation.hpp>

#include "interpolation/options.hpp"
#include "plain/loop.hpp"
#include "support/scene.hpp"
#include "support/user_loop.hpp"

namespace bench {

/// The library at work on a cloud: placed once, or with the order to be found in every call.
template <class K, int D, class T, int C, bool placed>
struct LibraryRun {
  using Value = std::conditional_t<C == 1, T, cambium::Vec<C, T>>;

  explicit LibraryRun(std::shared_ptr<Lazy<Cloud<D, T>>> from) : cloud(from), mesh((*from)->lattice) {
    std::array<T*, C> first;
    for (int c = 0; c < C; ++c) {
      value[c].resize(mesh.size());
      first[c] = value[c].data();
    }
    values = cambium::Columns<C, T>(first, mesh.size());
    mesh.sample([](const cambium::Vec<D>& x) {
      Value result{};
      for (int c = 0; c < C; ++c) cambium::component(result, c) = static_cast<T>(std::sin(x[0] + c));
      return result;
    });
  }
  void operator()(Way way, int threads) {
    const cambium::OpenMP execution{threads};
    if constexpr (placed) {
      if (placement.size() == 0) placement.update(mesh.lattice(), (*cloud)->positions(), execution);
      if (way == Way::p2m) {
        interpolator.p2m(placement, (*cloud)->template strengths<C>(), mesh, execution);
      } else {
        interpolator.m2p(mesh, placement, values, execution);
      }
    } else if (way == Way::p2m) {
      interpolator.p2m((*cloud)->positions(), (*cloud)->template strengths<C>(), mesh, execution);
    } else {
      interpolator.m2p(mesh, (*cloud)->positions(), values, execution);
    }
  }

  std::shared_ptr<Lazy<Cloud<D, T>>> cloud;
  cambium::Field<Value, D> mesh;
  std::array<cambium::AlignedVector<T>, C> value;
  cambium::Columns<C, T> values;
  cambium::Interpolator<K> interpolator;
  cambium::Placement<K, D, T> placement;
};

/// A plain loop at work on a cloud.
template <CompiledBy compiler, class K, int D, class T>
struct PlainRun {
  using Loop = PlainLoop<compiler, K, D, T>;

  explicit PlainRun(std::shared_ptr<Lazy<Cloud<D, T>>> from) : cloud(from) {
    const auto nodes = static_cast<double>(Loop::nodes((*from)->lattice.nodes()[0]));
    mesh.assign(static_cast<std::size_t>(std::pow(nodes, D)), T(1));
    value.resize((*from)->lattice.size());
  }
  void operator()(Way way) {
    const Cloud<D, T>& from = **cloud;
    const std::ptrdiff_t n = from.lattice.nodes()[0];
    if (way == Way::p2m) {
      Loop::p2m(from.pointers(), from.strength[0].data(), value.size(), n, mesh.data());
    } else {
      Loop::m2p(from.pointers(), value.data(), value.size(), n, mesh.data());
    }
  }

  std::shared_ptr<Lazy<Cloud<D, T>>> cloud;
  cambium::AlignedVector<T> mesh;
  cambium::AlignedVector<T> value;
};

template <class K, int D, class T>
struct UserRun {
  explicit UserRun(std::shared_ptr<Lazy<Cloud<D, T>>> from)
      : cloud(from), mesh((*from)->lattice.size(), T(1)), value(mesh.size()) {
    int support = K::support;
    benchmark::DoNotOptimize(support);
    loop = std::make_unique<UserLoop<K, D, T>>((*from)->lattice, support);
  }
  void operator()(Way way) {
    const Cloud<D, T>& from = **cloud;
    if (way == Way::p2m) {
      loop->p2m(from.positions(), from.strength[0].data(), mesh.data());
    } else {
      loop->m2p(mesh.data(), from.positions(), value.data());
    }
  }

  std::shared_ptr<Lazy<Cloud<D, T>>> cloud;
  cambium::AlignedVector<T> mesh;
  cambium::AlignedVector<T> value;
  std::unique_ptr<UserLoop<K, D, T>> loop;
};

}  // namespace bench
