// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/// \file
/// Writing past the caches: for large arrays that are written whole and not read soon. A cache line is then not read
/// from memory only to be overwritten, and pushes nothing else out. On machines without such stores these are plain.

namespace cambium::simd {

inline constexpr std::size_t stream_bytes = 64;

inline bool can_stream_to(const void* to) { return reinterpret_cast<std::uintptr_t>(to) % stream_bytes == 0; }

/// Writes 64 bytes to an address that can_stream_to() accepts.
inline void stream_line(const void* from, void* to) {
#if defined(__SSE2__)
  const auto* source = static_cast<const __m128i*>(from);
  auto* target = static_cast<__m128i*>(to);
  for (int k = 0; k < 4; ++k) _mm_stream_si128(target + k, _mm_loadu_si128(source + k));
#else
  std::memcpy(to, from, stream_bytes);
#endif
}

/// To be called after the last of several streams, before another thread reads what they wrote.
inline void finish_streams() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

/// std::copy_n past the caches.
template <class T>
void stream_copy(const T* from, std::size_t count, T* to) {
  constexpr std::size_t line = stream_bytes / sizeof(T);
  std::size_t i = 0;
  for (; i < count && !can_stream_to(to + i); ++i) to[i] = from[i];
  for (; i + line <= count; i += line) stream_line(from + i, to + i);
  for (; i < count; ++i) to[i] = from[i];
}

/// std::fill_n past the caches.
template <class T>
void stream_fill(T* to, std::size_t count, T value) {
  std::array<T, stream_bytes / sizeof(T)> line;
  line.fill(value);
  std::size_t i = 0;
  for (; i < count && !can_stream_to(to + i); ++i) to[i] = value;
  for (; i + line.size() <= count; i += line.size()) stream_line(line.data(), to + i);
  for (; i < count; ++i) to[i] = value;
}

}  // namespace cambium::simd
