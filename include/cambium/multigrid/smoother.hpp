// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>

#include <cambium/multigrid/level.hpp>

namespace cambium {

/// A way to damp the errors of x that the next level does not have: smoother(level, backwards, execution) changes x at
/// the unknowns only. `backwards` asks for the transposed sweep, which makes a cycle symmetric.
template <class S>
concept Smoother = std::default_initializable<S> && std::copy_constructible<S> &&
    requires(const S& smoother, detail::Level<double, 2>& flat, detail::Level<float, 3>& deep) {
  smoother(flat, true, Serial{});
  smoother(deep, false, Serial{});
};

/// Checks S at compile time.
template <class S>
constexpr void check_smoother() {
  static_assert(Smoother<S>,
                "cambium: a smoother is a plain struct that is called as smoother(level, backwards, execution) for "
                "levels of any scalar and dimension; see docs/concepts/Smoother.md");
}

}  // namespace cambium
