// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "levelset/every_reinitialisation.hpp"

template void bench::run_every_reinitialisation(ReinitScene<3>& scene);
