// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include <cambium/core/columns.hpp>
#include <cambium/core/domain.hpp>
#include <cambium/core/error.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium {

/// \throws PositionError unless `x`, the position of particle `p`, is finite and, along bounded axes, inside the closed
///         box, whose faces are taken in the precision of the positions
template <int D, class T>
void require_position(const Domain<D>& domain, const Vec<D, T>& x, std::size_t p) {
  for (int d = 0; d < D; ++d) {
    if (!std::isfinite(x[d])) {
      throw PositionError(detail::message("particle ", p, " has position ", x, ": component ", d,
                                          " is not finite; check the velocity and the time step"));
    }
    if (!domain.periodic[d] &&
        !(x[d] >= static_cast<T>(domain.box.lo[d]) && x[d] <= static_cast<T>(domain.box.hi[d]))) {
      throw PositionError(detail::message("particle ", p, " at ", x, " is outside the bounded box ", domain.box.lo,
                                          " to ", domain.box.hi, " along axis ", d,
                                          ": enlarge the box or remove the particle"));
    }
  }
}

/// True if particles [begin, end) have finite positions, inside the box along bounded axes; branch-free, for the case
/// that nothing is wrong.
template <int D, class T>
bool positions_valid(const Domain<D>& domain, Columns<D, const T> positions, std::size_t begin, std::size_t end) {
  int wrong = 0;  // comparisons with NaN are false
  for (int d = 0; d < D; ++d) {
    const T* x = positions.column(d).data();
    const T lo = domain.periodic[d] ? std::numeric_limits<T>::lowest() : static_cast<T>(domain.box.lo[d]);
    const T hi = domain.periodic[d] ? std::numeric_limits<T>::max() : static_cast<T>(domain.box.hi[d]);
    for (std::size_t p = begin; p < end; ++p) wrong += !((x[p] >= lo) & (x[p] <= hi));
  }
  return wrong == 0;
}

/// \throws PositionError naming the first particle that require_position() refuses
template <int D, class T, Execution E = OpenMP>
void require_positions(const Domain<D>& domain, Columns<D, const T> positions, const E& execution = {}) {
  for_each_piece(execution, positions.size(), 16384, [&](std::size_t begin, std::size_t end) {
    if (positions_valid(domain, positions, begin, end)) return;
    for (std::size_t p = begin; p < end; ++p) require_position(domain, positions[p], p);
  });
}

/// \throws ValueError naming the first particle with a component of `values` that is not finite; `what` is the name of
///         the values in the message ("strength", "volume")
template <int C, class T, Execution E = OpenMP>
void require_finite(Columns<C, const T> values, const char* what, const E& execution = {}) {
  for_each_piece(execution, values.size(), 16384, [&](std::size_t begin, std::size_t end) {
    int wrong = 0;
    for (int c = 0; c < C; ++c) {
      const T* value = values.column(c).data();
      for (std::size_t p = begin; p < end; ++p) wrong += !(std::abs(value[p]) <= std::numeric_limits<T>::max());
    }
    for (std::size_t p = begin; p < end && wrong > 0; ++p) {
      for (int c = 0; c < C; ++c) {
        if (std::isfinite(values.column(c)[p])) continue;
        throw ValueError(detail::message(what, " of particle ", p, " is ", values.column(c)[p],
                                         C > 1 ? " in component " : "", C > 1 ? std::to_string(c) : "",
                                         ": it must be finite; check what was computed from it last"));
      }
    }
  });
}

/// \throws ValueError naming the first particle whose value is not finite
template <class T, Execution E = OpenMP>
void require_finite(std::span<const T> values, const char* what, const E& execution = {}) {
  require_finite(Columns<1, const T>(values), what, execution);
}

/// \throws LatticeError unless the box of the domain has a positive, finite extent along every axis
template <int D>
void require_extent(const Domain<D>& domain) {
  for (int d = 0; d < D; ++d) {
    const double length = domain.box.hi[d] - domain.box.lo[d];
    if (!(length > 0.0) || !std::isfinite(length)) {
      throw LatticeError(detail::message("box has extent ", length, " along axis ", d, " (from ", domain.box.lo[d],
                                         " to ", domain.box.hi[d], "): it must be positive and finite"));
    }
  }
}

}  // namespace cambium
