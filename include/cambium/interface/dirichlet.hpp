// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <cambium/core/field.hpp>
#include <cambium/interface/checked_fields.hpp>
#include <cambium/interface/continuation.hpp>
#include <cambium/interface/dirichlet_levels.hpp>
#include <cambium/interface/interface_gradient.hpp>
#include <cambium/levelset/band_field.hpp>
#include <cambium/multigrid/krylov.hpp>
#include <cambium/multigrid/red_black.hpp>

namespace cambium {

/// Equations of the nodes next to an interface.
enum class CutStencil {
  quadratic,  ///< exact for quadratic polynomials: values err by O(h^3) next to the interface, slopes there by O(h^2)
  cubic  ///< what cubic terms add to the right-hand side is taken from a first solution; values O(h^4), slopes O(h^3)
};

/// (s - Lap) c = f on one side of an interface with c = g on it.
///
///     cambium::Dirichlet<3> nutrient(level_set.band(), {.side = cambium::Side::inside, .shift = 1.0});
///     nutrient.solve(f, [](const Vec<3>&) { return 1.0; }, c);
///
/// Stencils whose legs the interface cuts are those of quadratic polynomials through the crossings (see CutWeights),
/// which lie on the zero set of the interpolant of Lambda<4, 4>: second order in c and in its gradient, up to the
/// interface, wherever the lattice cuts it. The equations, which are not symmetric, are solved by a Krylov loop in
/// double precision that one multigrid cycle in single precision preconditions. Where the domain reaches the faces of
/// the box, they are periodic as the lattice is, mirror (Neumann), or have values given in c. Memory is kept from call
/// to call, but for what Eigen's GMRES takes. No number of threads changes a bit.
template <int D, class T = double, class Krylov = BiCGStab, class S = RedBlack, Execution E = OpenMP>
class Dirichlet {
 public:
  static_assert(D == 2 || D == 3, "cambium::Dirichlet: the dimension must be 2 or 3");
  static constexpr int dimension = D;

  struct Params {
    Side side = Side::inside;
    double shift = 0.0;           ///< s, in 1/length^2
    std::array<Wall, D> walls{};  ///< of bounded axes, where the domain reaches them
    double tolerance = 1e-9;      ///< of the residual, relative to the right-hand side
    int most_iterations = 60;
    int before = 2;  ///< smoothings before the coarser level
    int after = 2;   ///< and after it
    S smoother = {};
  };

  /// \throws ValueError if s is negative or not finite; InterfaceError if the side has no node
  template <class B>
  explicit Dirichlet(const NarrowBand<B, D>& band) : Dirichlet(band, Params{}) {}
  template <class B>
  Dirichlet(const NarrowBand<B, D>& band, const Params& params, const E& execution = {})
      : lattice_(band.lattice()),
        params_(params),
        execution_(execution),
        levels_(lattice_, params.walls, params.smoother, execution),
        krylov_(execution) {
    check_smoother<S>();
    update(band, params.shift);
  }

  const Lattice<D>& lattice() const { return lattice_; }
  const Params& params() const { return params_; }
  /// Nodes where c is sought.
  std::size_t unknowns() const { return static_cast<std::size_t>(levels_.finest().count); }
  /// Places where the lattice does not resolve the domain: nodes of it between two crossings along an axis, and single
  /// nodes beyond it between two of its own.
  std::size_t unresolved() const {
    const auto& domain = levels_.domain();
    std::size_t count = 0;
    for (const auto& node : domain.nodes) {
      for (std::size_t k = 1; k < 2 * D; k += 2) {
        if (node.leg[k] < 0.0) continue;
        if (node.leg[k ^ 1] >= 0.0) ++count;
        const Index<D> next = domain.neighbour(domain.neighbour(node.node, k), k);  // itself, mirrored, at a wall
        if (!(next == node.node) && domain.in_domain(next)) ++count;
      }
    }
    return count;
  }
  /// True if c is sought or given at a node.
  bool in_domain(const Index<D>& node) const { return levels_.domain().in_domain(node); }

  /// Takes an interface that has moved. \throws SizeError if its lattice is another; InterfaceError if the side has no
  /// node. After a throw update() is to be called again.
  template <class B>
  void update(const NarrowBand<B, D>& band) {
    if (!(band.lattice() == lattice_)) {
      throw SizeError("the level set is not on the lattice of this Dirichlet problem: make one for each lattice");
    }
    data_.clear();
    levels_.update(band, params_.side, params_.shift * lattice_.spacing() * lattice_.spacing());
  }
  /// And another shift, as implicit steps in time of another length have. \throws also ValueError if it is negative or
  /// not finite; nothing has changed then
  template <class B>
  void update(const NarrowBand<B, D>& band, double shift) {
    if (!(shift >= 0.0) || !std::isfinite(shift)) {
      throw ValueError(detail::message("the shift s of s - Lap is ", shift, ": it must be finite and >= 0"));
    }
    params_.shift = shift;
    update(band);
  }

  /// \param f  right-hand side, read at nodes of the domain
  /// \param g  g(x) is the value at the point x of the interface
  /// \param c  holds the first guess (a solution at the last step is a good one), and the data at Dirichlet walls;
  ///           becomes the solution at nodes of the domain and stays as it is at all others
  /// \param stencil  cubic takes two solutions, the first to 1e-7; iterations are those of both
  /// \throws SizeError if a field is not on the lattice; ValueError if a value is not finite; ConvergenceError with the
  ///         residuals on the way; c is unchanged then
  template <class G>
  SolveReport solve(const Field<T, D>& f, G&& g, Field<T, D>& c, CutStencil stencil = CutStencil::quadratic) {
    detail::require_lattice(f, lattice_, name);
    detail::require_lattice(c, lattice_, name);
    right_.assign(unknowns(), 0.0);
    guess_.resize(unknowns());
    read_problem(f, c);
    add_interface(g);
    int first = 0;
    if (stencil == CutStencil::cubic) {
      first = solve_equations(std::max(first_tolerance, params_.tolerance)).iterations;
      add_cubic_terms();
    }
    SolveReport report = solve_equations(params_.tolerance);
    report.iterations += first;
    each_unknown_node([&](std::size_t, std::size_t number, std::size_t i) { c[i] = static_cast<T>(guess_[number]); });
    return report;
  }

  /// Continues c smoothly to the other side: up to `reach` nodes along the lines of the lattice that cross the
  /// interface, by cubic polynomials through the data of the last solve(). \return number of nodes that got a value
  std::size_t continue_beyond(Field<T, D>& c, std::ptrdiff_t reach = 3) {
    detail::require_lattice(c, lattice_, name);
    read_solution(c);
    const auto& values = continuation_.find(levels_.domain(), levels_.finest().x.data(), data_, reach);
    for (const auto& value : values) c(value.node) = static_cast<T>(value.sum / value.weight);
    forget_solution();
    return values.size();
  }

  /// dc/dn on the side of the domain, n = grad phi / |grad phi|, at the closest point of every node of the band that
  /// has one (0 at the others): an extension along normals. Takes c at the nodes of the domain alone, with the data of
  /// the last solve(). Of lower order where the lattice does not resolve the domain, or the gap to another part of it
  template <class K, class B>
  void normal_derivative(const NarrowBand<B, D>& band, const ClosestPoints<K, B, D>& points, const Field<T, D>& c,
                         Field<B, D, Sparse>& derivative, SlopeStencil slopes = SlopeStencil::cubic) {
    detail::require_lattice(c, lattice_, name);
    read_solution(c);
    take_blocks(derivative, band);
    auto& domain = levels_.domain();
    const double* const x = levels_.finest().x.data();
    continuation_.find(domain, levels_.finest().x.data(), data_, gradient_.reach);
    gradient_.differentiate(band, points, domain, x, data_, params_.side, slopes, derivative, execution_);
    forget_solution();
  }

 private:
  static constexpr const char* name = "Dirichlet problem";
  /// Of the solution that cubic terms are taken from: they are of the third order in h, and so must it be good to that.
  static constexpr double first_tolerance = 1e-7;

  /// Calls f(entry, number of the unknown, number of the node) for all unknowns.
  template <class F>
  void each_unknown_node(F&& f) const {
    for (const auto& run : levels_.finest().unknowns) {
      const std::size_t first = lattice_.number(run.node);
      for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i) {
        f(run.at + i, static_cast<std::size_t>(run.number) + i, first + i);
      }
    }
  }
  /// Calls f(entry, number of the node) for all nodes with data at walls.
  template <class F>
  void each_given_node(F&& f) const {
    const auto& domain = levels_.domain();
    bool any = false;
    for (int d = 0; d < D; ++d) {
      any = any || (domain.touches[static_cast<std::size_t>(d)] && domain.grid.given_faces(d));
    }
    if (!any) return;
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      const std::size_t at = domain.grid.at(lattice_.node(i));
      if (domain.kind[at] == detail::given) f(at, i);
    }
  }
  /// right_ := h^2 f and the data at walls; guess_ := c
  void read_problem(const Field<T, D>& f, const Field<T, D>& c) {
    each_unknown_node([&](std::size_t, std::size_t number, std::size_t i) {
      guess_[number] = detail::finite_value(c, i, "the first guess");
      right_[number] = detail::finite_value(f, i, "the right-hand side");
    });
    // The residual of zero, with x zero but at the walls, is the right-hand side with the data at walls in it.
    const double square = lattice_.spacing() * lattice_.spacing();
    set_unknowns(nullptr);
    set_walls(c);
    find_residual(levels_.finest(), execution_);
    each_given_node([&](std::size_t at, std::size_t) { levels_.finest().x[at] = 0.0; });
    scale_.assign(unknowns(), square);
    weights_.clear();
    const auto& domain = levels_.domain();
    number_.resize(domain.nodes.size());
    std::size_t next = 0;
    detail::for_each_unknown(levels_.finest(), Serial{}, [&](std::size_t at, std::size_t number) {
      if (domain.kind[at] != detail::cut) return;
      const auto& weights =
          weights_.emplace_back(domain.nodes[next], levels_.finest().diagonal, params_.shift * square);
      scale_[number] = square * weights.scale;
      number_[next++] = number;
    });
    detail::for_each_unknown(levels_.finest(), execution_, [&](std::size_t at, std::size_t number) {
      right_[number] = scale_[number] * right_[number] + levels_.finest().r[at];
    });
  }
  /// right_ += data on the interface, which data_ keeps.
  template <class G>
  void add_interface(G&& g) {
    const auto& nodes = levels_.domain().nodes;
    data_.assign(nodes.size() * 2 * D, 0.0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (std::size_t k = 0; k < 2 * D; ++k) {
        if (nodes[i].leg[k] < 0.0) continue;
        Vec<D> x = lattice_.position(nodes[i].node);
        x[static_cast<int>(k / 2)] += (k % 2 == 0 ? -1.0 : 1.0) * nodes[i].leg[k] * lattice_.spacing();
        const auto value = static_cast<double>(g(x));
        if (!std::isfinite(value)) {
          throw ValueError(detail::message("the datum on the interface is ", value, " at ", x, ": it must be finite"));
        }
        data_[2 * D * i + k] = value;
        right_[number_[i]] += weights_[i].leg[k] * value;
      }
    }
  }

  /// The row of a cut node with legs a and b along an axis has (b - a) / 3 d^3c/dx^3 too much: right_ -= that, with the
  /// third differences of guess_ at the node and the three behind it. Parts that are thinner are left as they are.
  void add_cubic_terms() {
    set_unknowns(guess_.data());
    const auto& domain = levels_.domain();
    const auto& x = levels_.finest().x;
    for (std::size_t i = 0; i < domain.nodes.size(); ++i) {
      for (std::size_t k = 0; k < 2 * D; ++k) {
        const double leg = domain.nodes[i].leg[k];
        if (leg < 0.0) continue;
        if (const auto third = third_difference(domain, x.data(), domain.nodes[i], k)) {
          right_[number_[i]] -= weights_[i].scale * (leg - 1.0) / 3.0 * *third;
        }
      }
    }
    set_unknowns(nullptr);
  }
  /// Towards leg k, of a node and those behind it, if there are three that are not cut on the way.
  static std::optional<double> third_difference(const detail::CutDomain<D>& domain, const double* x,
                                                const detail::CutNode<D>& start, std::size_t k) {
    static constexpr std::array<double, 4> weight{1.0, -3.0, 3.0, -1.0};
    double sum = x[start.at];
    Index<D> node = start.node;
    for (std::size_t m = 1; m < weight.size(); ++m) {
      if (domain.leg(node, k ^ 1) >= 0.0) return {};
      node = domain.neighbour(node, k ^ 1);
      const std::size_t at = domain.grid.at(node);
      if (domain.kind[at] == detail::given) return {};
      sum += weight[m] * x[at];
    }
    return sum;
  }

  SolveReport solve_equations(double tolerance) {
    // Functions of one type: the loops are compiled once for all problems.
    using Operator = std::function<void(const double*, double*)>;
    const Operator apply = [this](const double* in, double* out) { apply_equations(in, out); };
    const Operator cycle = [this](const double* in, double* out) { precondition(in, out); };
    return solve_krylov<Krylov, double>(apply, cycle, std::span<const double>(right_), std::span<double>(guess_),
                                        {tolerance, params_.most_iterations}, krylov_);
  }
  /// x of the finest level at walls := c, if all is finite.
  void set_walls(const Field<T, D>& c) {
    each_given_node([&](std::size_t, std::size_t i) { detail::finite_value(c, i, "the datum at a wall"); });
    each_given_node([&](std::size_t at, std::size_t i) { levels_.finest().x[at] = static_cast<double>(c[i]); });
  }
  /// x of the finest level := values, or zero.
  void set_unknowns(const double* values) {
    detail::for_each_unknown(levels_.finest(), execution_, [&](std::size_t at, std::size_t number) {
      levels_.finest().x[at] = values ? values[number] : 0.0;
    });
  }
  void apply_equations(const double* in, double* out) {
    set_unknowns(in);
    find_residual(levels_.finest(), execution_);
    detail::for_each_unknown(levels_.finest(), execution_,
                             [&](std::size_t at, std::size_t number) { out[number] = -levels_.finest().r[at]; });
  }
  void precondition(const double* in, double* out) {
    auto& level = levels_.hierarchy().finest();
    detail::for_each_unknown(level, execution_, [&](std::size_t at, std::size_t number) {
      level.b[at] = static_cast<float>(in[number]);
      level.x[at] = 0.0F;
    });
    levels_.hierarchy().cycle({params_.before, params_.after, std::is_same_v<Krylov, ConjugateGradient>});
    detail::for_each_unknown(
        level, execution_, [&](std::size_t at, std::size_t number) { out[number] = static_cast<double>(level.x[at]); });
  }
  /// x of the finest level := c
  void read_solution(const Field<T, D>& c) {
    if (data_.size() != levels_.domain().nodes.size() * 2 * D) {
      throw ValueError("there are no data on the interface yet: call solve() after the interface has moved");
    }
    each_unknown_node([&](std::size_t at, std::size_t, std::size_t i) {
      levels_.finest().x[at] = detail::finite_value(c, i, "the solution");
    });
    set_walls(c);
  }
  /// Only unknowns differ from zero in what the equations are applied to.
  void forget_solution() {
    continuation_.forget(levels_.domain(), levels_.finest().x.data());
    each_given_node([&](std::size_t at, std::size_t) { levels_.finest().x[at] = 0.0; });
  }

  Lattice<D> lattice_;
  Params params_;
  E execution_;
  detail::DirichletLevels<D, S, E> levels_;
  KrylovSpace<Krylov, double, E> krylov_;
  detail::Continuation<D> continuation_;
  detail::InterfaceGradient<D> gradient_;
  std::vector<detail::CutWeights<D>> weights_;
  std::vector<std::size_t> number_;  ///< unknowns that the cut nodes are
  std::vector<double> data_;         ///< values on the interface at the legs of the cut nodes
  AlignedVector<double> right_, guess_, scale_;
};

}  // namespace cambium
