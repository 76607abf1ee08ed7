// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/columns.hpp>
#include <cambium/core/field.hpp>
#include <cambium/time/state.hpp>

namespace cambium {

/// std::vector and AlignedVector of numbers or Vecs.
template <class V, class Allocator>
struct StateTraits<std::vector<V, Allocator>> {
  using S = std::vector<V, Allocator>;
  using Stage = S;
  static constexpr bool is_view = false;
  static Stage make_stage(const S& state) { return state; }
  static S& view(S& stage) { return stage; }
  static const S& const_view(const S& state) { return state; }
  static bool same_shape(const S& stage, const S& state) { return stage.size() == state.size(); }
  static std::tuple<std::span<V>> arrays(S& state) { return {std::span<V>(state)}; }
  static std::tuple<std::span<const V>> arrays(const S& state) { return {std::span<const V>(state)}; }
};

/// Dense field: the values at all nodes.
template <class V, int D>
struct StateTraits<Field<V, D, Dense>> {
  using S = Field<V, D, Dense>;
  using Stage = S;
  static constexpr bool is_view = false;
  static Stage make_stage(const S& state) { return state; }
  static S& view(S& stage) { return stage; }
  static const S& const_view(const S& state) { return state; }
  static bool same_shape(const S& stage, const S& state) { return stage.lattice() == state.lattice(); }
  static std::tuple<std::span<V>> arrays(S& state) { return {state.values()}; }
  static std::tuple<std::span<const V>> arrays(const S& state) { return {state.values()}; }
};

/// View of a scalar attribute of particles, or of any array of numbers.
template <class V>
requires(!std::is_const_v<V>) struct StateTraits<std::span<V>> {
  using S = std::span<V>;
  using Stage = AlignedVector<V>;
  static constexpr bool is_view = true;
  static Stage make_stage(S state) { return Stage(state.begin(), state.end()); }
  static S view(Stage& stage) { return stage; }
  static std::span<const V> const_view(std::span<const V> state) { return state; }
  static bool same_shape(const Stage& stage, S state) { return stage.size() == state.size(); }
  static std::tuple<std::span<V>> arrays(S state) { return {state}; }
  static std::tuple<std::span<const V>> arrays(std::span<const V> state) { return {state}; }
};

/// View of the positions or a vector attribute of particles.
template <int C, class T>
requires(!std::is_const_v<T>) struct StateTraits<Columns<C, T>> {
  using S = Columns<C, T>;
  using Stage = std::array<AlignedVector<T>, C>;
  static constexpr bool is_view = true;
  static Stage make_stage(const S& state) {
    Stage stage;
    for (int c = 0; c < C; ++c) stage[c].assign(state.column(c).begin(), state.column(c).end());
    return stage;
  }
  static S view(Stage& stage) {
    std::array<T*, C> first;
    for (int c = 0; c < C; ++c) first[c] = stage[c].data();
    return S(first, stage[0].size());
  }
  static Columns<C, const T> const_view(const Columns<C, const T>& state) { return state; }
  static bool same_shape(const Stage& stage, const S& state) { return stage[0].size() == state.size(); }
  static auto arrays(const S& state) { return columns_of(state); }
  static auto arrays(const Columns<C, const T>& state) { return columns_of(state); }

 private:
  template <class U>
  static std::array<std::span<U>, C> columns_of(const Columns<C, U>& state) {
    std::array<std::span<U>, C> columns;
    for (int c = 0; c < C; ++c) columns[c] = state.column(c);
    return columns;
  }
};

/// Several states that are advanced together, e.g. positions and strengths: {particles.positions(), particles[mass]}.
/// Owners may be given as references: std::tie(a, b).
template <class... A>
requires(State<std::remove_cvref_t<A>>&&...) struct StateTraits<std::tuple<A...>> {
  template <class P>
  using Part = StateTraits<std::remove_cvref_t<P>>;

  using S = std::tuple<A...>;
  using Stage = std::tuple<typename Part<A>::Stage...>;
  using View = std::tuple<decltype(Part<A>::view(std::declval<typename Part<A>::Stage&>()))...>;
  using ConstView = std::tuple<decltype(Part<A>::const_view(std::declval<const std::remove_cvref_t<A>&>()))...>;
  static constexpr bool is_view = ((Part<A>::is_view || std::is_lvalue_reference_v<A>)&&...);

  static Stage make_stage(const S& state) {
    return std::apply([](const auto&... part) { return Stage(Part<decltype(part)>::make_stage(part)...); }, state);
  }
  static View view(Stage& stage) { return view(stage, std::index_sequence_for<A...>{}); }
  static ConstView const_view(const S& state) { return const_view(state, std::index_sequence_for<A...>{}); }
  static ConstView const_view(const View& state) requires(!std::same_as<S, View>) {
    return const_view(state, std::index_sequence_for<A...>{});
  }
  static bool same_shape(const Stage& stage, const S& state) {
    return same_shape(stage, state, std::index_sequence_for<A...>{});
  }
  template <class Parts>
  static auto arrays(Parts&& parts) {
    return arrays(parts, std::index_sequence_for<A...>{});
  }

 private:
  template <std::size_t... I>
  static View view(Stage& stage, std::index_sequence<I...>) {
    return View(Part<A>::view(std::get<I>(stage))...);
  }
  template <class Parts, std::size_t... I>
  static ConstView const_view(const Parts& parts, std::index_sequence<I...>) {
    return ConstView(Part<A>::const_view(std::get<I>(parts))...);
  }
  template <std::size_t... I>
  static bool same_shape(const Stage& stage, const S& state, std::index_sequence<I...>) {
    return (Part<A>::same_shape(std::get<I>(stage), std::get<I>(state)) && ...);
  }
  template <class Parts, std::size_t... I>
  static auto arrays(Parts& parts, std::index_sequence<I...>) {
    return std::tuple_cat(as_tuple(Part<A>::arrays(std::get<I>(parts)))...);
  }
  template <class... V>
  static std::tuple<V...> as_tuple(const std::tuple<V...>& arrays) {
    return arrays;
  }
  template <class V, std::size_t N>
  static auto as_tuple(const std::array<V, N>& arrays) {
    return std::tuple_cat(arrays);
  }
};

}  // namespace cambium
