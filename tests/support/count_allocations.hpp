// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

// Replaces operator new of a test program by one that counts: for one source file of a program.

namespace support {

inline std::atomic<std::size_t> allocations{0};
inline std::atomic<std::size_t> allocated_bytes{0};

/// What is counted of `n` allocations: none under the thread sanitizer of clang, whose own operators come first.
constexpr std::size_t counted(std::size_t n) {
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
  return 0 * n;
#endif
#endif
  return n;
}

inline void note_allocation(std::size_t bytes) {
  ++allocations;
  allocated_bytes += bytes;
}

}  // namespace support

// Not inlined: g++ 12 warns of new and delete that do not match where it sees through one of them alone.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  support::note_allocation(bytes);
  if (void* memory = std::malloc(bytes)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
  support::note_allocation(bytes);
  const auto to = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(to, (bytes + to - 1) / to * to)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
