// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// GCC 12 takes the undefined upper halves in its own AVX-512 intrinsics for uninitialised variables.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <Eigen/QR>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <numbers>

#include <cambium/operators/monomials.hpp>
#include <cambium/operators/weighted_rows.hpp>
#include <cambium/particles/neighbours.hpp>

namespace cambium {

/// A particle has too few neighbours, or neighbours in too special positions, for the operator asked for.
class NeighbourhoodError : public Error {
 public:
  using Error::Error;
};

namespace detail {

/// The weights w_q = g_q y_q of least norm |y| that satisfy linear conditions sum_q w_q v_qa = b_a, by a QR
/// decomposition with column pivoting of A_qa = g_q v_qa, whose columns are scaled to length one.
class LeastNormWeights {
 public:
  /// Makes room for `count` weights under `conditions` conditions; window(q) is g_q, matrix(q, a) is A_qa.
  void resize(std::size_t count, std::size_t conditions) {
    window_.resize(static_cast<Eigen::Index>(count));
    matrix_.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(conditions));
  }
  double& window(std::size_t q) { return window_[static_cast<Eigen::Index>(q)]; }
  double& matrix(std::size_t q, std::size_t a) {
    return matrix_(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(a));
  }

  /// False if the smallest pivot, relative to the largest, is not above `pivot`.
  bool decompose(double pivot) {
    const Eigen::Index conditions = matrix_.cols();
    scale_.resize(conditions);
    for (Eigen::Index a = 0; a < conditions; ++a) {
      scale_[a] = matrix_.col(a).norm();
      if (!(scale_[a] > 0.0)) return false;
      matrix_.col(a) /= scale_[a];
    }
    qr_.compute(matrix_);
    return std::abs(qr_.matrixQR()(conditions - 1, conditions - 1)) > pivot * std::abs(qr_.matrixQR()(0, 0));
  }

  /// weight[q * stride] := w_q. With A P = Q R the solution of A^T y = b of least norm is y = Q R^-T P^T b. Plain
  /// loops: Eigen's blocked products gain nothing for one small vector and take seconds to compile.
  void solve(const Eigen::VectorXd& b, double* weight, std::size_t stride) {
    const Eigen::MatrixXd& qr = qr_.matrixQR();
    const Eigen::Index conditions = b.size();
    y_.setZero(window_.size());
    for (Eigen::Index a = 0; a < conditions; ++a) {
      const Eigen::Index from = qr_.colsPermutation().indices()[a];
      double sum = b[from] / scale_[from];
      for (Eigen::Index c = 0; c < a; ++c) sum -= qr(c, a) * y_[c];
      y_[a] = sum / qr(a, a);
    }
    for (Eigen::Index a = conditions - 1; a >= 0; --a) {  // Q = H_0 ... H_last, H = 1 - tau v v^T, v = (1, below R)
      double along = y_[a];
      for (Eigen::Index q = a + 1; q < y_.size(); ++q) along += qr(q, a) * y_[q];
      along *= qr_.hCoeffs()[a];
      y_[a] -= along;
      for (Eigen::Index q = a + 1; q < y_.size(); ++q) y_[q] -= along * qr(q, a);
    }
    for (Eigen::Index q = 0; q < y_.size(); ++q) weight[static_cast<std::size_t>(q) * stride] = window_[q] * y_[q];
  }

 private:
  Eigen::VectorXd window_;
  Eigen::VectorXd scale_;
  Eigen::VectorXd y_;
  Eigen::MatrixXd matrix_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
};

/// Moment system of one particle: weights of its neighbours with prescribed moments, of least Gaussian-weighted norm.
///
/// With z = r / radius and g = exp(-|z|^2 / (2 width^2)) the weights satisfy sum_q w_q z_q^a = b_a for all monomials of
/// the degrees 1, ..., Degree. This is the kernel "polynomial times Gaussian" of DC-PSE: its coefficients solve
/// (A^T A) c = b with A_qa = g_q z_q^a, and QR spares squaring the condition number of A.
template <int D, int Degree>
class MomentSystem {
 public:
  static constexpr auto powers = monomials<D, Degree>();
  static constexpr std::size_t conditions = powers.size();

  /// Builds and decomposes the system of the neighbours at distances r; false if there are fewer than `needed` of them
  /// or if the smallest pivot, relative to the largest, is below `pivot`.
  bool decompose(const std::vector<Vec<D>>& r, double radius, double width, double needed, double pivot) {
    if (r.size() < conditions || static_cast<double>(r.size()) < needed) return false;
    radius_ = radius;
    system_.resize(r.size(), conditions);
    for (std::size_t q = 0; q < r.size(); ++q) {
      const Vec<D> z = r[q] / radius;
      system_.window(q) = std::exp(-0.5 * dot(z, z) / (width * width));
      for (std::size_t a = 0; a < conditions; ++a) system_.matrix(q, a) = system_.window(q) * power(z, powers[a]);
    }
    return system_.decompose(pivot);
  }

  /// weight[q * stride] := weights whose sum over f_q - f_p is the derivative sum_i d^a_i f.
  template <std::size_t N>
  void solve(const std::array<MultiIndex<D>, N>& derivative, double* weight, std::size_t stride) {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(conditions));
    for (const auto& a : derivative) {
      for (std::size_t i = 0; i < conditions; ++i) {
        if (powers[i] == a) b[static_cast<Eigen::Index>(i)] = factorial(a) / std::pow(radius_, total(a));
      }
    }
    system_.solve(b, weight, stride);
  }

 private:
  static double power(const Vec<D>& z, const MultiIndex<D>& a) {
    double result = 1.0;
    for (int d = 0; d < D; ++d) {
      for (int m = 0; m < a[d]; ++m) result *= z[d];
    }
    return result;
  }

  double radius_ = 1.0;
  LeastNormWeights system_;
};

}  // namespace detail

/// Discretisation-corrected particle strength exchange: derivatives of order of accuracy 2, 4 or 6 on scattered
/// particles, whose volumes are not needed.
///
///     const cambium::DCPSE<4> dcpse({.spacing = h});
///     const auto laplacian = dcpse.laplacian(domain, particles.positions());
///     laplacian.apply(particles[value], particles[result]);
///
/// For every particle the weights of its neighbours satisfy the moment conditions of the derivative exactly, whatever
/// the positions. A particle whose neighbourhood is too small or too special (at the faces of a bounded box, in gaps)
/// gets a wider one. Values in, values out; not conservative. This header needs Eigen and is not part of operators.hpp.
/// Source: Schrader, Reboux & Sbalzarini, J. Comput. Phys. 229 (2010) 4159; the form f_q - f_p for all derivatives is
/// that of Bourantas et al., SIAM J. Sci. Comput. 38 (2016) C1.
template <int Order>
class DCPSE {
 public:
  static_assert(Order == 2 || Order == 4 || Order == 6, "cambium: DCPSE has order 2, 4 or 6");
  static constexpr int order = Order;

  struct Params {
    double spacing = 0.0;       ///< typical distance of particles, volume^(1/D); length; has no default
    double sampling = 2.0;      ///< neighbours wanted for each moment condition, on average; 0.7 of them are required
    double width = 0.4;         ///< width of the Gaussian window, in radii of the neighbourhood
    double pivot = 1e-5;        ///< relative pivot of the moment system below which its neighbourhood is widened
    double max_widening = 4.0;  ///< largest radius tried, in units of the first
  };

  /// \throws ValueError if a parameter is not positive and finite, sampling or max_widening is below 1, or pivot not
  /// below 1
  explicit DCPSE(const Params& params) : params_(params) {
    require(params.spacing > 0.0 && std::isfinite(params.spacing), "spacing", params.spacing, "a positive length");
    require(params.sampling >= 1.0 && params.sampling < 100.0, "sampling", params.sampling, "between 1 and 100");
    require(params.width > 0.0 && std::isfinite(params.width), "width", params.width, "positive");
    require(params.pivot > 0.0 && params.pivot < 1.0, "pivot", params.pivot, "between 0 and 1");
    require(params.max_widening >= 1.0 && params.max_widening < 100.0, "max_widening", params.max_widening,
            "between 1 and 100");
  }

  /// Radius of the first neighbourhood for a derivative of total order `derivative` in D dimensions.
  template <int D>
  double radius(int derivative) const {
    const double wanted = params_.sampling * monomial_count<D>(derivative + Order - 1) + 1.0;
    constexpr double ball = D == 1 ? 2.0 : D == 2 ? std::numbers::pi : 4.0 / 3.0 * std::numbers::pi;
    return params_.spacing * std::pow(wanted / ball, 1.0 / D);
  }

  /// The Laplacian. \param positions Columns<D, ...>; errors as derivative()
  template <int D, class X, Execution E = OpenMP>
  WeightedRows<1, E> laplacian(const Domain<D>& domain, const X& positions, const E& execution = {}) const {
    std::array<std::array<MultiIndex<D>, D>, 1> squares{};
    for (int d = 0; d < D; ++d) squares[0][static_cast<std::size_t>(d)] = MultiIndex<D>::unit(d, 2);
    return build<2>(domain, detail::const_columns_of(positions), squares, execution);
  }

  /// The gradient: D operators with common neighbours.
  template <int D, class X, Execution E = OpenMP>
  WeightedRows<D, E> gradient(const Domain<D>& domain, const X& positions, const E& execution = {}) const {
    std::array<std::array<MultiIndex<D>, 1>, D> axes{};
    for (int d = 0; d < D; ++d) axes[static_cast<std::size_t>(d)][0] = MultiIndex<D>::unit(d, 1);
    return build<1>(domain, detail::const_columns_of(positions), axes, execution);
  }

  /// Partial derivative d^a, total order 1 or 2.
  /// \throws ValueError for other total orders
  /// \throws NeighbourhoodError naming the first particle for which no neighbourhood up to max_widening will do
  /// \throws PositionError if a position is not finite or outside a bounded box
  template <int D, class X, Execution E = OpenMP>
  WeightedRows<1, E> derivative(const Domain<D>& domain, const X& positions, const MultiIndex<D>& a,
                                const E& execution = {}) const {
    bool valid = total(a) == 1 || total(a) == 2;
    for (int d = 0; d < D; ++d) valid = valid && a[d] >= 0;
    if (!valid) {
      throw ValueError(detail::message("derivative ", a, " asked of DCPSE: the total order must be 1 or 2"));
    }
    const std::array<std::array<MultiIndex<D>, 1>, 1> single{{{a}}};
    const auto x = detail::const_columns_of(positions);
    return total(a) == 1 ? build<1>(domain, x, single, execution) : build<2>(domain, x, single, execution);
  }

 private:
  static void require(bool holds, const char* name, double found, const char* wanted) {
    if (!holds) throw ValueError(detail::message("DCPSE ", name, " is ", found, ": it must be ", wanted));
  }

  /// Rows for Count operators, each the sum of N partial derivatives of total order Derivative. Particles whose
  /// neighbourhood does not do are tried again with a radius 1.25 times as large.
  template <int Derivative, int D, class P, std::size_t N, std::size_t Count, Execution E>
  WeightedRows<static_cast<int>(Count), E> build(const Domain<D>& domain, Columns<D, const P> positions,
                                                 const std::array<std::array<MultiIndex<D>, N>, Count>& operators,
                                                 const E& execution) const {
    constexpr int count = static_cast<int>(Count);
    std::vector<WeightedRow<count>> rows(positions.size());
    std::vector<std::size_t> pending(positions.size());
    for (std::size_t p = 0; p < pending.size(); ++p) pending[p] = p;
    for (double widening = 1.0; !pending.empty(); widening *= 1.25) {
      const double reach = radius<D>(Derivative) * std::min(widening, params_.max_widening);
      const Neighbours<D, P> neighbours(domain, positions, reach, execution);
      for_each_piece(execution, pending.size(), 64, [&](std::size_t begin, std::size_t end) {
        detail::MomentSystem<D, Derivative + Order - 1> system;
        std::vector<Vec<D>> r;
        for (std::size_t i = begin; i < end; ++i) {
          fill(rows[pending[i]], neighbours, pending[i], reach, operators, system, r);
        }
      });
      std::erase_if(pending, [&](std::size_t p) { return !rows[p].weight.empty(); });
      if (!pending.empty() && widening >= params_.max_widening) {
        fail(positions, pending, neighbours, reach, monomial_count<D>(Derivative + Order - 1));
      }
    }
    return WeightedRows<count, E>(rows, execution);
  }

  /// Fills one row, or leaves its weights empty if the neighbourhood does not do.
  template <int D, class P, std::size_t N, std::size_t Count, class System>
  void fill(WeightedRow<static_cast<int>(Count)>& row, const Neighbours<D, P>& neighbours, std::size_t p, double reach,
            const std::array<std::array<MultiIndex<D>, N>, Count>& operators, System& system,
            std::vector<Vec<D>>& r) const {
    row.neighbour.clear();
    r.clear();
    neighbours.for_each_neighbour(p, [&](std::size_t q, const Vec<D>& difference) {
      if (q == p) return;
      row.neighbour.push_back(static_cast<std::uint32_t>(q));
      r.push_back(difference);
    });
    const double needed = 0.7 * params_.sampling * static_cast<double>(System::conditions);
    if (!system.decompose(r, reach, params_.width, needed, params_.pivot)) return;
    row.weight.resize(r.size() * Count);
    for (std::size_t k = 0; k < Count; ++k) system.solve(operators[k], row.weight.data() + k, Count);
  }

  template <int D, class P>
  [[noreturn]] static void fail(Columns<D, const P> positions, const std::vector<std::size_t>& pending,
                                const Neighbours<D, P>& neighbours, double reach, int conditions) {
    std::size_t found = 0;
    neighbours.for_each_neighbour(pending[0], [&](std::size_t q, const Vec<D>&) { found += q != pending[0]; });
    throw NeighbourhoodError(detail::message(
        "particle ", pending[0], " at ", positions[pending[0]], " has ", found, " neighbours within ", reach,
        found < static_cast<std::size_t>(conditions) ? ", fewer than" : ", in positions too special for", " the ",
        conditions, " moment conditions of DCPSE of order ", Order, " (", pending.size(),
        " such particles): add particles or remesh, take a lower order, or raise max_widening"));
  }

  Params params_;
};

}  // namespace cambium
