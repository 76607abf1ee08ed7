// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <exception>

#if defined(_OPENMP)
#include <omp.h>
#endif

namespace cambium {

/// Execution on the calling thread.
struct Serial {
  int count() const { return 1; }
};

/// Execution on OpenMP threads. Without OpenMP at compile time it runs on the calling thread. The number of threads
/// never changes a bit of any result: work is cut into pieces whose size does not depend on it.
struct OpenMP {
  /// Number of threads; 0 means as many as OpenMP would take by itself.
  int threads = 0;

  int count() const {
#if defined(_OPENMP)
    return threads > 0 ? threads : omp_get_max_threads();
#else
    return 1;
#endif
  }
};

/// How a loop runs: Serial or OpenMP.
template <class E>
concept Execution = std::copy_constructible<E> && requires(const E& execution) {
  { execution.count() } -> std::convertible_to<int>;
};

/// Calls f(worker, begin, end) for consecutive pieces of [0, count) of `piece` items each (the last may be shorter).
///
/// `worker` in [0, execution.count()) tells apart the threads that run at the same time: scratch memory of its own.
/// Pieces depend on `count` and `piece` alone, so an f that writes only to places of its own items gives the same bits
/// for any number of threads. An exception thrown by f is rethrown on the calling thread; of several, the one of the
/// first piece.
template <Execution E, class F>
void for_each_piece_by_worker(const E& execution, std::size_t count, std::size_t piece, F&& f) {
  piece = std::max<std::size_t>(piece, 1);
  const std::size_t pieces = (count + piece - 1) / piece;
  const auto run = [&](std::size_t worker, std::size_t p) { f(worker, p * piece, std::min(count, (p + 1) * piece)); };
#if defined(_OPENMP)
  const int threads = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(execution.count()), pieces));
  if (threads > 1) {
    std::exception_ptr failure;
    std::size_t failed = pieces;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
    for (std::size_t p = 0; p < pieces; ++p) {
      try {
        run(static_cast<std::size_t>(omp_get_thread_num()), p);
      } catch (...) {
#pragma omp critical(cambium_for_each_piece)
        if (p < failed) {
          failed = p;
          failure = std::current_exception();
        }
      }
    }
    if (failure) std::rethrow_exception(failure);
    return;
  }
#else
  (void)execution;
#endif
  for (std::size_t p = 0; p < pieces; ++p) run(0, p);
}

/// Calls f(begin, end) for consecutive pieces of [0, count); see for_each_piece_by_worker.
template <Execution E, class F>
void for_each_piece(const E& execution, std::size_t count, std::size_t piece, F&& f) {
  for_each_piece_by_worker(execution, count, piece,
                           [&](std::size_t, std::size_t begin, std::size_t end) { f(begin, end); });
}

/// Calls f(i) for i in [0, count).
template <Execution E, class F>
void for_each(const E& execution, std::size_t count, F&& f) {
  for_each_piece(execution, count, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f(i);
  });
}

/// Folds f(0), f(1), ..., f(count - 1) with `combine`, starting from `identity`.
///
/// Pieces of 1024 items are folded in order and their results combined in order: the same bits for any number of
/// threads. The results of `window` pieces at a time, 32 KiB of them, wait on the stack: nothing is allocated, and up
/// to 4 million items summed in double are one loop. (Each further loop waits for all threads once more.)
template <Execution E, std::default_initializable T, class F, class Combine>
T reduce(const E& execution, std::size_t count, T identity, F&& f, Combine&& combine) {
  constexpr std::size_t piece = 1024, window = std::max<std::size_t>(32, 32768 / sizeof(T));
  T total = identity;
  std::array<T, window> partial;
  for (std::size_t first = 0; first < count; first += window * piece) {
    const std::size_t here = std::min(window * piece, count - first);
    for_each_piece(execution, here, piece, [&](std::size_t begin, std::size_t end) {
      T sum = identity;
      for (std::size_t i = first + begin; i < first + end; ++i) sum = combine(sum, f(i));
      partial[begin / piece] = sum;
    });
    for (std::size_t p = 0; p * piece < here; ++p) total = combine(total, partial[p]);
  }
  return total;
}

}  // namespace cambium
