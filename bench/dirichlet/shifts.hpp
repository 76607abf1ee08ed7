// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "dirichlet/scene.hpp"
#include "support/median.hpp"

namespace bench {

template <int D>
struct Ellipsoid {
  std::array<double, D> half;
  double operator()(const Vec<D>& x) const {
    double sum = 0.0;
    for (int d = 0; d < D; ++d) sum += std::pow((x[d] - 0.5) / half[static_cast<std::size_t>(d)], 2);
    return 0.3 * (std::sqrt(sum) - 1.0);
  }
};
struct Star {
  double operator()(const Vec<2>& x) const {
    const double a = x[0] - 0.5, b = x[1] - 0.5;
    return std::hypot(a, b) - (0.28 + 0.05 * std::cos(5.0 * std::atan2(b, a)));
  }
};

/// Errors of c and of dc/dn for random shifts of the lattice against a shape: how much they depend on the cuts.
template <int D, class Shape>
void run_shifts(const char* name, const Shape& shape, int shifts, std::ptrdiff_t cells, nlohmann::json& table) {
  std::mt19937 random(5);
  std::vector<double> values, derivatives;
  for (int k = 0; k < shifts; ++k) {
    Vec<D> shift;
    for (int d = 0; d < D; ++d) {
      shift[d] = std::uniform_real_distribution<>(0.0, 1.0)(random) / static_cast<double>(cells);
    }
    const Box<D> box{shift, shift + Vec<D>::constant(1.0)};
    Scene<D, Shape> scene(Lattice<D>::bounded_box(box, cells), shape);
    Dirichlet<D> solver(scene.level_set.band(), {}, OpenMP{1});
    Field<double, D> c(scene.lattice);
    solver.solve(scene.f, Scene<D, Shape>::Problem::value, c);
    Field<double, D, Sparse> derivative(scene.lattice);
    solver.normal_derivative(scene.level_set.band(), scene.level_set.method().points(), c, derivative);
    values.push_back(scene.value_error(solver, c));
    derivatives.push_back(scene.derivative_error(derivative));
  }
  nlohmann::json entry{{"shape", name}, {"dimension", D}, {"cells", cells}, {"shifts", shifts}};
  for (const auto* errors : {&values, &derivatives}) {
    const char* what = errors == &values ? "value" : "derivative";
    const double middle = median(*errors);
    const double worst = std::ranges::max(*errors);
    entry[what] = {{"median", middle}, {"worst", worst}, {"least", std::ranges::min(*errors)}};
    std::printf("%-10s %td cells, %d shifts, error of the %s: median %.3e, worst %.3e (%.2f of it)\n", name, cells,
                shifts, what, middle, worst, worst / middle);
  }
  std::fflush(stdout);
  table.push_back(entry);
}

}  // namespace bench
