// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

#include <cambium/core/vec.hpp>

namespace cambium {

/// How a type takes part in time stepping. Specialised for containers, fields, views of particle data and tuples in
/// state_adaptors.hpp, and below for every copyable struct that has a member arrays(). A specialisation has
///   Stage                        owns data of the shape of a state
///   is_view                      true if copying S copies a reference to data that live elsewhere
///   make_stage(state)            a Stage of the shape of `state`
///   view(stage), const_view(x)   what a right-hand side is given to write to and to read from
///   same_shape(stage, state)     true if `stage` needs no new memory to hold `state`
///   arrays(x)                    std::tuple or std::array of the std::span that hold all numbers of a state or view
template <class S>
struct StateTraits {};

namespace detail {

/// Number of entries of each array of a state, in order.
template <class Arrays>
constexpr auto sizes_of(const Arrays& arrays) {
  return std::apply([](const auto&... array) { return std::array<std::size_t, sizeof...(array)>{array.size()...}; },
                    arrays);
}

template <class V>
inline constexpr bool is_floating_value = std::is_floating_point_v<V>;
template <int C, class T>
inline constexpr bool is_floating_value<Vec<C, T>> = std::is_floating_point_v<T>;

template <class Arrays>
struct HoldsFloating : std::false_type {};
template <class... V, std::size_t... N>
struct HoldsFloating<std::tuple<std::span<V, N>...>> : std::bool_constant<(is_floating_value<V> && ...)> {};
template <class V, std::size_t N, std::size_t Count>
struct HoldsFloating<std::array<std::span<V, N>, Count>> : std::bool_constant<is_floating_value<V>> {};

template <class S>
concept HasArrays = std::copyable<S> && requires(S& state, const S& constant) {
  std::tuple_size<decltype(state.arrays())>::value;
  std::tuple_size<decltype(constant.arrays())>::value;
};

}  // namespace detail

/// A copyable struct whose arrays() and arrays() const give a tuple of std::span over its numbers.
template <detail::HasArrays S>
struct StateTraits<S> {
  using Stage = S;
  static constexpr bool is_view = false;
  static Stage make_stage(const S& state) { return state; }
  static S& view(S& stage) { return stage; }
  static const S& const_view(const S& state) { return state; }
  static bool same_shape(const S& stage, const S& state) {
    return detail::sizes_of(stage.arrays()) == detail::sizes_of(state.arrays());
  }
  static auto arrays(S& state) { return state.arrays(); }
  static auto arrays(const S& state) { return state.arrays(); }
};

/// What a stepper can advance in time: arrays of numbers that can be combined without allocation.
template <class S>
concept State = requires(S& state, const S& constant, typename StateTraits<S>::Stage& stage) {
  { StateTraits<S>::is_view } -> std::convertible_to<bool>;
  { StateTraits<S>::make_stage(constant) } -> std::same_as<typename StateTraits<S>::Stage>;
  { StateTraits<S>::same_shape(std::as_const(stage), constant) } -> std::same_as<bool>;
  StateTraits<S>::view(stage);
  StateTraits<S>::const_view(constant);
  StateTraits<S>::arrays(state);
  StateTraits<S>::arrays(constant);
};

namespace detail {

/// False also for what is no state, so that check_state() has the first word.
template <class S>
consteval bool is_view() {
  if constexpr (State<S>) {
    return StateTraits<S>::is_view;
  } else {
    return false;
  }
}

}  // namespace detail

/// How a state is handed to step(): views by value or temporary (they refer to the data), owners by reference.
template <class S>
using StateArgument = std::conditional_t<detail::is_view<S>(), const S&, S&>;

/// Checks at compile time that S can be stepped in time, one readable message for each requirement.
template <class S>
constexpr void check_state() {
  static_assert(State<S>,
                "cambium: a state is a std::vector, AlignedVector, Field, std::span or Columns of mutable data, a "
                "std::tuple of these, or a copyable struct with arrays() and arrays() const that return a tuple of "
                "std::span; see docs/concepts/State.md");
  if constexpr (State<S>) {
    static_assert(detail::HoldsFloating<decltype(StateTraits<S>::arrays(std::declval<S&>()))>::value,
                  "cambium: every array of a state is a std::span of float, double, or Vec of them");
  }
}

}  // namespace cambium
