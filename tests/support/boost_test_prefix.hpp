// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The part of Boost.Test that is the same for every test, compiled once. Tests include <boost/test/unit_test.hpp> after
// their BOOST_TEST_MODULE as ever, and do not need this file.
#include <boost/test/framework.hpp>
#include <boost/test/test_tools.hpp>

// What Boost.Test makes of BOOST_TEST_MODULE in a header that has now been read.
#define BOOST_TEST_MAIN
