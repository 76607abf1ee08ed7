// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <utility>

#include <cambium/simd/stream.hpp>

namespace cambium::simd {

namespace detail {

/// Exchanges the two off-diagonal quarters of every block of 2 S x 2 S entries of two rows that are S apart.
template <std::size_t S, class V, std::size_t... J>
[[gnu::always_inline]] inline void exchange_quarters(V& upper, V& lower, std::index_sequence<J...>) {
  constexpr std::size_t lanes = sizeof...(J);
  const V above = upper;
  upper = __builtin_shufflevector(above, lower, static_cast<int>(J & S ? lanes + J - S : J)...);
  lower = __builtin_shufflevector(above, lower, static_cast<int>(J & S ? lanes + J : J + S)...);
}

template <std::size_t S, std::size_t L, class V>
[[gnu::always_inline]] inline void transpose_blocks(V (&row)[L]) {
  if constexpr (S < L) {
    for (std::size_t i = 0; i < L; ++i) {
      if ((i & S) == 0) exchange_quarters<S>(row[i], row[i + S], std::make_index_sequence<L>{});
    }
    transpose_blocks<2 * S>(row);
  }
}

}  // namespace detail

/// Transposes L x L entries through registers: to[j to_pitch + i] := from[i from_pitch + j], L a power of two. If
/// `stream`, rows that are whole cache lines are written past the caches; finish_streams() must follow.
template <std::size_t L, class T>
void transpose(const T* from, std::ptrdiff_t from_pitch, T* to, std::ptrdiff_t to_pitch, bool stream = false) {
  using Row [[gnu::vector_size(L * sizeof(T))]] = T;
  Row row[L];
  for (std::size_t i = 0; i < L; ++i)
    std::memcpy(&row[i], from + static_cast<std::ptrdiff_t>(i) * from_pitch, sizeof(Row));
  detail::transpose_blocks<1>(row);
  for (std::size_t j = 0; j < L; ++j, to += to_pitch) {
    if (sizeof(Row) == stream_bytes && stream && can_stream_to(to)) {
      stream_line(&row[j], to);
    } else {
      std::memcpy(to, &row[j], sizeof(Row));
    }
  }
}

}  // namespace cambium::simd
