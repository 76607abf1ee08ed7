// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace bench {

struct Options {
  std::size_t rounds = 9;
  std::size_t rounds_of_others = 3;
  std::ptrdiff_t cells_2d = 1024;
  std::ptrdiff_t cells_3d = 128;
  std::vector<std::ptrdiff_t> error_cells{32, 64, 128};
  std::size_t peak_steps = 2'000'000;

  template <int D>
  std::ptrdiff_t cells() const {
    return D == 2 ? cells_2d : cells_3d;
  }
};

enum class Way { p2m, m2p };
constexpr const char* name(Way way) { return way == Way::p2m ? "p2m" : "m2p"; }

template <class T>
constexpr const char* scalar_name = sizeof(T) == 4 ? "float" : "double";

/// Enters every contest there is; defined by every_kernel.cpp, or by smoke.cpp in the test of the program.
void enter_contests(const Options& options);

/// Enters every contest of kernel K; defined in kernel_contests.hpp and compiled kernel by kernel.
template <class K>
void enter_kernel(const char* kernel, const Options& options);

}  // namespace bench
