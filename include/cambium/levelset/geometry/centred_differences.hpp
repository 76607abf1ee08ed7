// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/levelset/geometry/difference_geometry.hpp>
#include <cambium/operators/difference_weights.hpp>

namespace cambium {

/// Normals and curvatures of the level set through each node by centred differences of order 2 or 4; mixed derivatives
/// are products of first ones.
///
/// Where phi has a ridge within the stencil (two fronts 2 Order spacings apart or less) the normal is the average of
/// two sides: see RidgeAware.
template <int Order>
struct CentredDifferences {
  static_assert(Order == 2 || Order == 4, "cambium: geometry by centred differences has order 2 or 4");
  struct Params {};
  static constexpr int reach = Order / 2;
  template <class T, int D>
  using Method = detail::DifferenceGeometry<CentredDifferences, T, D>;

  /// Derivatives in spacings. \param at  the node in an array of values with strides `stride`
  template <class T, int D>
  static Jet<T, D> jet(const Params&, const T* at, const Index<D>& stride) {
    Jet<T, D> result;
    result.value = *at;
    for (int d = 0; d < D; ++d) {
      result.gradient[d] = first(at, stride[d]);
      T second{};
      for (int k = 0; k <= Order; ++k) second += weight<T>(2, k) * (at[(k - reach) * stride[d]] - *at);
      result.hessian[d][d] = second;
      for (int e = 0; e < d; ++e) {
        T mixed{};
        for (int k = 0; k <= Order; ++k) {
          if (k != reach) mixed += weight<T>(1, k) * first(at + (k - reach) * stride[d], stride[e]);
        }
        result.hessian[d][e] = result.hessian[e][d] = mixed;
      }
    }
    return result;
  }

 private:
  template <class T>
  static constexpr T weight(int derivative, int k) {
    const auto at = static_cast<std::size_t>(k);
    return static_cast<T>(derivative == 1 ? DifferenceTable<Order, 1>::centred[at]
                                          : DifferenceTable<Order, 2>::centred[at]);
  }
  template <class T>
  static T first(const T* at, std::ptrdiff_t stride) {
    T sum{};
    for (int k = 1; k <= reach; ++k) sum += weight<T>(1, reach + k) * (at[k * stride] - at[-k * stride]);
    return sum;
  }
};

}  // namespace cambium
