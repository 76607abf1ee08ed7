// expect: cambium: backward advection interpolates phi
// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cambium/kernels/m4.hpp>
#include <cambium/kernels/m4_prime.hpp>
#include <cambium/levelset/advection/backward.hpp>

#ifdef CAMBIUM_CONTROL
using Kernel = cambium::M4Prime;
#else
using Kernel = cambium::M4;
#endif

int main() { cambium::Backward<Kernel> advection; }
