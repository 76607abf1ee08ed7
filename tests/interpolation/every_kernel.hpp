// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/test/unit_test.hpp>

#include "interpolation/adjointness.hpp"
#include "interpolation/conservation.hpp"
#include "interpolation/convergence.hpp"
#include "interpolation/plain_agreement.hpp"

// The tests that every remeshing kernel goes through, for the kernels of the tuple `Kernels`. They are together because
// they compile the same code; each of the files every_kernel_*_test.cpp takes two kernels.

BOOST_AUTO_TEST_CASE_TEMPLATE(p2m_and_m2p_are_adjoint, K, Kernels) {
  check_adjointness<K, double, 1, 1, cambium::Dense>();
  check_adjointness<K, double, 2, 1, cambium::Dense>();
  check_adjointness<K, double, 3, 1, cambium::Dense>();
  check_adjointness<K, double, 1, 1, cambium::Sparse>();
  check_adjointness<K, double, 2, 1, cambium::Sparse>();
  check_adjointness<K, double, 3, 1, cambium::Sparse>();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(fast_loops_agree_with_plain_ones, K, Kernels) {
  check_plain_agreement<K, 1>();
  check_plain_agreement<K, 2>();
  check_plain_agreement<K, 3>();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(no_particles_give_an_empty_mesh, K, Kernels) {
  check_no_particles<K, cambium::Dense, 1>();
  check_no_particles<K, cambium::Dense, 2>();
  check_no_particles<K, cambium::Dense, 3>();
  check_no_particles<K, cambium::Sparse, 1>();
  check_no_particles<K, cambium::Sparse, 2>();
  check_no_particles<K, cambium::Sparse, 3>();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(moments_are_conserved, K, Kernels) {
  for (const bool periodic : {false, true}) {
    check_conservation<K, cambium::Dense, 1>(periodic);
    check_conservation<K, cambium::Dense, 2>(periodic);
    check_conservation<K, cambium::Dense, 3>(periodic);
    check_conservation<K, cambium::Sparse, 1>(periodic);
    check_conservation<K, cambium::Sparse, 2>(periodic);
    check_conservation<K, cambium::Sparse, 3>(periodic);
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(reading_a_smooth_function_has_the_declared_order, K, Kernels) {
  check_reading_order<K, 1>();
  check_reading_order<K, 2>();
  check_reading_order<K, 3>();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(remeshing_of_shifted_particles_has_the_declared_order, K, Kernels) {
  check_shift_order<K, 1>();
  check_shift_order<K, 2>();
  check_shift_order<K, 3>();
}

BOOST_AUTO_TEST_CASE_TEMPLATE(remeshing_of_strained_particles_is_limited_by_smoothness, K, Kernels) {
  constexpr int order = std::min(K::moments, K::continuity) + 1;
  const double found = strained_order<K>();
  BOOST_TEST(found >= order - 0.2);
  BOOST_TEST(found <= order + 0.5);
}

BOOST_AUTO_TEST_CASE_TEMPLATE(only_kernels_with_negative_weights_overshoot_a_step, K, Kernels) {
  for (const auto& [lowest, highest] : {step_range<K, 1>(), step_range<K, 2>(), step_range<K, 3>()}) {
    if (cambium::is_non_negative<K>) {
      BOOST_TEST(lowest >= 0.0);
      BOOST_TEST(highest <= 1.0 + 1e-15 * 64);  // weights sum to 1 to round-off
    } else {
      BOOST_TEST((lowest < -0.01 && highest > 1.01));
    }
  }
}

BOOST_AUTO_TEST_CASE_TEMPLATE(interpolating_kernels_reproduce_lattice_values, K, Kernels) {
  if constexpr (cambium::is_interpolating<K>) {
    check_nodes_are_reproduced<K, 1>();
    check_nodes_are_reproduced<K, 2>();
    check_nodes_are_reproduced<K, 3>();
  }
}
