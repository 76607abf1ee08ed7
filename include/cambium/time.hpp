// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// \dir time  Steppers over a State concept, and rules for the size of a step.
#include <cambium/time/adaptive.hpp>
#include <cambium/time/chebyshev_stages.hpp>
#include <cambium/time/doubled.hpp>
#include <cambium/time/euler.hpp>
#include <cambium/time/fixed_steps.hpp>
#include <cambium/time/imex.hpp>
#include <cambium/time/imex_tableaux.hpp>
#include <cambium/time/rates.hpp>
#include <cambium/time/rk4.hpp>
#include <cambium/time/rkc2.hpp>
#include <cambium/time/spectral_radius.hpp>
#include <cambium/time/stability_error.hpp>
#include <cambium/time/stages.hpp>
#include <cambium/time/state.hpp>
#include <cambium/time/state_adaptors.hpp>
#include <cambium/time/state_sums.hpp>
#include <cambium/time/step_size.hpp>
#include <cambium/time/stepper.hpp>
#include <cambium/time/tvd_rk2.hpp>
#include <cambium/time/tvd_rk3.hpp>
