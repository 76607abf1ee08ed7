// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cambium/core/error.hpp>

namespace cambium {

/// A time step that the method does not take: what it computes would grow without bound.
class StabilityError : public Error {
 public:
  StabilityError(const std::string& what, double step, double limit) : Error(what), step_(step), limit_(limit) {}
  /// The step, and the longest that is stable; 0 where that is not known.
  double step() const { return step_; }
  double limit() const { return limit_; }

 private:
  double step_;
  double limit_;
};

}  // namespace cambium
