// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cambium {

/// What holds on the two faces of a box that an axis runs into.
enum class Boundary {
  periodic,   ///< the faces are one
  dirichlet,  ///< values are given
  neumann,    ///< derivatives along the outward normal are given
};

}  // namespace cambium
