// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>

#include <cambium/parallel/execution.hpp>
#include <cambium/time/state_adaptors.hpp>

namespace cambium::detail {

/// Sum of f(number of x, number of y, ...) over all numbers of states of one shape; the same bits for any number of
/// threads.
template <class S, class E, class F, class First, class... X>
double sum_numbers(const E& execution, F&& f, const First& first, const X&... x) {
  const auto arrays = StateTraits<S>::arrays(first);
  double total = 0.0;
  const auto add = [&]<std::size_t N>(std::integral_constant<std::size_t, N>, const auto& array, const auto&... more) {
    using V = std::remove_const_t<typename std::remove_cvref_t<decltype(array)>::element_type>;
    total += reduce(
        execution, array.size(), 0.0,
        [&](std::size_t i) {
          double sum = 0.0;
          for (int c = 0; c < Components<V>::count; ++c) {
            sum += f(static_cast<double>(component(array[i], c)), static_cast<double>(component(more[i], c))...);
          }
          return sum;
        },
        std::plus<>{});
  };
  const auto each = [&]<std::size_t... A>(std::index_sequence<A...>, const auto&... source) {
    const auto one = [&]<std::size_t N>(std::integral_constant<std::size_t, N> index) {
      add(index, std::get<N>(arrays), std::get<N>(source)...);
    };
    (one(std::integral_constant<std::size_t, A>{}), ...);
  };
  each(std::make_index_sequence<std::tuple_size_v<std::remove_const_t<decltype(arrays)>>>{},
       StateTraits<S>::arrays(x)...);
  return total;
}

/// How many numbers a state has.
template <class S>
std::size_t count_numbers(const S& state) {
  std::size_t count = 0;
  std::apply(
      [&](const auto&... array) {
        ((count +=
          array.size() *
          static_cast<std::size_t>(
              Components<std::remove_const_t<typename std::remove_cvref_t<decltype(array)>::element_type>>::count)),
         ...);
      },
      StateTraits<S>::arrays(state));
  return count;
}

/// Euclidean norm of all numbers.
template <class S, class E, class X>
double length(const E& execution, const X& x) {
  return std::sqrt(sum_numbers<S>(
      execution, [](double a) { return a * a; }, x));
}

}  // namespace cambium::detail
