// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <fftw3.h>
#include <memory>
#include <mutex>
#include <type_traits>

namespace cambium {

/// How the transforms are planned. Estimated plans are the same in every run, so results are too; measured ones can be
/// faster but may differ from run to run in the last bits, because the fastest algorithm of the day is taken.
enum class Planning { estimate, measure };

namespace detail {

/// FFTW's planner is not safe to enter from two threads at once, whoever calls it: one lock for all plans.
inline std::mutex& planner_lock() {
  static std::mutex lock;
  return lock;
}

/// FFTW for numbers of type T: the same calls under one name for double and float.
template <class T>
struct Fftw;

template <>
struct Fftw<double> {
  using Plan = fftw_plan;
  static fftw_complex* raw(std::complex<double>* z) { return reinterpret_cast<fftw_complex*>(z); }
  static Plan forward(int rank, const int* n, double* x, std::complex<double>* z, unsigned flags) {
    return fftw_plan_dft_r2c(rank, n, x, raw(z), flags);
  }
  static Plan backward(int rank, const int* n, double* x, std::complex<double>* z, unsigned flags) {
    return fftw_plan_dft_c2r(rank, n, raw(z), x, flags);
  }
  static void run_forward(Plan plan, double* x, std::complex<double>* z) { fftw_execute_dft_r2c(plan, x, raw(z)); }
  static void run_backward(Plan plan, double* x, std::complex<double>* z) { fftw_execute_dft_c2r(plan, raw(z), x); }
  static void destroy(Plan plan) { fftw_destroy_plan(plan); }
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  static fftwf_complex* raw(std::complex<float>* z) { return reinterpret_cast<fftwf_complex*>(z); }
  static Plan forward(int rank, const int* n, float* x, std::complex<float>* z, unsigned flags) {
    return fftwf_plan_dft_r2c(rank, n, x, raw(z), flags);
  }
  static Plan backward(int rank, const int* n, float* x, std::complex<float>* z, unsigned flags) {
    return fftwf_plan_dft_c2r(rank, n, raw(z), x, flags);
  }
  static void run_forward(Plan plan, float* x, std::complex<float>* z) { fftwf_execute_dft_r2c(plan, x, raw(z)); }
  static void run_backward(Plan plan, float* x, std::complex<float>* z) { fftwf_execute_dft_c2r(plan, raw(z), x); }
  static void destroy(Plan plan) { fftwf_destroy_plan(plan); }
};

template <class T>
struct DestroyPlan {
  void operator()(std::remove_pointer_t<typename Fftw<T>::Plan>* plan) const {
    const std::lock_guard guard(planner_lock());
    Fftw<T>::destroy(plan);
  }
};

/// A plan that is destroyed with its owner; it can be moved but not copied.
template <class T>
using PlanOwner = std::unique_ptr<std::remove_pointer_t<typename Fftw<T>::Plan>, DestroyPlan<T>>;

}  // namespace detail
}  // namespace cambium
