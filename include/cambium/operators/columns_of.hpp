// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <type_traits>

#include <cambium/core/columns.hpp>

namespace cambium::detail {

/// columns_of() for reading.
template <class V>
auto const_columns_of(const V& values) {
  const auto columns = columns_of(values);
  using Result = Columns<decltype(columns)::count, const typename decltype(columns)::Scalar>;
  return static_cast<Result>(columns);
}

/// \throws ValueError if an array to be written is one of the arrays that are read
template <int A, int B, class S, class T>
void require_distinct(const Columns<A, S>& in, const Columns<B, T>& out) {
  for (int a = 0; a < A; ++a) {
    for (int b = 0; b < B; ++b) {
      if (static_cast<const void*>(in.column(a).data()) != static_cast<const void*>(out.column(b).data())) continue;
      if (in.size() > 0) throw ValueError("an operator cannot overwrite its own argument: pass a second array");
    }
  }
}

}  // namespace cambium::detail
