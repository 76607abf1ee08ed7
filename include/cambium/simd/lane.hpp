// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include <cambium/simd/pack.hpp>

namespace cambium::simd {

namespace detail {

/// Vectors of `bytes` bytes in the compilers' own notation, whose shuffles xsimd does not offer for every machine.
template <class T, std::size_t Bytes>
struct WideVector {
  using Integer = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
  static constexpr std::size_t lanes = Bytes / sizeof(T);
  using Values [[gnu::vector_size(Bytes)]] = T;
  using Bits [[gnu::vector_size(Bytes)]] = Integer;

  static Values load(const T* from) {
    Values v;
    std::memcpy(&v, from, Bytes);
    return v;
  }
  static Bits load_bits(const T* from) {
    Bits v;
    std::memcpy(&v, from, Bytes);
    return v;
  }
  /// All bits but those of one lane of each node of W lanes.
  template <std::size_t W>
  static Bits mask_without(std::size_t lane) {
    std::array<Integer, lanes> others;
    for (std::size_t l = 0; l < lanes; ++l) others[l] = l % W == lane ? 0 : -1;
    Bits mask;
    std::memcpy(&mask, others.data(), Bytes);
    return mask;
  }
};

/// Entry 0, W, 2 W, ... of two vectors.
template <std::size_t W, class V, std::size_t... I>
auto every(V a, V b, std::index_sequence<I...>) {
  return __builtin_shufflevector(a, b, static_cast<int>(I * W)...);
}

/// Entry First, W times, then the next one, W times, ...
template <std::size_t W, std::size_t First, class V, std::size_t... I>
auto repeat(V a, std::index_sequence<I...>) {
  return __builtin_shufflevector(a, a, static_cast<int>(First + I / W)...);
}

}  // namespace detail

/// Moves one lane out of a row of nodes of W lanes each: out[i] := nodes[i W + lane] and nodes[i W + lane] := 0.
///
/// Where two or more nodes fit a vector of 64 bytes, the lane is collected by shuffles and cleared by a mask: five
/// stores for eight nodes instead of sixteen. `nodes` must be readable up to one vector beyond the last node.
template <std::size_t W, class T>
void take_lane(T* nodes, std::size_t lane, std::size_t count, T* out) {
  std::size_t i = 0;
  if constexpr (2 * W * sizeof(T) <= 64 && detail::widest<T, 64 / sizeof(T)>() * sizeof(T) == 64) {
    using Wide = detail::WideVector<T, 64>;
    constexpr std::size_t held = Wide::lanes / W;  // nodes in a vector
    const auto keep = Wide::template mask_without<W>(lane);
    for (; i + 2 * held <= count; i += 2 * held) {
      T* first = nodes + i * W;
      T* second = first + Wide::lanes;
      const auto taken =
          detail::every<W>(Wide::load(first + lane), Wide::load(second + lane), std::make_index_sequence<2 * held>{});
      std::memcpy(out + i, &taken, sizeof(taken));
      const auto low = Wide::load_bits(first) & keep;
      const auto high = Wide::load_bits(second) & keep;
      std::memcpy(first, &low, 64);
      std::memcpy(second, &high, 64);
    }
  }
  for (; i < count; ++i) out[i] = std::exchange(nodes[i * W + lane], T(0));
}

/// Puts values into one lane of a row of nodes of W lanes each: nodes[i W + lane] := values[i].
template <std::size_t W, class T>
void put_lane(const T* values, std::size_t lane, std::size_t count, T* nodes) {
  std::size_t i = 0;
  if constexpr (2 * W * sizeof(T) <= 64 && detail::widest<T, 64 / sizeof(T)>() * sizeof(T) == 64) {
    using Wide = detail::WideVector<T, 64>;
    constexpr std::size_t held = Wide::lanes / W;  // nodes in a vector
    const auto keep = Wide::template mask_without<W>(lane);
    for (; i + Wide::lanes <= count; i += Wide::lanes) {
      const auto put = Wide::load_bits(values + i);
      const auto one = [&]<std::size_t Q>(std::integral_constant<std::size_t, Q>) {
        T* to = nodes + i * W + Q * Wide::lanes;
        const auto spread = detail::repeat<W, Q * held>(put, std::make_index_sequence<Wide::lanes>{});
        const auto mixed = (Wide::load_bits(to) & keep) | (spread & ~keep);
        std::memcpy(to, &mixed, 64);
      };
      [&]<std::size_t... Q>(std::index_sequence<Q...>) { (one(std::integral_constant<std::size_t, Q>{}), ...); }
      (std::make_index_sequence<W>{});
    }
  }
  for (; i < count; ++i) {
    __builtin_prefetch(nodes + (i + 16) * W, 1);  // stores do not make the processor fetch ahead
    nodes[i * W + lane] = values[i];
  }
}

}  // namespace cambium::simd
