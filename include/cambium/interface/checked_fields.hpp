// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/core/field.hpp>

namespace cambium::detail {

/// \param problem  what the lattice was given to, as the message names it \throws SizeError
template <class T, int D>
void require_lattice(const Field<T, D>& field, const Lattice<D>& lattice, const char* problem) {
  if (field.lattice() == lattice) return;
  throw SizeError(message("a field is not on the lattice of this ", problem, ": make one for each lattice"));
}

/// The value of node i. \param what  names the field \throws ValueError if it is not finite
template <class T, int D>
double finite_value(const Field<T, D>& field, std::size_t i, const char* what) {
  if (std::isfinite(field[i])) return static_cast<double>(field[i]);
  throw ValueError(message(what, " is ", field[i], " at ", field.lattice().position(field.lattice().node(i)),
                           ": every value must be finite"));
}

}  // namespace cambium::detail
