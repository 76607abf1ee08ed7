// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include <cambium/core/field.hpp>
#include <cambium/interface/continuation.hpp>
#include <cambium/interface/cut_domain.hpp>
#include <cambium/levelset/band_field.hpp>
#include <cambium/levelset/closest_point_walk.hpp>
#include <cambium/levelset/geometry/surface_geometry.hpp>
#include <cambium/multigrid/hierarchy.hpp>
#include <cambium/multigrid/krylov.hpp>
#include <cambium/multigrid/red_black.hpp>

namespace cambium {

/// (s - Lap) c = f on one side of an interface with c = g on it.
///
///     cambium::Dirichlet<3> nutrient(level_set.band(), {.side = cambium::Side::inside, .shift = 1.0});
///     nutrient.solve(f, [](const Vec<3>&) { return 1.0; }, c);
///
/// Stencils whose legs the interface cuts are those of quadratic polynomials through the crossings (see CutWeights),
/// which lie on the zero set of the interpolant of Lambda<4, 4>: second order in c and in its gradient, up to the
/// interface, wherever the lattice cuts it. The equations, which are not symmetric, are solved by a Krylov loop in
/// double precision that one multigrid cycle in single precision preconditions. Where the domain reaches the faces of
/// the box, they are periodic as the lattice is, mirror (Neumann), or have values given in c. The Krylov loop takes its
/// vectors anew in every call; all else is kept. No number of threads changes a bit.
template <int D, class T = double, class Krylov = BiCGStab, class S = RedBlack, Execution E = OpenMP>
class Dirichlet {
 public:
  static_assert(D == 2 || D == 3, "cambium::Dirichlet: the dimension must be 2 or 3");
  static constexpr int dimension = D;
  using Kernel = Lambda<4, 4>;

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
      : lattice_(band.lattice()), params_(params), execution_(execution), hierarchy_(params.smoother, execution) {
    check_smoother<S>();
    if (!(params.shift >= 0.0) || !std::isfinite(params.shift)) {
      throw ValueError(detail::message("the shift s of s - Lap is ", params.shift, ": it must be finite and >= 0"));
    }
    update(band);
  }

  const Lattice<D>& lattice() const { return lattice_; }
  const Params& params() const { return params_; }
  /// Nodes where c is sought.
  std::size_t unknowns() const { return static_cast<std::size_t>(finest_.count); }
  /// True if c is sought or given at a node.
  bool in_domain(const Index<D>& node) const { return domains_.front().in_domain(node); }

  /// Takes an interface that has moved. \throws SizeError if its lattice is another; InterfaceError if the side has no
  /// node. After a throw update() is to be called again.
  template <class B>
  void update(const NarrowBand<B, D>& band) {
    if (!(band.lattice() == lattice_)) {
      throw SizeError("the level set is not on the lattice of this Dirichlet problem: make one for each lattice");
    }
    domains_.clear();
    auto& domain = domains_.emplace_back(detail::LevelGrid<D>(lattice_.nodes(), lattice_.periodic(), params_.walls));
    find_kinds(band, params_.side, domain, execution_);
    domain.find_given();
    if (domain.unknowns == 0) {
      throw InterfaceError(
          "the side of the interface on which an equation is to be solved has no node: the shape is "
          "smaller than a spacing; refine the lattice or leave the equation out");
    }
    detail::find_crossings<Kernel>(band, domain, execution_);
    make_levels();
  }

  /// \param f  right-hand side, read at nodes of the domain
  /// \param g  g(x) is the value at the point x of the interface
  /// \param c  holds the first guess (a solution at the last step is a good one), and the data at Dirichlet walls;
  ///           becomes the solution at nodes of the domain and stays as it is at all others
  /// \throws SizeError if a field is not on the lattice; ValueError if a value is not finite; ConvergenceError with the
  ///         residuals on the way; c is unchanged then
  template <class G>
  SolveReport solve(const Field<T, D>& f, G&& g, Field<T, D>& c) {
    require_lattice(f);
    require_lattice(c);
    right_.assign(unknowns(), 0.0);
    guess_.resize(unknowns());
    read_problem(f, c);
    add_interface(g);
    // Functions of one type: the loops are compiled once for all problems.
    using Operator = std::function<void(const double*, double*)>;
    const Operator apply = [this](const double* in, double* out) { apply_equations(in, out); };
    const Operator cycle = [this](const double* in, double* out) { precondition(in, out); };
    SolveReport report =
        solve_krylov<Krylov, double>(apply, cycle, std::span<const double>(right_), std::span<double>(guess_),
                                     {params_.tolerance, params_.most_iterations});
    each_unknown_node([&](std::size_t, std::size_t number, std::size_t i) { c[i] = static_cast<T>(guess_[number]); });
    return report;
  }

  /// Continues c smoothly to the other side: up to `reach` nodes along the lines of the lattice that cross the
  /// interface, by cubic polynomials through the data of the last solve(). \return number of nodes that got a value
  std::size_t continue_beyond(Field<T, D>& c, std::ptrdiff_t reach = 3) {
    require_lattice(c);
    read_solution(c);
    const auto& values = continuation_.find(domains_.front(), finest_.x.data(), data_, reach);
    for (const auto& value : values) c(value.node) = static_cast<T>(value.sum / value.weight);
    forget_solution();
    return values.size();
  }

  /// dc/dn on the side of the domain, n = grad phi / |grad phi|, at the closest point of every node of the band that
  /// has one (0 at the others): an extension along normals. Takes c at the nodes of the domain alone, with the data of
  /// the last solve(). \throws InterfaceError if the domain is too thin for a gradient there; `derivative` may be
  /// changed
  template <class K, class B>
  void normal_derivative(const NarrowBand<B, D>& band, const ClosestPoints<K, B, D>& points, const Field<T, D>& c,
                         Field<B, D, Sparse>& derivative) {
    require_lattice(c);
    read_solution(c);
    take_blocks(derivative, band);
    auto& domain = domains_.front();
    continuation_.find(domain, finest_.x.data(), data_, gradient_reach);
    try {
      differentiate(band, points, derivative);
    } catch (...) {
      forget_solution();
      throw;
    }
    forget_solution();
  }

 private:
  /// Nodes beyond the interface that differences at the corners of the cells of closest points need, along an axis.
  static constexpr std::ptrdiff_t gradient_reach = D + 2;

  void make_levels() {
    const double square = lattice_.spacing() * lattice_.spacing();
    double shift = params_.shift * square;
    take_domain(domains_.front(), shift, finest_);
    finest_.take_arrays();
    auto& levels = hierarchy_.levels();
    levels.clear();
    for (std::size_t l = 0;; ++l) {
      auto& level = levels.emplace_back(domains_[l].grid);
      take_domain(domains_[l], shift, level);
      if (level.count <= hierarchy_.few_unknowns || !coarsen_last()) break;
      shift *= 4.0;
    }
    hierarchy_.settle(false);
    domains_.erase(domains_.begin() + 1, domains_.end());
  }
  /// Adds a coarser domain. \return false if there is none
  bool coarsen_last() {
    const detail::CutDomain<D>& fine = domains_.back();
    Index<D> nodes;
    for (int d = 0; d < D; ++d) {
      const bool periodic = fine.grid.periodic[d];
      const std::ptrdiff_t cells = fine.grid.nodes[d] - (periodic ? 0 : 1);
      if (cells < 4 || (cells % 2 != 0 && (periodic || fine.touches[static_cast<std::size_t>(d)]))) return false;
      nodes[d] = (cells + 1) / 2 + (periodic ? 0 : 1);
    }
    auto coarse = detail::coarsen(fine, detail::LevelGrid<D>(nodes, fine.grid.periodic, fine.grid.walls));
    // Without crossings the coarse equations might be singular.
    if (coarse.unknowns == 0 || coarse.nodes.empty()) return false;
    domains_.push_back(std::move(coarse));
    return true;
  }

  void require_lattice(const Field<T, D>& field) const {
    if (field.lattice() == lattice_) return;
    throw SizeError("a field is not on the lattice of this Dirichlet problem: make one for each lattice");
  }
  double finite(T value, std::size_t i, const char* what) const {
    if (!std::isfinite(value)) {
      throw ValueError(detail::message(what, " is ", value, " at ", lattice_.position(lattice_.node(i)),
                                       ": every value must be finite"));
    }
    return static_cast<double>(value);
  }
  /// Calls f(entry, number of the unknown, number of the node) for all unknowns.
  template <class F>
  void each_unknown_node(F&& f) const {
    for (const auto& run : finest_.unknowns) {
      const std::size_t first = lattice_.number(run.node);
      for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i) {
        f(run.at + i, static_cast<std::size_t>(run.number) + i, first + i);
      }
    }
  }
  /// Calls f(entry, number of the node) for all nodes with data at walls.
  template <class F>
  void each_given_node(F&& f) const {
    const auto& domain = domains_.front();
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
      guess_[number] = finite(c[i], i, "the first guess");
      right_[number] = finite(f[i], i, "the right-hand side");
    });
    // The residual of zero, with x zero but at the walls, is the right-hand side with the data at walls in it.
    const double square = lattice_.spacing() * lattice_.spacing();
    set_unknowns(nullptr);
    each_given_node([&](std::size_t at, std::size_t i) { finest_.x[at] = finite(c[i], i, "the datum at a wall"); });
    find_residual(finest_, execution_);
    each_given_node([&](std::size_t at, std::size_t) { finest_.x[at] = 0.0; });
    scale_.assign(unknowns(), square);
    weights_.clear();
    const auto& domain = domains_.front();
    number_.resize(domain.nodes.size());
    std::size_t next = 0;
    detail::for_each_unknown(finest_, Serial{}, [&](std::size_t at, std::size_t number) {
      if (domain.kind[at] != detail::cut) return;
      const auto& weights = weights_.emplace_back(domain.nodes[next], finest_.diagonal, params_.shift * square);
      scale_[number] = square * weights.scale;
      number_[next++] = number;
    });
    detail::for_each_unknown(finest_, execution_, [&](std::size_t at, std::size_t number) {
      right_[number] = scale_[number] * right_[number] + finest_.r[at];
    });
  }
  /// right_ += data on the interface, which data_ keeps.
  template <class G>
  void add_interface(G&& g) {
    const auto& nodes = domains_.front().nodes;
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

  /// x of the finest level := values, or zero.
  void set_unknowns(const double* values) {
    detail::for_each_unknown(finest_, execution_, [&](std::size_t at, std::size_t number) {
      finest_.x[at] = values ? values[number] : 0.0;
    });
  }
  void apply_equations(const double* in, double* out) {
    set_unknowns(in);
    find_residual(finest_, execution_);
    detail::for_each_unknown(finest_, execution_,
                             [&](std::size_t at, std::size_t number) { out[number] = -finest_.r[at]; });
  }
  void precondition(const double* in, double* out) {
    auto& level = hierarchy_.finest();
    detail::for_each_unknown(level, execution_, [&](std::size_t at, std::size_t number) {
      level.b[at] = static_cast<float>(in[number]);
      level.x[at] = 0.0F;
    });
    hierarchy_.cycle({params_.before, params_.after, std::is_same_v<Krylov, ConjugateGradient>});
    detail::for_each_unknown(
        level, execution_, [&](std::size_t at, std::size_t number) { out[number] = static_cast<double>(level.x[at]); });
  }
  /// x of the finest level := c
  void read_solution(const Field<T, D>& c) {
    if (data_.size() != domains_.front().nodes.size() * 2 * D) {
      throw ValueError("there are no data on the interface yet: call solve() after the interface has moved");
    }
    each_unknown_node(
        [&](std::size_t at, std::size_t, std::size_t i) { finest_.x[at] = finite(c[i], i, "the solution"); });
    each_given_node([&](std::size_t at, std::size_t i) { finest_.x[at] = finite(c[i], i, "the datum at a wall"); });
  }
  /// Only unknowns differ from zero in what the equations are applied to.
  void forget_solution() {
    continuation_.forget(domains_.front(), finest_.x.data());
    each_given_node([&](std::size_t at, std::size_t) { finest_.x[at] = 0.0; });
  }

  template <class K, class B>
  void differentiate(const NarrowBand<B, D>& band, const ClosestPoints<K, B, D>& points,
                     Field<B, D, Sparse>& derivative) {
    std::vector<Patch<B, D>> patches(static_cast<std::size_t>(execution_.count()));
    for_each_piece_by_worker(execution_, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      Patch<B, D>& patch = patches[worker];
      const auto values = derivative.block(b);
      const auto at = [&](std::size_t i, const Vec<D, B>& u) {
        const Vec<D, B> n = surface_geometry(Interpolant<K, B, D>::jet(patch.data(), patch.stride(), u), B(1)).normal;
        Vec<D> place;
        for (int d = 0; d < D; ++d) {
          place[d] = static_cast<double>(band.values().node(b, i)[d]) + static_cast<double>(points.offset(b, i)[d]);
        }
        const Vec<D> gradient = gradient_at(place);
        double along = 0.0;
        for (int d = 0; d < D; ++d) along += gradient[d] * static_cast<double>(n[d]);
        values[i] = static_cast<B>(along);
      };
      detail::for_each_closest_point(points, band, b, band, patch, at, [&](std::size_t i) { values[i] = B(0); });
    });
  }
  /// \param place  in spacings from the first node of the lattice
  Vec<D> gradient_at(const Vec<D>& place) const {
    Vec<D> gradient;
    return of_cubics(place, gradient) ? gradient : of_differences(place);
  }
  /// Gradient of the product of cubic polynomials through the 4^D nodes around a place. \return false if one of them
  /// has no value
  bool of_cubics(const Vec<D>& place, Vec<D>& gradient) const {
    const auto& domain = domains_.front();
    std::array<std::array<double, 4>, D> value, slope;
    Index<D> first;
    for (int d = 0; d < D; ++d) {
      first[d] = static_cast<std::ptrdiff_t>(std::floor(place[d])) - 1;
      if (!lattice_.periodic(d) && (first[d] < 0 || first[d] + 3 >= lattice_.nodes()[d])) return false;
      const auto axis = static_cast<std::size_t>(d);
      cubic_weights(place[d] - static_cast<double>(first[d] + 1), value[axis], slope[axis]);
    }
    std::array<std::ptrdiff_t, 4> along;
    for (std::size_t i = 0; i < 4; ++i) {
      along[i] = lattice_.wrap(0, first[0] + static_cast<std::ptrdiff_t>(i)) - lattice_.wrap(0, first[0]);
    }
    gradient = {};
    for (std::size_t k = 0; k < std::size_t{1} << (2 * (D - 1)); ++k) {
      Index<D> node = first;
      node[0] = lattice_.wrap(0, first[0]);
      std::array<double, D> weight;
      weight.fill(1.0);
      for (int d = 1; d < D; ++d) {
        const std::size_t step = k >> (2 * (d - 1)) & 3;
        node[d] = lattice_.wrap(d, first[d] + static_cast<std::ptrdiff_t>(step));
        for (int e = 0; e < D; ++e) {
          const auto axis = static_cast<std::size_t>(d);
          weight[static_cast<std::size_t>(e)] *= (e == d ? slope : value)[axis][step];
        }
      }
      const std::size_t row = domain.grid.at(node);
      double sum = 0.0;
      double change = 0.0;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t at = row + static_cast<std::size_t>(along[i]);
        if (domain.kind[at] == detail::beyond) return false;
        sum += value[0][i] * finest_.x[at];
        change += slope[0][i] * finest_.x[at];
      }
      for (int d = 0; d < D; ++d) gradient[d] += weight[static_cast<std::size_t>(d)] * (d == 0 ? change : sum);
    }
    gradient /= lattice_.spacing();
    return true;
  }
  /// Those of the values at -1, 0, 1, 2 in the cubic polynomial through them at t, and in its derivative.
  static void cubic_weights(double t, std::array<double, 4>& value, std::array<double, 4>& slope) {
    value = {-t * (t - 1.0) * (t - 2.0) / 6.0, (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
             -(t + 1.0) * t * (t - 2.0) / 2.0, (t + 1.0) * t * (t - 1.0) / 6.0};
    slope = {-(3.0 * t * t - 6.0 * t + 2.0) / 6.0, (3.0 * t * t - 4.0 * t - 1.0) / 2.0,
             -(3.0 * t * t - 2.0 * t - 2.0) / 2.0, (3.0 * t * t - 1.0) / 6.0};
  }
  /// Centred differences, interpolated linearly, which need fewer nodes.
  Vec<D> of_differences(const Vec<D>& place) const {
    const auto& domain = domains_.front();
    Vec<D> gradient;
    Index<D> first;
    bool inner = true;
    for (int d = 0; d < D; ++d) {
      first[d] = static_cast<std::ptrdiff_t>(std::floor(place[d]));
      inner = inner && first[d] >= 1 && first[d] + 2 < lattice_.nodes()[d];
    }
    for (int corner = 0; corner < 1 << D; ++corner) {
      Index<D> node = first;
      double weight = 1.0;
      for (int d = 0; d < D; ++d) {
        const double part = place[d] - static_cast<double>(first[d]);
        const bool upper = (corner >> d) % 2 != 0;
        node[d] = lattice_.wrap(d, node[d] + (upper ? 1 : 0));
        weight *= upper ? part : 1.0 - part;
      }
      if (weight == 0.0) continue;
      const std::size_t at = domain.grid.at(node);
      for (std::size_t d = 0; d < D; ++d) {
        const auto step = static_cast<std::size_t>(domain.grid.stride[static_cast<int>(d)]);
        const std::size_t low = inner ? at - step : domain.grid.at(domain.neighbour(node, 2 * d));
        const std::size_t high = inner ? at + step : domain.grid.at(domain.neighbour(node, 2 * d + 1));
        if (domain.kind[low] == detail::beyond || domain.kind[high] == detail::beyond) fail_beside(node);
        gradient[static_cast<int>(d)] += weight * (finest_.x[high] - finest_.x[low]);
      }
    }
    return gradient / (2.0 * lattice_.spacing());
  }
  [[noreturn]] void fail_beside(const Index<D>& node) const {
    throw InterfaceError(detail::message("no line of the lattice continues the solution to all neighbours of node ",
                                         node,
                                         ", which the gradient at the interface needs: the domain is thinner "
                                         "than a few spacings there; refine the lattice"));
  }

  Lattice<D> lattice_;
  Params params_;
  E execution_;
  std::vector<detail::CutDomain<D>> domains_;  ///< the finest stays
  detail::Level<double, D> finest_{detail::LevelGrid<D>(lattice_.nodes(), lattice_.periodic(), params_.walls)};
  detail::Hierarchy<D, S, float, E> hierarchy_;
  detail::Continuation<D> continuation_;
  std::vector<detail::CutWeights<D>> weights_;
  std::vector<std::size_t> number_;  ///< unknowns that the cut nodes are
  std::vector<double> data_;         ///< values on the interface at the legs of the cut nodes
  AlignedVector<double> right_, guess_, scale_;
};

}  // namespace cambium
