// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/kernels/lambda21.hpp>
#include <cambium/kernels/lambda22.hpp>
#include <cambium/kernels/lambda42.hpp>
#include <cambium/kernels/lambda44.hpp>
#include <cambium/kernels/lambda64.hpp>
#include <cambium/kernels/lambda84.hpp>

namespace cambium {

namespace detail {

template <int...>
inline constexpr bool never = false;

template <int P, int R>
struct LambdaKernel {
  using type = Lambda21;  // a kernel, so that the message below is not followed by others
  static_assert(never<P, R>,
                "cambium: there is no kernel Lambda<p, r> with these numbers: choose Lambda<2, 1>, <2, 2>, <4, 2>, "
                "<4, 4>, <6, 4> or <8, 4> (the construction needs p even and p <= 2 r + 1)");
};
template <>
struct LambdaKernel<2, 1> {
  using type = Lambda21;
};
template <>
struct LambdaKernel<2, 2> {
  using type = Lambda22;
};
template <>
struct LambdaKernel<4, 2> {
  using type = Lambda42;
};
template <>
struct LambdaKernel<4, 4> {
  using type = Lambda44;
};
template <>
struct LambdaKernel<6, 4> {
  using type = Lambda64;
};
template <>
struct LambdaKernel<8, 4> {
  using type = Lambda84;
};

}  // namespace detail

/// The kernel Lambda_{P,R}: reproduces polynomials up to degree P and is in C^R; P + 2 points.
template <int P, int R>
using Lambda = typename detail::LambdaKernel<P, R>::type;

}  // namespace cambium
