// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

// The compiler's own AVX-512 functions start from a register they leave undefined on purpose, of which g++ 12 warns
// (GCC bug 105593).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <xsimd/xsimd.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

namespace cambium::simd {

namespace detail {

/// Number of lanes of the widest hardware vector of T that divides N, or 1 if there is none.
template <class T, std::size_t N>
constexpr std::size_t widest() {
  if constexpr (N <= 1) {
    return 1;
  } else if constexpr (!std::is_void_v<xsimd::make_sized_batch_t<T, N>>) {
    return N;
  } else {
    return widest<T, N / 2>();
  }
}

}  // namespace detail

/// N lanes of T, N a power of two. One hardware vector where there is one of that size, several or plain scalars
/// otherwise: code written for N lanes runs on every machine.
template <class T, std::size_t N>
class Pack {
 public:
  static_assert(N > 0 && (N & (N - 1)) == 0, "cambium::simd::Pack: the number of lanes must be a power of two");
  static constexpr std::size_t lanes = N;
  static constexpr std::size_t width = detail::widest<T, N>();
  static constexpr std::size_t count = N / width;
  /// Alignment in bytes that load_aligned and store_aligned rely on.
  static constexpr std::size_t alignment = width * sizeof(T);

  Pack() = default;
  /// All lanes equal to `value`.
  explicit Pack(T value) {
    for (auto& part : part_) part = Part(value);
  }

  /// `low` in the first half of the lanes, `high` in the second.
  static Pack halves(T low, T high) {
    if constexpr (count > 1) {
      return build([&](std::size_t i) { return Part(i < count / 2 ? low : high); });
    } else {
      alignas(64) static constexpr auto half = [] {
        std::array<T, N> lane{};
        for (std::size_t l = N / 2; l < N; ++l) lane[l] = T(1);
        return lane;
      }();
      return where_equal(load_aligned(half.data()), Pack(T(0)), Pack(low), Pack(high));
    }
  }

  static Pack load_aligned(const T* from) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part::load_aligned(from + i * width);
      } else {
        return from[i];
      }
    });
  }
  static Pack load(const T* from) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part::load_unaligned(from + i * width);
      } else {
        return from[i];
      }
    });
  }
  void store_aligned(T* to) const {
    for (std::size_t i = 0; i < count; ++i) {
      if constexpr (width > 1) {
        part_[i].store_aligned(to + i * width);
      } else {
        to[i] = part_[i];
      }
    }
  }
  void store(T* to) const {
    for (std::size_t i = 0; i < count; ++i) {
      if constexpr (width > 1) {
        part_[i].store_unaligned(to + i * width);
      } else {
        to[i] = part_[i];
      }
    }
  }

  friend Pack operator+(const Pack& a, const Pack& b) {
    return build([&](std::size_t i) { return Part(a.part_[i] + b.part_[i]); });
  }
  friend Pack operator-(const Pack& a, const Pack& b) {
    return build([&](std::size_t i) { return Part(a.part_[i] - b.part_[i]); });
  }
  friend Pack operator*(const Pack& a, const Pack& b) {
    return build([&](std::size_t i) { return Part(a.part_[i] * b.part_[i]); });
  }
  friend Pack operator/(const Pack& a, const Pack& b) {
    return build([&](std::size_t i) { return Part(a.part_[i] / b.part_[i]); });
  }
  /// a * b + c
  friend Pack fma(const Pack& a, const Pack& b, const Pack& c) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part(xsimd::fma(a.part_[i], b.part_[i], c.part_[i]));
      } else {
        return a.part_[i] * b.part_[i] + c.part_[i];
      }
    });
  }
  friend Pack floor(const Pack& a) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part(xsimd::floor(a.part_[i]));
      } else {
        return std::floor(a.part_[i]);
      }
    });
  }
  friend Pack sqrt(const Pack& a) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part(xsimd::sqrt(a.part_[i]));
      } else {
        return std::sqrt(a.part_[i]);
      }
    });
  }
  /// Natural logarithm.
  friend Pack log(const Pack& a) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part(xsimd::log(a.part_[i]));
      } else {
        return std::log(a.part_[i]);
      }
    });
  }
  friend Pack min(const Pack& a, const Pack& b) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part(xsimd::min(a.part_[i], b.part_[i]));
      } else {
        return a.part_[i] < b.part_[i] ? a.part_[i] : b.part_[i];
      }
    });
  }
  friend Pack max(const Pack& a, const Pack& b) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part(xsimd::max(a.part_[i], b.part_[i]));
      } else {
        return a.part_[i] > b.part_[i] ? a.part_[i] : b.part_[i];
      }
    });
  }
  /// `then` in the lanes where a == b, `otherwise` in the others.
  friend Pack where_equal(const Pack& a, const Pack& b, const Pack& then, const Pack& otherwise) {
    return build([&](std::size_t i) {
      if constexpr (width > 1) {
        return Part(xsimd::select(a.part_[i] == b.part_[i], then.part_[i], otherwise.part_[i]));
      } else {
        return a.part_[i] == b.part_[i] ? then.part_[i] : otherwise.part_[i];
      }
    });
  }
  /// True if a == b in every lane.
  friend bool all_equal(const Pack& a, const Pack& b) {
    bool equal = true;
    for (std::size_t i = 0; i < count; ++i) {
      if constexpr (width > 1) {
        equal = equal && xsimd::all(a.part_[i] == b.part_[i]);
      } else {
        equal = equal && a.part_[i] == b.part_[i];
      }
    }
    return equal;
  }
  /// Smallest of all lanes.
  friend T lowest_lane(const Pack& a) {
    alignas(64) T lane[N];
    a.store(lane);
    T lowest = lane[0];
    for (std::size_t l = 1; l < N; ++l) lowest = lane[l] < lowest ? lane[l] : lowest;
    return lowest;
  }
  /// Sum of all lanes.
  friend T sum(const Pack& a) {
    Part total = a.part_[0];
    for (std::size_t i = 1; i < count; ++i) total = Part(total + a.part_[i]);
    if constexpr (width == 1) {
      return total;
    } else if constexpr (requires { reduce_add(total); }) {
      return reduce_add(total);
    } else {
      return hadd(total);
    }
  }

 private:
  template <bool Vector, class>
  struct PartType {
    using type = T;
  };
  template <class Dummy>
  struct PartType<true, Dummy> {
    using type = xsimd::make_sized_batch_t<T, width>;
  };
  using Part = typename PartType<(width > 1), void>::type;

  template <class F>
  static Pack build(F&& f) {
    Pack result;
    for (std::size_t i = 0; i < count; ++i) result.part_[i] = f(i);
    return result;
  }

  Part part_[count];
};

/// Lanes that fill the widest hardware vector of T, at least 4.
template <class T>
inline constexpr std::size_t native_lanes = [] {
  constexpr std::size_t lanes = detail::widest<T, 64 / sizeof(T)>();
  return lanes < 4 ? std::size_t{4} : lanes;
}();

/// The pointer itself, opaque to the optimiser: keeps it from turning `pointer + j * pitch` for each row j into as many
/// loop invariants, which would not fit the registers and be reloaded from the stack at every use.
template <class T>
inline T* keep_in_register(T* pointer) {
  asm("" : "+r"(pointer));
  return pointer;
}

/// Brings memory that will be written into the cache; changes nothing else.
template <class T>
inline void fetch_for_writing(const T* from, std::ptrdiff_t count) {
  constexpr std::ptrdiff_t line = 64 / sizeof(T);
  for (std::ptrdiff_t i = 0; i < count; i += line) __builtin_prefetch(from + i, 1, 2);
}

}  // namespace cambium::simd
