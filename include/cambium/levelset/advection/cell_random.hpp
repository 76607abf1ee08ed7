// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace cambium::detail {

/// Random numbers that follow from a seed and the number of a cell alone, so that they do not depend on the order of
/// cells or the number of threads (SplitMix64; Steele, Lea & Flood 2014).
class CellRandom {
 public:
  CellRandom(std::uint64_t seed, std::uint64_t cell) : state_(mix(mix(seed) ^ cell)) {}

  /// Uniform in [0, 1).
  double operator()() {
    state_ += 0x9e3779b97f4a7c15u;
    return static_cast<double>(mix(state_) >> 11) * 0x1p-53;
  }

 private:
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace cambium::detail
