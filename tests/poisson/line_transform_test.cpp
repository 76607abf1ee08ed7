// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_TEST_MODULE line_transform
#include <boost/test/unit_test.hpp>
#include <fftw3.h>
#include <random>
#include <tuple>

#include <cambium/core/aligned.hpp>
#include <cambium/poisson/line_transform.hpp>

using cambium::AlignedVector;
using cambium::Boundary;
using cambium::detail::LineTransform;

namespace {

fftw_r2r_kind kind_of(Boundary boundary) {
  return boundary == Boundary::dirichlet ? FFTW_RODFT00 : boundary == Boundary::neumann ? FFTW_REDFT00 : FFTW_DHT;
}

template <class T>
struct Lines {
  LineTransform<T> transform;
  AlignedVector<T> x, y;
  explicit Lines(Boundary boundary, std::size_t cells) : transform(boundary, cells) {
    x.resize(transform.size() * transform.lines);
    y.resize(x.size());
    std::mt19937 random(5);
    for (T& value : x) value = static_cast<T>(std::uniform_real_distribution<>(-1.0, 1.0)(random));
    AlignedVector<T> a(transform.work_size()), b(transform.work_size());
    transform.run(x.data(), transform.lines, y.data(), transform.lines, a.data(), b.data());
  }
};

}  // namespace

// FFTW's own transforms of the same kinds, in double, are the reference; theirs are twice ours for sines and cosines.
// Round-off: the running sum over n / 2 results of size sqrt(n) gives eps sqrt(n) n / 2 at worst; measured, relative to
// sqrt(n): 1e-13 in double, 3e-6 in float.
BOOST_AUTO_TEST_CASE_TEMPLATE(lines_agree_with_the_reference, T, decltype(std::tuple<double, float>())) {
  for (const Boundary boundary : {Boundary::dirichlet, Boundary::neumann, Boundary::periodic}) {
    double worst = 0.0;
    for (const int cells : {1, 2, 3, 4, 5, 6, 8, 9, 15, 16, 17, 32, 60, 97, 100, 128, 256}) {
      if (boundary == Boundary::dirichlet && cells < 2) continue;
      const Lines<T> lines(boundary, static_cast<std::size_t>(cells));
      const std::size_t size = lines.transform.size();
      const double factor = boundary == Boundary::periodic ? 1.0 : 2.0;
      std::vector<double> in(size), out(size);
      const auto plan =
          fftw_plan_r2r_1d(static_cast<int>(size), in.data(), out.data(), kind_of(boundary), FFTW_ESTIMATE);
      for (std::size_t l = 0; l < lines.transform.lines; ++l) {
        for (std::size_t j = 0; j < size; ++j) in[j] = static_cast<double>(lines.x[j * lines.transform.lines + l]);
        fftw_execute(plan);
        for (std::size_t k = 0; k < size; ++k) {
          const double found = factor * static_cast<double>(lines.y[k * lines.transform.lines + l]);
          worst = std::max(worst, std::abs(found - out[k]) / std::sqrt(cells));
        }
      }
      fftw_destroy_plan(plan);
    }
    BOOST_TEST_MESSAGE("error " << worst);
    BOOST_TEST(worst < (sizeof(T) == sizeof(double) ? 5e-13 : 2e-5));
  }
}

BOOST_AUTO_TEST_CASE(twice_is_the_norm) {
  for (const Boundary boundary : {Boundary::dirichlet, Boundary::neumann, Boundary::periodic}) {
    for (const std::size_t cells : {2, 7, 24, 64}) {
      Lines<double> lines(boundary, cells);
      const auto& transform = lines.transform;
      AlignedVector<double> a(transform.work_size()), b(transform.work_size());
      double* const y = lines.y.data();
      transform.run(y, transform.lines, y, transform.lines, a.data(), b.data());
      for (std::size_t i = 0; i < lines.x.size(); ++i) {
        BOOST_TEST(std::abs(y[i] - transform.norm() * lines.x[i]) < 1e-12);
      }
    }
  }
}
