// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <type_traits>

#include <cambium/core/field.hpp>
#include <cambium/poisson/box_transform.hpp>
#include <cambium/poisson/difference_symbol.hpp>
#include <cambium/poisson/face_values.hpp>
#include <cambium/poisson/mean_part.hpp>
#include <cambium/poisson/second_order.hpp>

namespace cambium {

/// Poisson's equation -Lap u = f, or (s - Lap) u = f, in a box whose axes are each periodic, or have values (Dirichlet)
/// or outward derivatives (Neumann) given on both faces, by Fourier, sine and cosine transforms; D = 2 and 3.
///
///     cambium::BoxPoisson<3> poisson(lattice, {Boundary::dirichlet, Boundary::neumann, Boundary::periodic});
///     poisson.solve(f, u);  // Dirichlet values are read from the face nodes of u
///
/// With SecondOrder the (2 D + 1)-point difference equations are solved to round-off; at a Neumann face the outer
/// neighbour is eliminated with the centred difference of the derivative, which keeps second order. Other symbols act
/// on the waves sin(pi k x / L), cos(pi k x / L) of the axis: FourthOrder and Spectral have their order if u continues
/// smoothly as an odd (Dirichlet) or even (Neumann) function across the faces, and take zero data alone.
///
/// f is not read at Dirichlet faces. Arguments and results may be the same field. A solve allocates nothing. Every
/// call \throws SizeError if a field is not on the lattice of the solver \throws ValueError if a value is not finite,
/// given data are not zero where they must be, or no solution exists (see Params), and leaves its result unchanged.
template <int D, class Symbol = SecondOrder, class T = double, Execution E = OpenMP>
class BoxPoisson {
 public:
  static constexpr int dimension = D;
  using Slopes = FaceValues<D, T>;

  struct Params {
    /// s >= 0 in (s - Lap) u = f, one over a squared length
    double shift = 0.0;
    /// What to do if there is no Dirichlet face, s = 0, and the sources do not balance the fluxes.
    MeanPart mean = MeanPart::reject;
    /// Means up to this, relative to the largest value, count as round-off: they are left out without a word.
    double mean_tolerance = sizeof(T) < sizeof(double) ? 1e-6 : 1e-10;
  };

  /// \throws LatticeError unless exactly the periodic axes of the lattice are Boundary::periodic, and every Dirichlet
  ///         axis has a node between its faces \throws ValueError if the shift is negative or not finite
  BoxPoisson(const Lattice<D>& lattice, const std::array<Boundary, D>& boundary)
      : BoxPoisson(lattice, boundary, Params{}) {}
  BoxPoisson(const Lattice<D>& lattice, const std::array<Boundary, D>& boundary, const Params& params,
             const E& execution = {})
      : lattice_(checked(lattice, boundary)),
        params_(params),
        execution_(execution),
        transform_(boundary, cells(lattice), execution) {
    check_difference_symbol<Symbol>();
    if (!(params.shift >= 0.0) || !std::isfinite(params.shift)) {
      throw ValueError(detail::message("shift is ", params.shift, ": it must be finite and not negative"));
    }
    singular_ = params.shift == 0.0;
    for (int d = 0; d < D; ++d) {
      singular_ = singular_ && boundary[d] != Boundary::dirichlet;
      tabulate(d);
    }
    if (singular_) rows_.resize(transform_.rows());
  }

  const Lattice<D>& lattice() const { return lattice_; }

  /// Solves with zero derivatives at Neumann faces. If the equation has solutions up to a constant, u has mean zero.
  /// \return the mean of f, which was left out; 0 if the equation has one solution
  double solve(const Field<T, D>& f, Field<T, D>& u) { return solve(f, nullptr, u); }
  /// The same with the outward derivatives `slopes` at Neumann faces. \return the mean of f plus that of the fluxes
  double solve(const Field<T, D>& f, const Slopes& slopes, Field<T, D>& u) { return solve(f, &slopes, u); }

 private:
  static const Lattice<D>& checked(const Lattice<D>& lattice, const std::array<Boundary, D>& boundary) {
    for (int d = 0; d < D; ++d) {
      if (lattice.periodic(d) != (boundary[d] == Boundary::periodic)) {
        throw LatticeError(detail::message("lattice is ", lattice.periodic(d) ? "periodic" : "bounded", " along axis ",
                                           d, " but the boundary condition is not: make them the same"));
      }
      if (boundary[d] == Boundary::dirichlet && lattice.nodes()[d] < 3) {
        throw LatticeError(detail::message("lattice has no node between the faces of axis ", d,
                                           ": a Dirichlet problem has nothing to solve for"));
      }
    }
    return lattice;
  }
  static Index<D> cells(const Lattice<D>& lattice) {
    Index<D> result = lattice.nodes();
    for (int d = 0; d < D; ++d) result[d] -= lattice.periodic(d) ? 0 : 1;
    return result;
  }

  /// The part of axis d in the symbol of s - Lap, times the norm of the transforms.
  void tabulate(int d) {
    const double h = lattice_.spacing();
    auto& table = symbol_[static_cast<std::size_t>(d)];
    const std::size_t size = transform_.line(d).size();
    for (std::size_t k = 0; k < size; ++k) {
      const double theta = transform_.line(d).phase(k);
      const double second = theta == 0.0 ? 0.0 : Symbol::second(theta);
      if (theta > 0.0 && !(second > 0.0)) {
        throw ValueError(detail::message("difference symbol has second(", theta, ") = ", second,
                                         ": it must be positive, or the Poisson equation has many solutions"));
      }
      table.push_back(static_cast<T>((second / (h * h) + (d == 0 ? params_.shift : 0.0)) * transform_.norm()));
    }
    while (d == 0 && table.size() % transform_.lines != 0) table.push_back(table.back());
  }

  double solve(const Field<T, D>& f, const Slopes* slopes, Field<T, D>& u) {
    if (!(f.lattice() == lattice_) || !(u.lattice() == lattice_) || (slopes && !(slopes->lattice() == lattice_))) {
      throw SizeError("a field is not on the lattice this Poisson solver was made for: make one solver per lattice");
    }
    load(f, slopes, u);
    const double mean = singular_ ? examine_mean() : 0.0;
    transform_.change_waves([&](const Index<D>& m, T* tile) { divide(m, tile); });
    transform_.to_nodes([&](const Index<D>& row, const T* values) {
      std::copy_n(values, transform_.sizes()[0], u.data() + lattice_.number(row + first_node()));
    });
    return mean;
  }

  Index<D> first_node() const {
    Index<D> result;
    for (int d = 0; d < D; ++d) result[d] = static_cast<std::ptrdiff_t>(transform_.line(d).first());
    return result;
  }

  /// Transforms right-hand sides, with what is known moved to them, along all axes but the last. \throws ValueError if
  /// a number is not finite
  void load(const Field<T, D>& f, const Slopes* slopes, const Field<T, D>& u) {
    std::atomic<bool> finite = true;
    std::atomic<bool> zero = true;
    transform_.to_waves([&](const Index<D>& row, T* values) {
      const std::ptrdiff_t count = transform_.sizes()[0];
      std::copy_n(f.data() + lattice_.number(row + first_node()), count, values);
      for (int d = 0; d < D; ++d) {
        if (!add_faces(d, row, slopes, u, values)) zero = false;
      }
      bool good = true;
      for (std::ptrdiff_t i = 0; i < count; ++i) good &= std::abs(values[i]) <= std::numeric_limits<T>::max();
      if (!good) finite = false;
      if (singular_) rows_[row_number(row)] = weigh(row, values);
    });
    if (!finite) {
      throw ValueError(
          "a right-hand side, Dirichlet value or Neumann derivative of a Poisson equation is not finite, or their sum "
          "overflows: every value must be finite");
    }
    if (!zero && !std::is_same_v<Symbol, SecondOrder>) {
      throw ValueError(
          "boundary data are not zero: only SecondOrder takes other Dirichlet values and Neumann derivatives");
    }
  }

  /// Adds the data given on the faces across axis d to the nodes of a row next to them. \return true if all are zero
  bool add_faces(int d, const Index<D>& row, const Slopes* slopes, const Field<T, D>& u, T* values) const {
    const Boundary boundary = transform_.line(d).boundary();
    if (boundary == Boundary::periodic || (boundary == Boundary::neumann && slopes == nullptr)) return true;
    const double h = lattice_.spacing();
    const T factor = static_cast<T>(boundary == Boundary::dirichlet ? 1.0 / (h * h) : 2.0 / h);
    bool zero = true;
    for (int side = 0; side < 2; ++side) {
      const std::ptrdiff_t beside = side == 0 ? 0 : transform_.sizes()[d] - 1;
      if (d > 0 && row[d] != beside) continue;
      for (std::ptrdiff_t i = d == 0 ? beside : 0; i < (d == 0 ? beside + 1 : transform_.sizes()[0]); ++i) {
        Index<D> node = row + first_node() + Index<D>::unit(0, i);
        node[d] = side == 0 ? 0 : lattice_.nodes()[d] - 1;
        const T given = boundary == Boundary::dirichlet ? u(node) : (*slopes)(d, side, node);
        values[i] += factor * given;
        zero = zero && given == T(0);
      }
    }
    return zero;
  }

  std::size_t row_number(const Index<D>& row) const {
    const Index<D>& sizes = transform_.sizes();
    return static_cast<std::size_t>(D == 3 ? row[D - 1] * sizes[1] + row[1] : row[1]);
  }
  /// Sum of a row, by the trapezoidal rule across bounded axes, and its largest value.
  std::array<double, 2> weigh(const Index<D>& row, const T* values) const {
    std::array<double, 2> result{};
    for (std::ptrdiff_t i = 0; i < transform_.sizes()[0]; ++i) {
      double weight = 1.0;
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t at = d == 0 ? i : row[d];
        const bool face = at == 0 || at == transform_.sizes()[d] - 1;
        if (face && transform_.line(d).boundary() == Boundary::neumann) weight *= 0.5;
      }
      result[0] += weight * static_cast<double>(values[i]);
      result[1] = std::max(result[1], std::abs(static_cast<double>(values[i])));
    }
    return result;
  }
  /// Mean of what load() was given. \throws ValueError as Params say
  double examine_mean() const {
    double cells = 1.0;
    for (int d = 0; d < D; ++d) cells *= static_cast<double>(transform_.line(d).cells());
    double mean = 0.0;
    double largest = 0.0;
    for (const auto& [sum, most] : rows_) {
      mean += sum / cells;
      largest = std::max(largest, most);
    }
    if (params_.mean == MeanPart::reject && std::abs(mean) > params_.mean_tolerance * largest) {
      throw ValueError(detail::message("sources and fluxes of a Poisson equation without Dirichlet faces add up to ",
                                       mean * lattice_.box().volume(), " (a mean source of ", mean, ", the largest is ",
                                       largest, ") but must cancel: correct them, or ask for MeanPart::subtract"));
    }
    return mean;
  }

  void divide(const Index<D>& m, T* tile) const {
    constexpr std::size_t lines = detail::BoxTransform<D, T, E>::lines;
    const T* const along = symbol_[0].data() + m[0];
    const T across = D == 3 ? symbol_[1][static_cast<std::size_t>(m[1])] : T(0);
    const bool has_constant = singular_ && m == Index<D>{};
    const auto& last = symbol_[D - 1];
    for (std::size_t k = 0; k < last.size(); ++k) {
      T* const row = tile + k * lines;
      const T rest = across + last[k];
      for (std::size_t i = k == 0 && has_constant ? 1 : 0; i < lines; ++i) row[i] /= along[i] + rest;
    }
    if (has_constant) tile[0] = T(0);
  }

  Lattice<D> lattice_;
  Params params_;
  E execution_;
  detail::BoxTransform<D, T, E> transform_;
  bool singular_ = false;
  std::array<AlignedVector<T>, D> symbol_;
  std::vector<std::array<double, 2>> rows_;
};

}  // namespace cambium
