// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include <cambium/core/field.hpp>
#include <cambium/interface/aggregation_cycle.hpp>
#include <cambium/interface/cell_domain.hpp>
#include <cambium/interface/checked_fields.hpp>
#include <cambium/interface/face_flux.hpp>
#include <cambium/parallel/compensated_sum.hpp>
#include <cambium/poisson/mean_part.hpp>

namespace cambium {

/// (s - Lap) u = f on one side of an interface with du/dn = q on it, n = grad phi / |grad phi|: conservative.
///
///     cambium::Neumann<2> problem(level_set.band(), {.shift = 1.0});
///     problem.solve(f, [](const Vec<2>&) { return 0.0; }, u);
///
/// Balances of the cells around the nodes, as far as they lie on the side (CellGeometry): what leaves a cell enters its
/// neighbour, so that s * total(u) = total(f) + the flux through the interface, to round-off, in every part of the
/// domain. Cells of nodes just beyond the interface are unknowns, too: u and f are read and written there as smooth
/// continuations. Small cells are harmless. Second order, wherever the lattice cuts the shape. Walls of the box that
/// the domain reaches are closed (du/dn = 0), periodic axes wrap. A Krylov loop in double precision, preconditioned by
/// one multigrid cycle in single precision. No number of threads changes a bit.
///
/// \tparam Flux  FaceCentroid or FaceCentre
template <int D, class Flux = FaceCentroid, class T = double, Execution E = OpenMP>
class Neumann {
 public:
  static_assert(D == 2 || D == 3, "cambium::Neumann: the dimension must be 2 or 3");
  static constexpr int dimension = D;

  struct Params {
    Side side = Side::inside;
    double shift = 0.0;       ///< s, in 1/length^2
    double tolerance = 1e-9;  ///< of the residual, relative to the right-hand side
    int most_iterations = 100;
    MeanPart mean = MeanPart::reject;  ///< what to do, for s = 0, where f and q do not balance in a part of the domain
    double mean_tolerance = 1e-8;      ///< of the imbalance, relative to what f and q bring in and out
  };

  /// \throws ValueError if s is negative or not finite; InterfaceError if the side has no cell, one without an open
  /// face
  ///         (a domain of one node), or the interface is within two spacings of a wall
  template <class B>
  explicit Neumann(const NarrowBand<B, D>& band) : Neumann(band, Params{}) {}
  template <class B>
  Neumann(const NarrowBand<B, D>& band, const Params& params, const E& execution = {})
      : lattice_(band.lattice()),
        params_(params),
        execution_(execution),
        domain_(band, params.side, require_shift(params.shift), execution),
        fluxes_(domain_.faces, domain_.cells),
        cycle_(execution),
        krylov_(execution),
        sum_(parts()),
        gross_(parts()),
        excess_(parts()) {
    cycle_.take(domain_.cells);
  }

  const Lattice<D>& lattice() const { return lattice_; }
  const Params& params() const { return params_; }
  std::size_t unknowns() const { return domain_.unknowns.size(); }
  /// Parts of the domain that no open face connects.
  std::size_t parts() const { return domain_.volume_of_part.size(); }
  /// Share of the cell around a node that is in the domain, in [0, 1].
  double share(const Index<D>& node) const { return domain_.share[domain_.cells.grid.at(node)]; }
  /// Volume of the domain, and area of the interface.
  double volume() const { return sum_of_parts(domain_.volume_of_part) * cell(); }
  double area() const {
    CompensatedSum sum;
    for (const auto& piece : domain_.pieces) sum += piece.area;
    return sum.value() * cell() / lattice_.spacing();
  }
  /// Integral of a field over the domain, as the balances count it. \throws SizeError; ValueError
  double total(const Field<T, D>& u) const {
    detail::require_lattice(u, lattice_, name);
    CompensatedSum sum;
    for (const auto& k : domain_.unknowns) sum += domain_.share[k.at] * detail::finite_value(u, k.node, "the field");
    return sum.value() * cell();
  }
  /// Integral of q over the interface.
  template <class Q>
  double through_interface(Q&& q) const {
    CompensatedSum sum;
    for (const auto& piece : domain_.pieces) sum += piece.area * datum(q, piece);
    return sum.value() * cell() / lattice_.spacing();
  }

  /// \param f  right-hand side, read at unknowns
  /// \param q  q(x) is du/dn at the point x of the interface
  /// \param u  holds the first guess, becomes the solution at the unknowns and stays as it is at all other nodes; its
  ///           mean over each part of the domain is 0 where s = 0
  /// \throws SizeError if a field is not on the lattice; ValueError if a value is not finite, or, for s = 0, if f and q
  ///         do not balance (see Params::mean); ConvergenceError. u is unchanged then
  template <class Q>
  SolveReport solve(const Field<T, D>& f, Q&& q, Field<T, D>& u) {
    detail::require_lattice(f, lattice_, name);
    detail::require_lattice(u, lattice_, name);
    right_.resize(unknowns());
    const double square = lattice_.spacing() * lattice_.spacing();
    for (std::size_t k = 0; k < unknowns(); ++k) {
      right_[k] = square * domain_.share[domain_.unknowns[k].at] *
                  detail::finite_value(f, domain_.unknowns[k].node, "the right-hand side");
    }
    add_interface(q);
    return solve_balances(u);
  }
  /// out := -Lap u in every cell with du/dn = q on the interface: the flux out of the cell over its volume.
  /// \throws SizeError; ValueError
  template <class Q>
  void negative_laplacian(const Field<T, D>& u, Q&& q, Field<T, D>& out) {
    detail::require_lattice(u, lattice_, name);
    detail::require_lattice(out, lattice_, name);
    find_outflow(u);
    right_.assign(unknowns(), 0.0);
    add_interface(q);
    const double square = lattice_.spacing() * lattice_.spacing();
    for (std::size_t k = 0; k < unknowns(); ++k) {
      const double share = domain_.share[domain_.unknowns[k].at];
      out[domain_.unknowns[k].node] = share > 0.0 ? static_cast<T>((outflow_[k] - right_[k]) / (square * share)) : T(0);
    }
  }
  /// One step of size dt of du/dt = diffusivity Lap u + source with diffusivity du/dn = q, by the theta rule: theta = 1
  /// is Euler's, 1/2 Crank and Nicolson's. The total changes by dt (source + q) to round-off. To be asked of an object
  /// with s = 1 / (theta diffusivity dt). \throws ValueError if s is another or theta out of (0, 1]; as solve()
  template <class Q>
  SolveReport step(Field<T, D>& u, const Field<T, D>& source, Q&& q, double diffusivity, double dt, double theta) {
    detail::require_lattice(u, lattice_, name);
    detail::require_lattice(source, lattice_, name);
    if (!(theta > 0.0 && theta <= 1.0) || !(std::abs(params_.shift * theta * diffusivity * dt - 1.0) < 1e-9)) {
      throw ValueError(detail::message("a step with theta ", theta, ", diffusivity ", diffusivity, " and dt ", dt,
                                       " needs theta in (0, 1] and the shift 1 / (theta diffusivity dt), which is not ",
                                       params_.shift, ": make the object with that shift"));
    }
    const double square = lattice_.spacing() * lattice_.spacing();
    right_.assign(unknowns(), 0.0);
    add_interface(q);
    find_outflow(u);
    for (std::size_t k = 0; k < unknowns(); ++k) {
      const auto [at, node] = domain_.unknowns[k];
      const double added = square * domain_.share[at] * detail::finite_value(source, node, "the source");
      right_[k] = (right_[k] + added) / (theta * diffusivity) - (1.0 - theta) / theta * outflow_[k] +
                  domain_.cells.mass[at] * static_cast<double>(u[node]);
    }
    return solve_balances(u);
  }

 private:
  static constexpr const char* name = "Neumann problem";

  double cell() const { return std::pow(lattice_.spacing(), D); }
  double outward() const { return params_.side == Side::inside ? 1.0 : -1.0; }

  static double require_shift(double shift) {
    if (shift >= 0.0 && std::isfinite(shift)) return shift;
    throw ValueError(detail::message("the shift s of s - Lap is ", shift, ": it must be finite and >= 0"));
  }
  template <class Q>
  double datum(Q&& q, const detail::WallPiece<D>& piece) const {
    const Vec<D> x = lattice_.position(piece.node) + lattice_.spacing() * piece.middle;
    const auto value = static_cast<double>(q(x));
    if (!std::isfinite(value)) {
      throw ValueError(detail::message("the flux through the interface is ", value, " at ", x, ": it must be finite"));
    }
    return value;
  }
  /// right_ += h times the integral of q over the interface in each cell, in spacings^D.
  template <class Q>
  void add_interface(Q&& q) {
    for (const auto& piece : domain_.pieces) {
      right_[domain_.number[domain_.cells.grid.at(piece.node)]] +=
          outward() * lattice_.spacing() * piece.area * datum(q, piece);
    }
  }
  static double sum_of_parts(const std::vector<double>& parts) {
    double sum = 0.0;
    for (const double part : parts) sum += part;
    return sum;
  }

  /// out := A in
  void apply(const double* in, double* out) {
    for (std::size_t k = 0; k < unknowns(); ++k) domain_.cells.x[domain_.unknowns[k].at] = in[k];
    domain_.cells.grid.continue_values(domain_.cells.x.data(), execution_);
    domain_.cells.for_each_row(execution_, [&](const Index<D>&, std::size_t start) {
      for (std::size_t at = start; at < start + static_cast<std::size_t>(domain_.cells.grid.nodes[0]); ++at) {
        if (domain_.cells.inverse[at] > 0.0) {
          domain_.cells.b[at] = domain_.cells.diagonal(at) * domain_.cells.x[at] -
                                domain_.cells.of_neighbours(at, domain_.cells.x.data());
        }
      }
    });
    fluxes_.add(domain_.cells, domain_.cells.x.data(), domain_.cells.b.data());
    for (std::size_t k = 0; k < unknowns(); ++k) out[k] = domain_.cells.b[domain_.unknowns[k].at];
  }
  /// outflow_ := what flows out of each cell by diffusion alone, in spacings^D.
  void find_outflow(const Field<T, D>& u) {
    solution_.resize(unknowns());
    outflow_.resize(unknowns());
    for (std::size_t k = 0; k < unknowns(); ++k) {
      solution_[k] = detail::finite_value(u, domain_.unknowns[k].node, "the field");
    }
    apply(solution_.data(), outflow_.data());
    for (std::size_t k = 0; k < unknowns(); ++k) {
      outflow_[k] -= domain_.cells.mass[domain_.unknowns[k].at] * solution_[k];
    }
  }
  void precondition(const double* in, double* out) {
    auto& level = cycle_.finest();
    for (std::size_t k = 0; k < unknowns(); ++k) level.b[domain_.unknowns[k].at] = static_cast<float>(in[k]);
    cycle_();
    for (std::size_t k = 0; k < unknowns(); ++k) out[k] = static_cast<double>(level.x[domain_.unknowns[k].at]);
  }

  SolveReport solve_balances(Field<T, D>& u) {
    if (params_.shift == 0.0) balance();
    solution_.resize(unknowns());
    for (std::size_t k = 0; k < unknowns(); ++k) {
      solution_[k] = detail::finite_value(u, domain_.unknowns[k].node, "the first guess");
    }
    using Operator = std::function<void(const double*, double*)>;
    const Operator product = [this](const double* in, double* out) { apply(in, out); };
    const Operator cycle = [this](const double* in, double* out) { precondition(in, out); };
    SolveReport report = solve_krylov<typename Flux::Krylov, double>(
        product, cycle, std::span<const double>(right_), std::span<double>(solution_),
        {params_.tolerance, params_.most_iterations}, krylov_);
    fix_totals();
    for (std::size_t k = 0; k < unknowns(); ++k) u[domain_.unknowns[k].node] = static_cast<T>(solution_[k]);
    return report;
  }
  /// Checks that what enters the parts of the domain leaves them, and spreads the rest.
  void balance() {
    std::ranges::fill(sum_, 0.0);
    std::ranges::fill(gross_, 0.0);
    for (std::size_t k = 0; k < unknowns(); ++k) {
      sum_[domain_.part[k]] += right_[k];
      gross_[domain_.part[k]] += std::abs(right_[k]);
    }
    for (std::size_t p = 0; p < parts(); ++p) {
      if (params_.mean == MeanPart::subtract || !(std::abs(sum_[p]) > params_.mean_tolerance * gross_[p])) continue;
      const double unit = cell() / (lattice_.spacing() * lattice_.spacing());
      throw ValueError(detail::message("the sources in part ", p,
                                       " of the domain and the flux through its interface sum to ", sum_[p] * unit,
                                       " (", gross_[p] * unit,
                                       " without signs), but for -Lap u = f with "
                                       "du/dn given they must balance: change them, or ask for MeanPart::subtract"));
    }
    for (std::size_t k = 0; k < unknowns(); ++k) {
      right_[k] -=
          sum_[domain_.part[k]] / domain_.volume_of_part[domain_.part[k]] * domain_.share[domain_.unknowns[k].at];
    }
  }
  /// Moves the solution in each part by a constant, so that the total is what the balances say and not what the
  /// tolerance leaves; where they do not fix it, so that it is zero.
  void fix_totals() {
    const double square = params_.shift * lattice_.spacing() * lattice_.spacing();
    std::ranges::fill(excess_, CompensatedSum{});
    for (std::size_t k = 0; k < unknowns(); ++k) {
      excess_[domain_.part[k]] += domain_.share[domain_.unknowns[k].at] * solution_[k];
      if (square > 0.0) excess_[domain_.part[k]] += -right_[k] / square;
    }
    for (std::size_t k = 0; k < unknowns(); ++k) {
      solution_[k] -= excess_[domain_.part[k]].value() / domain_.volume_of_part[domain_.part[k]];
    }
  }

  Lattice<D> lattice_;
  Params params_;
  E execution_;
  detail::CellDomain<D> domain_;
  typename Flux::template Method<D> fluxes_;
  detail::AggregationCycle<D, E> cycle_;
  KrylovSpace<typename Flux::Krylov, double, E> krylov_;
  std::vector<double> right_, solution_, outflow_;
  std::vector<double> sum_, gross_;  ///< of the right-hand side, for each part of the domain
  std::vector<CompensatedSum> excess_;
};

}  // namespace cambium
