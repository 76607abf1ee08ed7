// expect: cambium: marching is of first or of second order
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/levelset/reinit/fast_marching.hpp>

#ifdef CAMBIUM_CONTROL
constexpr int order = 2;
#else
constexpr int order = 3;
#endif

int main() { cambium::FastMarching<cambium::ChoppKickOff, order>::Params params; }
