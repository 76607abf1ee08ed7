// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/core/field.hpp>
#include <cambium/multigrid/chebyshev.hpp>
#include <cambium/multigrid/convergence_error.hpp>
#include <cambium/multigrid/hierarchy.hpp>
#include <cambium/multigrid/red_black.hpp>
#include <cambium/poisson/mean_part.hpp>

namespace cambium {

/// (s - Lap) u = f with the (2D+1)-point stencil on a box, by geometric multigrid: every axis periodic or bounded, with
/// u or du/dn = 0 given at its walls.
///
///     cambium::Multigrid<3> multigrid(lattice);
///     multigrid.solve(f, u);
///
/// u holds the first guess at the unknowns and the data at the nodes of Dirichlet walls, which stay as they are; f is
/// not read there. A flux du/dn = q through a Neumann wall is f + 2 q / h at its nodes. Axes are halved as long as all
/// have an even number of cells: powers of two are best. Memory is taken with the object. No number of threads changes
/// a bit. Every call leaves u unchanged if it throws:
/// \throws SizeError if a field is not on the lattice of the solver; ValueError if a value is not finite, or, where s =
///         0 and no wall is Dirichlet's, if f has a mean (see Params; nodes of walls count half); ConvergenceError
template <int D, class S = RedBlack, class T = double, Execution E = OpenMP>
class Multigrid {
 public:
  static_assert(D == 2 || D == 3, "cambium::Multigrid: the dimension must be 2 or 3");
  static constexpr int dimension = D;

  struct Params {
    double shift = 0.0;           ///< s, in 1/length^2
    std::array<Wall, D> walls{};  ///< of bounded axes
    int before = 1;               ///< smoothings before the coarser level
    int after = 1;                ///< and after it
    bool symmetric = false;       ///< cycles are symmetric operators, as conjugate gradients need; slower
    double tolerance = sizeof(T) < sizeof(double) ? 1e-4 : 1e-10;  ///< of the residual, relative to that of zero
    int most_cycles = 40;
    MeanPart mean = MeanPart::reject;
    double mean_tolerance = sizeof(T) < sizeof(double) ? 1e-6 : 1e-10;  ///< of the mean, relative to the largest value
    S smoother = {};
  };

  /// \throws ValueError if s is negative or not finite; LatticeError if halving ends at too many nodes
  explicit Multigrid(const Lattice<D>& lattice) : Multigrid(lattice, Params{}) {}
  Multigrid(const Lattice<D>& lattice, const Params& params, const E& execution = {})
      : lattice_(lattice), params_(params), execution_(execution), hierarchy_(params.smoother, execution) {
    check_smoother<S>();
    if (!(params.shift >= 0.0) || !std::isfinite(params.shift)) {
      throw ValueError(detail::message("the shift s of s - Lap is ", params.shift, ": it must be finite and >= 0"));
    }
    singular_ = params.shift == 0.0;
    for (int d = 0; d < D; ++d) {
      singular_ = singular_ && (lattice.periodic(d) || params.walls[static_cast<std::size_t>(d)] == Wall::neumann);
      require_nodes(d);
    }
    make_levels();
    hierarchy_.settle(singular_);
  }

  const Lattice<D>& lattice() const { return lattice_; }
  const Params& params() const { return params_; }
  std::size_t levels() { return hierarchy_.levels().size(); }

  /// Cycles until the residual has fallen below the tolerance. \return residuals in the Euclidean norm
  SolveReport solve(const Field<T, D>& f, Field<T, D>& u) {
    return run(f, u, [&](SolveReport& report, double scale) {
      report.residuals.push_back(residual_norm() / scale);
      while (!(report.residuals.back() <= params_.tolerance)) {
        if (report.iterations == params_.most_cycles || !std::isfinite(report.residuals.back())) fail(report);
        hierarchy_.cycle(shape());
        ++report.iterations;
        report.residuals.push_back(residual_norm() / scale);
      }
    });
  }

  /// One cycle of full multigrid: an error of about that of the stencil, whatever the guess, at the cost of 1.3 (2D) or
  /// 1.15 (3D) cycles.
  SolveReport full_cycle(const Field<T, D>& f, Field<T, D>& u) {
    return run(f, u, [&](SolveReport& report, double scale) {
      report.residuals.push_back(residual_norm() / scale);
      hierarchy_.full_cycle(shape());
      report.iterations = 1;
      report.residuals.push_back(residual_norm() / scale);
    });
  }

  /// One cycle from the guess u.
  SolveReport cycle(const Field<T, D>& f, Field<T, D>& u) {
    return run(f, u, [&](SolveReport& report, double scale) {
      report.residuals.push_back(residual_norm() / scale);
      hierarchy_.cycle(shape());
      report.iterations = 1;
      report.residuals.push_back(residual_norm() / scale);
    });
  }

  /// Number of unknowns, in the order of the lattice: the length of the vectors below.
  std::size_t unknowns() const { return static_cast<std::size_t>(hierarchy_.finest().count); }
  /// out := (s - Lap) in, for zero at Dirichlet walls. To be called from one thread at a time, as precondition().
  template <class V>
  void apply(const V* in, V* out) {
    auto& level = hierarchy_.finest();
    level.x.assign(level.x.size(), T(0));
    level.b.assign(level.b.size(), T(0));
    each([&](std::size_t at, std::size_t i) { level.x[at] = static_cast<T>(in[i]); });
    find_residual(level, execution_);
    const double scale = -1.0 / (lattice_.spacing() * lattice_.spacing());
    each([&](std::size_t at, std::size_t i) { out[i] = static_cast<V>(scale * static_cast<double>(level.r[at])); });
  }
  /// out := one cycle from zero for (s - Lap) out = in with zero at Dirichlet walls: a linear operator.
  template <class V>
  void precondition(const V* in, V* out) {
    auto& level = hierarchy_.finest();
    level.x.assign(level.x.size(), T(0));
    const double square = lattice_.spacing() * lattice_.spacing();
    each([&](std::size_t at, std::size_t i) { level.b[at] = static_cast<T>(square * static_cast<double>(in[i])); });
    hierarchy_.cycle(shape());
    each([&](std::size_t at, std::size_t i) { out[i] = static_cast<V>(level.x[at]); });
  }

 private:
  detail::CycleShape shape() const { return {params_.before, params_.after, params_.symmetric}; }

  void require_nodes(int d) const {
    if (lattice_.nodes()[d] >= 3) return;
    throw LatticeError(detail::message("axis ", d, " has ", lattice_.nodes()[d],
                                       " nodes: multigrid needs at least 3, so that there are unknowns"));
  }
  void make_levels() {
    detail::LevelGrid<D> grid(lattice_.nodes(), lattice_.periodic(), params_.walls);
    double square = lattice_.spacing() * lattice_.spacing();
    for (;;) {
      auto& level = hierarchy_.levels().emplace_back(grid);
      level.diagonal = 2.0 * D + params_.shift * square;
      take_whole_box(level);
      if (level.count <= hierarchy_.few_unknowns) return;
      Index<D> nodes = grid.nodes;
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t cells = grid.periodic[d] ? nodes[d] : nodes[d] - 1;
        if (cells % 2 != 0 || cells < 4) return;
        nodes[d] = cells / 2 + (grid.periodic[d] ? 0 : 1);
      }
      grid = detail::LevelGrid<D>(nodes, grid.periodic, grid.walls);
      square *= 4.0;
    }
  }

  template <class F>
  void each(F&& f) const {
    detail::for_each_unknown(hierarchy_.finest(), execution_, f);
  }
  /// Calls f(entry of the level, number of the node) for all nodes.
  template <class F>
  void each_node(F&& f) const {
    const auto& grid = hierarchy_.finest().grid;
    detail::for_each_row<D>(Index<D>{}, grid.nodes - Index<D>::constant(1), [&](const Index<D>& node) {
      const std::size_t at = grid.at(node);
      const std::size_t number = lattice_.number(node);
      for (std::size_t i = 0; i < static_cast<std::size_t>(grid.nodes[0]); ++i) f(at + i, number + i);
    });
  }

  template <class Iterate>
  SolveReport run(const Field<T, D>& f, Field<T, D>& u, Iterate&& iterate) {
    if (!(f.lattice() == lattice_) || !(u.lattice() == lattice_)) {
      throw SizeError("a field is not on the lattice this multigrid was made for: make one solver per lattice");
    }
    auto& level = hierarchy_.finest();
    const T square = static_cast<T>(lattice_.spacing() * lattice_.spacing());
    level.b.assign(level.b.size(), T(0));
    each_node([&](std::size_t at, std::size_t i) { level.x[at] = u[i]; });
    each_unknown_node([&](std::size_t at, std::size_t i) { level.b[at] = square * f[i]; });
    require_finite(f, u);
    if (singular_) take_mean(f);
    const double scale = scale_of_residuals();
    SolveReport report;
    iterate(report, scale);
    report.residual = report.residuals.back();
    if (!std::isfinite(report.residual)) fail(report);
    if (singular_) {
      const T mean = static_cast<T>(weighted_mean(level.x));
      each([&](std::size_t at, std::size_t) { level.x[at] -= mean; });
    }
    each_unknown_node([&](std::size_t at, std::size_t i) { u[i] = level.x[at]; });
    return report;
  }
  template <class F>
  void each_unknown_node(F&& f) const {
    for (const auto& run : hierarchy_.finest().unknowns) {
      const std::size_t number = lattice_.number(run.node);
      for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i) f(run.at + i, number + i);
    }
  }
  void require_finite(const Field<T, D>& f, const Field<T, D>& u) const {
    const auto fail_at = [&](std::size_t i, T value, const char* what) {
      throw ValueError(detail::message(what, " is ", value, " at ", lattice_.position(lattice_.node(i)),
                                       ": every value must be finite"));
    };
    each_unknown_node([&](std::size_t, std::size_t i) {
      if (!std::isfinite(f[i])) fail_at(i, f[i], "the right-hand side");
    });
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (!std::isfinite(u[i])) fail_at(i, u[i], "the first guess or the data at walls");
    }
  }

  /// Norm of the residual of zero, or 1 if that is zero.
  double scale_of_residuals() {
    auto& level = hierarchy_.finest();
    // The right-hand side with the values at given faces: what A x = b is to the unknowns.
    double sum = 0.0;
    const auto& grid = level.grid;
    for (const auto& run : level.unknowns) {
      for (std::ptrdiff_t i = 0; i < run.count; ++i) {
        auto value = static_cast<double>(level.b[run.at + static_cast<std::size_t>(i)]);
        for (int d = 0; d < D; ++d) {
          const std::ptrdiff_t place = run.node[d] + (d == 0 ? i : 0);
          const T* const x = level.x.data() + run.at + i;
          if (grid.given_faces(d) && place == 1) value += static_cast<double>(x[-grid.stride[d]]);
          if (grid.given_faces(d) && place == grid.nodes[d] - 2) value += static_cast<double>(x[grid.stride[d]]);
        }
        sum += value * value;
      }
    }
    return sum > 0.0 ? std::sqrt(sum) : 1.0;
  }
  double residual_norm() {
    auto& level = hierarchy_.finest();
    find_residual(level, execution_);
    const auto& runs = level.unknowns;
    const double sum = reduce(
        execution_, runs.size(), 0.0,
        [&](std::size_t k) {
          double along = 0.0;
          for (std::size_t i = 0; i < static_cast<std::size_t>(runs[k].count); ++i) {
            const auto r = static_cast<double>(level.r[runs[k].at + i]);
            along += r * r;
          }
          return along;
        },
        [](double a, double b) { return a + b; });
    return std::sqrt(sum);
  }
  [[noreturn]] void fail(const SolveReport& report) const {
    throw ConvergenceError(
        detail::message("multigrid has a relative residual of ", report.residuals.back(), " after ", report.iterations,
                        " cycles and was to reach ", params_.tolerance,
                        ": allow more cycles, smooth more, or ask for no less than the round-off of the scalar type"),
        report.residuals);
  }

  /// Mean over the box: nodes of walls count half for each wall.
  double weighted_mean(const AlignedVector<T>& values) const {
    const auto& level = hierarchy_.finest();
    double sum = 0.0, weights = 0.0;
    for (const auto& run : level.unknowns) {
      double across = 1.0;
      for (int d = 1; d < D; ++d) across *= node_weight(d, run.node[d]);
      for (std::ptrdiff_t i = 0; i < run.count; ++i) {
        const double weight = across * node_weight(0, run.node[0] + i);
        sum += weight * static_cast<double>(values[run.at + static_cast<std::size_t>(i)]);
        weights += weight;
      }
    }
    return sum / weights;
  }
  double node_weight(int d, std::ptrdiff_t i) const {
    return !lattice_.periodic(d) && (i == 0 || i == lattice_.nodes()[d] - 1) ? 0.5 : 1.0;
  }
  /// Examines the mean of f, and takes it out of b.
  void take_mean(const Field<T, D>& f) {
    auto& level = hierarchy_.finest();
    double largest = 0.0;
    each_unknown_node(
        [&](std::size_t, std::size_t i) { largest = std::max(largest, std::abs(static_cast<double>(f[i]))); });
    const double square = lattice_.spacing() * lattice_.spacing();
    const double mean = weighted_mean(level.b);
    if (params_.mean == MeanPart::reject && std::abs(mean) / square > params_.mean_tolerance * largest) {
      throw ValueError(detail::message(
          "without a shift and without Dirichlet walls the right-hand side must have no mean, but it has ",
          mean / square, " (largest value ", largest,
          "): take away what puts it there, or ask for MeanPart::subtract"));
    }
    each([&](std::size_t at, std::size_t) { level.b[at] -= static_cast<T>(mean); });
  }

  Lattice<D> lattice_;
  Params params_;
  E execution_;
  detail::Hierarchy<D, S, T, E> hierarchy_;
  bool singular_ = false;
};

}  // namespace cambium
