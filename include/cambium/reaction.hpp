// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir reaction  Pointwise kinetics: rates, uniform states and their linear stability.
#include <cambium/reaction/gray_scott.hpp>
#include <cambium/reaction/kinetics.hpp>
#include <cambium/reaction/koch_meinhardt.hpp>
#include <cambium/reaction/linearised_brusselator.hpp>
#include <cambium/reaction/polynomial_roots.hpp>
#include <cambium/reaction/react.hpp>
#include <cambium/reaction/schnakenberg.hpp>
#include <cambium/reaction/stability.hpp>
