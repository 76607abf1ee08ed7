// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE every_kernel_fifth_order
#include <boost/test/unit_test.hpp>
#include <tuple>

#include <cambium/kernels.hpp>

using Kernels = std::tuple<cambium::M6, cambium::Lambda44>;

#include "interpolation/every_kernel.hpp"
