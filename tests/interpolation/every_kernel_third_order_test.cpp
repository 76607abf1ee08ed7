// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE every_kernel_third_order
#include <boost/test/unit_test.hpp>
#include <tuple>

#include <cambium/kernels.hpp>

using Kernels = std::tuple<cambium::Lambda22, cambium::M6TriplePrime>;

#include "interpolation/every_kernel.hpp"
