// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Compiled by the compiler of the build and, where there is one, by clang++ too; PLAIN_LOOP_COMPILER is 0 and 1.
#include "loop.hpp"

#include <algorithm>

#include <cambium/kernels.hpp>
#include <cambium/kernels/taps.hpp>

namespace bench {

namespace {

/// First node and weights of one particle along one axis. Of this file alone, so that the linker cannot take it from
/// another compiler.
template <class K, class T>
struct Stencil {
  std::ptrdiff_t first;
  T weight[K::support];

  Stencil(T x, T n) {
    using Taps = cambium::Taps<K>;
    const T u = x * n + static_cast<T>(Taps::shift);
    const int cell = static_cast<int>(u);
    const T g = u - static_cast<T>(cell) - T(0.5);
    first = cell;
    for (int k = 0; k < K::support; ++k) weight[k] = static_cast<T>(Taps::coefficients.value[Taps::degree][k]);
    for (int j = Taps::degree - 1; j >= 0; --j) {
      for (int k = 0; k < K::support; ++k) {
        weight[k] = weight[k] * g + static_cast<T>(Taps::coefficients.value[j][k]);
      }
    }
  }
};

}  // namespace

template <CompiledBy compiler, class K, int D, class T>
void PlainLoop<compiler, K, D, T>::p2m(const std::array<const T*, D>& x, const T* strength, std::size_t count,
                                       std::ptrdiff_t n, T* __restrict mesh) {
  const std::ptrdiff_t pitch = nodes(n);
  const T scale = static_cast<T>(n);
  std::fill_n(mesh, pitch * pitch * (D == 3 ? pitch : 1), T(0));
  for (std::size_t p = 0; p < count; ++p) {
    const Stencil<K, T> a(x[0][p], scale);
    const Stencil<K, T> b(x[1][p], scale);
    if constexpr (D == 2) {
      T* row = mesh + b.first * pitch + a.first;
      for (int j = 0; j < K::support; ++j, row += pitch) {
        const T q = strength[p] * b.weight[j];
        for (int i = 0; i < K::support; ++i) row[i] += q * a.weight[i];
      }
    } else {
      const Stencil<K, T> c(x[2][p], scale);
      T* plane = mesh + (c.first * pitch + b.first) * pitch + a.first;
      for (int k = 0; k < K::support; ++k, plane += pitch * pitch) {
        const T along = strength[p] * c.weight[k];
        for (int j = 0; j < K::support; ++j) {
          const T q = along * b.weight[j];
          for (int i = 0; i < K::support; ++i) plane[j * pitch + i] += q * a.weight[i];
        }
      }
    }
  }
}

template <CompiledBy compiler, class K, int D, class T>
void PlainLoop<compiler, K, D, T>::m2p(const std::array<const T*, D>& x, T* __restrict value, std::size_t count,
                                       std::ptrdiff_t n, const T* mesh) {
  const std::ptrdiff_t pitch = nodes(n);
  const T scale = static_cast<T>(n);
  for (std::size_t p = 0; p < count; ++p) {
    const Stencil<K, T> a(x[0][p], scale);
    const Stencil<K, T> b(x[1][p], scale);
    T total(0);
    if constexpr (D == 2) {
      const T* row = mesh + b.first * pitch + a.first;
      for (int j = 0; j < K::support; ++j, row += pitch) {
        T sum(0);
        for (int i = 0; i < K::support; ++i) sum += a.weight[i] * row[i];
        total += b.weight[j] * sum;
      }
    } else {
      const Stencil<K, T> c(x[2][p], scale);
      const T* plane = mesh + (c.first * pitch + b.first) * pitch + a.first;
      for (int k = 0; k < K::support; ++k, plane += pitch * pitch) {
        T along(0);
        for (int j = 0; j < K::support; ++j) {
          T sum(0);
          for (int i = 0; i < K::support; ++i) sum += a.weight[i] * plane[j * pitch + i];
          along += b.weight[j] * sum;
        }
        total += c.weight[k] * along;
      }
    }
    value[p] = total;
  }
}

namespace {

constexpr auto compiled_by = static_cast<CompiledBy>(PLAIN_LOOP_COMPILER);

}  // namespace

using namespace cambium;
template struct PlainLoop<compiled_by, Hat, 2, double>;
template struct PlainLoop<compiled_by, Hat, 3, double>;
template struct PlainLoop<compiled_by, Hat, 2, float>;
template struct PlainLoop<compiled_by, Hat, 3, float>;
template struct PlainLoop<compiled_by, M3, 2, double>;
template struct PlainLoop<compiled_by, M3, 3, double>;
template struct PlainLoop<compiled_by, M3, 2, float>;
template struct PlainLoop<compiled_by, M3, 3, float>;
template struct PlainLoop<compiled_by, M4, 2, double>;
template struct PlainLoop<compiled_by, M4, 3, double>;
template struct PlainLoop<compiled_by, M4, 2, float>;
template struct PlainLoop<compiled_by, M4, 3, float>;
template struct PlainLoop<compiled_by, M4Prime, 2, double>;
template struct PlainLoop<compiled_by, M4Prime, 3, double>;
template struct PlainLoop<compiled_by, M4Prime, 2, float>;
template struct PlainLoop<compiled_by, M4Prime, 3, float>;
template struct PlainLoop<compiled_by, M6, 2, double>;
template struct PlainLoop<compiled_by, M6, 3, double>;
template struct PlainLoop<compiled_by, M6, 2, float>;
template struct PlainLoop<compiled_by, M6, 3, float>;
template struct PlainLoop<compiled_by, M6TriplePrime, 2, double>;
template struct PlainLoop<compiled_by, M6TriplePrime, 3, double>;
template struct PlainLoop<compiled_by, M6TriplePrime, 2, float>;
template struct PlainLoop<compiled_by, M6TriplePrime, 3, float>;
template struct PlainLoop<compiled_by, Lambda<2, 2>, 2, double>;
template struct PlainLoop<compiled_by, Lambda<2, 2>, 3, double>;
template struct PlainLoop<compiled_by, Lambda<2, 2>, 2, float>;
template struct PlainLoop<compiled_by, Lambda<2, 2>, 3, float>;
template struct PlainLoop<compiled_by, Lambda<4, 4>, 2, double>;
template struct PlainLoop<compiled_by, Lambda<4, 4>, 3, double>;
template struct PlainLoop<compiled_by, Lambda<4, 4>, 2, float>;
template struct PlainLoop<compiled_by, Lambda<4, 4>, 3, float>;
template struct PlainLoop<compiled_by, Lambda<6, 4>, 2, double>;
template struct PlainLoop<compiled_by, Lambda<6, 4>, 3, double>;
template struct PlainLoop<compiled_by, Lambda<6, 4>, 2, float>;
template struct PlainLoop<compiled_by, Lambda<6, 4>, 3, float>;
template struct PlainLoop<compiled_by, Lambda<8, 4>, 2, double>;
template struct PlainLoop<compiled_by, Lambda<8, 4>, 3, double>;
template struct PlainLoop<compiled_by, Lambda<8, 4>, 2, float>;
template struct PlainLoop<compiled_by, Lambda<8, 4>, 3, float>;

}  // namespace bench
