// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>

namespace cambium {

/// Base of every error the library throws. The text says what was found, where, and what to do about it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A particle or query point lies outside a bounded box, or its position is not finite.
class PositionError : public Error {
 public:
  using Error::Error;
};

/// A value (strength, attribute, parameter) is not finite or out of its range.
class ValueError : public Error {
 public:
  using Error::Error;
};

/// A lattice cannot be what was asked for: spacing, extent, period or number of nodes.
class LatticeError : public Error {
 public:
  using Error::Error;
};

/// Arrays that belong together have different lengths, or fields live on different lattices.
class SizeError : public Error {
 public:
  using Error::Error;
};

/// A named attribute does not exist, exists already, or has another type.
class AttributeError : public Error {
 public:
  using Error::Error;
};

namespace detail {

/// Concatenates anything streamable into one message.
template <class... Parts>
std::string message(const Parts&... parts) {
  std::ostringstream out;
  out.precision(17);
  (out << ... << parts);
  return out.str();
}

}  // namespace detail

/// Throws SizeError unless `found == expected`; `what` names the array that is too short or too long.
inline void require_size(std::size_t found, std::size_t expected, const char* what) {
  if (found != expected) {
    throw SizeError(detail::message(what, " has ", found, " entries where ", expected,
                                    " are needed: give every array of one call the same length"));
  }
}

}  // namespace cambium
