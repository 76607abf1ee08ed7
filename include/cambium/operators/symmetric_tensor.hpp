// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/operators/columns_of.hpp>
#include <cambium/particles/validation.hpp>

namespace cambium {

/// A symmetric D x D tensor as its upper triangle row by row: xx | xx xy yy | xx xy xz yy yz zz.
template <int D>
using SymmetricTensor = Vec<D*(D + 1) / 2>;

/// The tensor `value` times the identity.
template <int D>
constexpr SymmetricTensor<D> isotropic_tensor(double value) {
  SymmetricTensor<D> result;
  for (int i = 0, k = 0; i < D; k += D - i, ++i) result[k] = value;
  return result;
}

namespace detail {

/// r^T (K - tr(K) / (D + 2)) r: the quadratic form whose exchange integral is div(K grad). With fourth moments
/// int z_i z_j z_k z_l phi = delta_ij delta_kl + two permutations, a form M gives M + tr(M) / 2, and that is K.
/// (Degond & Mas-Gallic, The weighted particle method for convection-diffusion equations II, Math. Comp. 53 (1989) 509)
template <int D>
double exchange_form(const SymmetricTensor<D>& tensor, const Vec<D>& r) {
  double form = 0.0;
  double trace = 0.0;
  for (int i = 0, k = 0; i < D; ++i) {
    trace += tensor[k];
    form += tensor[k++] * r[i] * r[i];
    for (int j = i + 1; j < D; ++j) form += 2.0 * tensor[k++] * r[i] * r[j];
  }
  return form - trace / (D + 2) * dot(r, r);
}

/// The tensor of a pair of particles, from one tensor for all or one for each.
template <int D, class Tensor>
class TensorOf {
 public:
  template <class Out>
  TensorOf(const Tensor& tensor, std::size_t size, const Out& out) : tensor_(const_columns_of(tensor)) {
    static_assert(decltype(tensor_)::count == D * (D + 1) / 2,
                  "cambium: a diffusion tensor has D (D + 1) / 2 components, its upper triangle row by row");
    require_size(tensor_.size(), size, "the array of diffusion tensors");
    cambium::require_finite(tensor_, "diffusion tensor");
    require_distinct(tensor_, out);
  }
  SymmetricTensor<D> mean(std::size_t p, std::size_t q) const {
    SymmetricTensor<D> result;
    for (int k = 0; k < D * (D + 1) / 2; ++k) {
      result[k] = 0.5 * (static_cast<double>(tensor_.column(k)[p]) + static_cast<double>(tensor_.column(k)[q]));
    }
    return result;
  }

 private:
  decltype(const_columns_of(std::declval<const Tensor&>())) tensor_;
};
template <int D>
class TensorOf<D, SymmetricTensor<D>> {
 public:
  template <class Out>
  TensorOf(const SymmetricTensor<D>& tensor, std::size_t, const Out&) : tensor_(tensor) {
    for (int k = 0; k < D * (D + 1) / 2; ++k) {
      if (!std::isfinite(tensor[k])) {
        throw ValueError(message("diffusion tensor ", tensor, " has component ", k, " that is not finite"));
      }
    }
  }
  const SymmetricTensor<D>& mean(std::size_t, std::size_t) const { return tensor_; }

 private:
  SymmetricTensor<D> tensor_;
};

}  // namespace detail
}  // namespace cambium
