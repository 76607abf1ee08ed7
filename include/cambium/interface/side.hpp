// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cambium {

/// A side of an interface: where phi < 0, or where it is not.
enum class Side { inside, outside };

}  // namespace cambium
