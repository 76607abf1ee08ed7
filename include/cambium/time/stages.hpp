// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>

#include <cambium/core/error.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/time/state_adaptors.hpp>

namespace cambium::detail {

/// Memory of the shape of a state, made once and anew only when the shape of the state changes.
template <class S>
class StageBuffer {};

template <State S>
class StageBuffer<S> {
 public:
  void fit(const S& state) {
    if (!stage_ || !StateTraits<S>::same_shape(*stage_, state)) stage_.emplace(StateTraits<S>::make_stage(state));
  }
  decltype(auto) view() { return StateTraits<S>::view(*stage_); }

 private:
  std::optional<typename StateTraits<S>::Stage> stage_;
};

/// y[i] := sum_k weight[k] x_k[i]; y may be one of the x_k.
template <class E, class V, class... X>
void combine_array(const E& execution, std::span<V> y, const std::array<double, sizeof...(X)>& weight,
                   std::span<X>... x) {
  using T = ScalarOf<V>;
  const auto terms = [&]<std::size_t... I>(std::index_sequence<I...>, auto*... from) {
    V* const to = y.data();
    const std::array<T, sizeof...(X)> w{static_cast<T>(weight[I])...};
    for_each_piece(execution, y.size(), 4096, [&](std::size_t begin, std::size_t end) {
#if defined(_OPENMP)
#pragma omp simd
#endif
      for (std::size_t i = begin; i < end; ++i) to[i] = (... + (w[I] * from[i]));
    });
  };
  terms(std::index_sequence_for<X...>{}, x.data()...);
}

/// y := sum_k weight[k] x_k for all arrays of the states; y may be one of the x_k.
/// \throws SizeError, with y unchanged, if an array of one has another length than that of the others
template <class S, class E, class Y, class... X>
void combine(const E& execution, Y&& y, const std::array<double, sizeof...(X)>& weight, X&&... x) {
  const auto target = StateTraits<S>::arrays(y);
  const auto each = [&]<std::size_t... A>(std::index_sequence<A...>, const auto&... source) {
    const auto array = [&]<std::size_t N>(std::integral_constant<std::size_t, N>) {
      combine_array(execution, std::get<N>(target), weight, std::get<N>(source)...);
    };
    const auto check = [&](const auto& sizes) {
      (require_size(sizes[A], std::get<A>(target).size(), "an array of the derivative"), ...);
    };
    (check(sizes_of(source)), ...);
    (array(std::integral_constant<std::size_t, A>{}), ...);
  };
  each(std::make_index_sequence<std::tuple_size_v<std::remove_const_t<decltype(target)>>>{},
       StateTraits<S>::arrays(x)...);
}

/// \throws ValueError unless dt is positive and finite and t is finite
inline void require_step(double t, double dt) {
  if (!(dt > 0.0) || !std::isfinite(dt)) {
    throw ValueError(detail::message("time step is ", dt, " at time ", t,
                                     ": it must be positive and finite; check the limits it was computed from"));
  }
  if (!std::isfinite(t)) throw ValueError(detail::message("time is ", t, ": it must be finite"));
}

/// Checks at compile time that `rhs` can be called as rhs(state, t, derivative); true if it can, and S is a state.
template <class S, class F>
consteval bool check_rhs() {
  if constexpr (State<S>) {
    using View = decltype(StateTraits<S>::view(std::declval<typename StateTraits<S>::Stage&>()));
    using ConstView = decltype(StateTraits<S>::const_view(std::declval<const S&>()));
    constexpr bool callable = std::invocable<F&, ConstView, double, View>;
    static_assert(callable,
                  "cambium: a right-hand side is callable as rhs(state, t, derivative): it reads the state (by const "
                  "reference or const view) and writes every entry of the derivative; see docs/concepts/State.md");
    return callable;
  } else {
    return false;
  }
}

}  // namespace cambium::detail
