// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cambium {

/// Condition on the two faces of a bounded axis.
enum class Wall {
  dirichlet,  ///< u is given at the nodes of the face
  neumann,    ///< du/dn = 0: the nodes of the face are unknowns, and u is continued by mirror images
};

}  // namespace cambium
