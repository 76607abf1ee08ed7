// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cambium {

/// A running sum with the round-off of every addition kept beside it (Neumaier 1974): the error of n terms is about
/// 2e-16 |sum| + n^2 1e-32 sum |terms|, whatever the order. Compilers must not reassociate (-ffast-math undoes it).
struct CompensatedSum {
  double high = 0.0;
  double low = 0.0;

  constexpr CompensatedSum& operator+=(double term) {
    const double sum = high + term;
    const bool term_is_smaller = (high < 0.0 ? -high : high) >= (term < 0.0 ? -term : term);
    low += term_is_smaller ? (high - sum) + term : (term - sum) + high;
    high = sum;
    return *this;
  }
  constexpr CompensatedSum& operator+=(const CompensatedSum& other) {
    *this += other.high;
    low += other.low;
    return *this;
  }
  friend constexpr CompensatedSum operator+(CompensatedSum a, double b) { return a += b; }
  friend constexpr CompensatedSum operator+(CompensatedSum a, const CompensatedSum& b) { return a += b; }

  constexpr double value() const { return high + low; }
};

}  // namespace cambium
