// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir time  Steppers over a State concept, and rules for the size of a step.
#include <cambium/time/euler.hpp>
#include <cambium/time/rates.hpp>
#include <cambium/time/rk4.hpp>
#include <cambium/time/state.hpp>
#include <cambium/time/state_adaptors.hpp>
#include <cambium/time/step_size.hpp>
#include <cambium/time/stepper.hpp>
#include <cambium/time/tvd_rk2.hpp>
#include <cambium/time/tvd_rk3.hpp>
