// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace cambium {

/// Allocator of arrays that start on a cache line, and of large ones (4 MiB and more) on a huge page.
/// Huge pages cut the cost of address translation for stencils that touch many rows.
template <class T>
class AlignedAllocator {
 public:
  using value_type = T;

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  /// \throws std::bad_array_new_length if the bytes cannot be counted; std::bad_alloc if there is no memory
  T* allocate(std::size_t count) {
    if (count > most_bytes / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    const std::size_t alignment = bytes >= huge_from ? huge_page : cache_line;
    void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    if (bytes >= huge_from) (void)madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }

  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }

 private:
  static constexpr std::size_t cache_line = 64;
  static constexpr std::size_t huge_page = std::size_t{2} << 20;
  static constexpr std::size_t most_bytes = std::numeric_limits<std::ptrdiff_t>::max() - huge_page;
  static constexpr std::size_t huge_from = std::size_t{4} << 20;
};

/// A std::vector whose first entry is aligned for vector loads.
template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace cambium
