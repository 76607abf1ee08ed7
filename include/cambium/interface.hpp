// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir interface  Conditions on the interface of a level set. <cambium/interface/dirichlet.hpp> is to be included by
/// name: it compiles Eigen.
#include <cambium/interface/continuation.hpp>
#include <cambium/interface/cut_domain.hpp>
#include <cambium/interface/side.hpp>
