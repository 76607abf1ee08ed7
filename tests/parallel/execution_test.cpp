// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE execution
#include <algorithm>
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <support/count_allocations.hpp>
#include <vector>

#include <cambium/parallel/execution.hpp>

using namespace cambium;

static_assert(Execution<Serial> && Execution<OpenMP> && !Execution<int>);

namespace {

/// Calls f(execution) for Serial and OpenMP with the default and 1, ..., 4 threads.
template <class F>
void with_every_execution(F&& f) {
  f(Serial{});
  for (int threads = 0; threads <= 4; ++threads) f(OpenMP{threads});
}

}  // namespace

BOOST_AUTO_TEST_CASE(number_of_threads) {
  BOOST_TEST(Serial{}.count() == 1);
  BOOST_TEST(OpenMP{}.count() >= 1);
#if defined(_OPENMP)
  BOOST_TEST(OpenMP{3}.count() == 3);
#else
  BOOST_TEST(OpenMP{3}.count() == 1);
#endif
}

BOOST_AUTO_TEST_CASE(pieces_cover_every_item_once) {
  with_every_execution([](const auto& execution) {
    for (const std::size_t count : {0, 1, 99, 100, 101, 12345}) {
      for (const std::size_t piece : {0, 1, 7, 100, 100000}) {  // a piece of 0 is one of 1
        std::vector<int> visits(count, 0);
        std::atomic<bool> regular = true;
        for_each_piece(execution, count, piece, [&](std::size_t begin, std::size_t end) {
          const std::size_t length = piece == 0 ? 1 : piece;
          if (begin % length != 0 || begin >= end || (end != count && end != begin + length)) regular = false;
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        BOOST_TEST(regular);
        BOOST_TEST((visits == std::vector<int>(count, 1)));
      }
    }
  });
}

BOOST_AUTO_TEST_CASE(workers_that_run_at_once_are_told_apart) {
  for (int threads = 1; threads <= 4; ++threads) {
    const OpenMP execution{threads};
    std::vector<std::atomic<int>> busy(static_cast<std::size_t>(execution.count()));
    std::atomic<int> bad = 0;
    std::atomic<int> items = 0;
    for_each_piece_by_worker(execution, 1000, 3, [&](std::size_t worker, std::size_t begin, std::size_t end) {
      if (worker >= busy.size()) {
        ++bad;
        return;
      }
      if (++busy[worker] != 1) ++bad;
      items += static_cast<int>(end - begin);
      --busy[worker];
    });
    BOOST_TEST(bad == 0);
    BOOST_TEST(items == 1000);
  }
}

BOOST_AUTO_TEST_CASE(every_index_is_called_once) {
  with_every_execution([](const auto& execution) {
    std::vector<int> visits(5000, 0);
    for_each(execution, visits.size(), [&](std::size_t i) { ++visits[i]; });
    BOOST_TEST((visits == std::vector<int>(5000, 1)));
  });
}

BOOST_AUTO_TEST_CASE(the_first_of_several_exceptions_reaches_the_caller) {
  with_every_execution([](const auto& execution) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const auto fail = [](std::size_t begin, std::size_t) {
        if (begin % 30 == 20) throw std::runtime_error(std::to_string(begin));
      };
      BOOST_CHECK_EXCEPTION(for_each_piece(execution, 1000, 10, fail), std::runtime_error,
                            [](const std::exception& error) { return std::string(error.what()) == "20"; });
    }
    std::vector<int> visits(100, 0);  // the threads are still of use
    for_each_piece(execution, 100, 10, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    BOOST_TEST((visits == std::vector<int>(100, 1)));
  });
}

BOOST_AUTO_TEST_CASE(reduction_has_the_same_bits_for_any_number_of_threads) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<double> terms(100000);
  for (double& term : terms) term = std::exp2(40.0 * unit(random)) * unit(random);  // sums depend on the order
  const auto sum = [&](const auto& execution) {
    return reduce(
        execution, terms.size(), 0.0, [&](std::size_t i) { return terms[i]; }, std::plus<>());
  };
  const double serial = sum(Serial{});
  double backwards = 0.0;
  for (std::size_t i = terms.size(); i-- > 0;) backwards += terms[i];
  BOOST_TEST(serial != backwards);
  with_every_execution([&](const auto& execution) { BOOST_TEST(sum(execution) == serial); });
}

BOOST_AUTO_TEST_CASE(reduction_keeps_the_order_of_what_does_not_commute) {
  // Strings: the fold of 0 ... 2999 in order, whatever the pieces.
  std::string expected;
  for (int i = 0; i < 3000; ++i) expected += std::to_string(i % 10);
  with_every_execution([&](const auto& execution) {
    const auto digit = [](std::size_t i) { return std::to_string(i % 10); };
    const auto append = [](const std::string& a, const std::string& b) { return a + b; };
    BOOST_TEST((reduce(execution, 3000, std::string(), digit, append) == expected));
    BOOST_TEST((reduce(execution, 0, std::string("none"), digit, append) == "none"));
  });
}

// More pieces than wait at a time: still the fold of the folds of 1024 items each, and nothing is allocated for it.
BOOST_AUTO_TEST_CASE(reduction_of_many_pieces_has_the_bits_of_the_plain_fold) {
  constexpr std::size_t count = 4200 * 1024 + 77;
  const auto term = [](std::size_t i) { return 1.0 / (1.0 + static_cast<double>(i)); };
  double expected = 0.0;
  for (std::size_t begin = 0; begin < count; begin += 1024) {
    double sum = 0.0;
    for (std::size_t i = begin; i < std::min<std::size_t>(count, begin + 1024); ++i) sum += term(i);
    expected += sum;
  }
  with_every_execution(
      [&](const auto& execution) { BOOST_TEST(reduce(execution, count, 0.0, term, std::plus<>()) == expected); });
  const std::size_t before = support::allocations;
  const double sum = reduce(Serial{}, count, 0.0, term, std::plus<>());
  const std::size_t allocated = support::allocations - before;
  BOOST_TEST(sum == expected);
  BOOST_TEST(allocated == 0U);
}
