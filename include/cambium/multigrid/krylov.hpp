// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <Eigen/IterativeLinearSolvers>
#include <unsupported/Eigen/IterativeSolvers>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <cambium/multigrid/convergence_error.hpp>

namespace cambium::detail {

/// A function y = A x of vectors, for Eigen.
template <class T, class Apply>
class MatrixFree;

}  // namespace cambium::detail

// NOLINTBEGIN(readability-identifier-naming): what Eigen asks of a matrix and of a preconditioner
namespace Eigen::internal {

template <class T, class Apply>
struct traits<cambium::detail::MatrixFree<T, Apply>> : public traits<SparseMatrix<T>> {};

}  // namespace Eigen::internal

namespace cambium::detail {

template <class T, class Apply>
class MatrixFree : public Eigen::EigenBase<MatrixFree<T, Apply>> {
 public:
  using Scalar = T;
  using RealScalar = T;
  using StorageIndex = int;
  static constexpr int ColsAtCompileTime = Eigen::Dynamic;
  static constexpr int MaxColsAtCompileTime = Eigen::Dynamic;
  static constexpr bool IsRowMajor = false;

  MatrixFree(Apply& apply, std::size_t size) : apply_(&apply), size_(static_cast<Eigen::Index>(size)) {}

  Eigen::Index rows() const { return size_; }
  Eigen::Index cols() const { return size_; }
  template <class Right>
  Eigen::Product<MatrixFree, Right, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Right>& x) const {
    return {*this, x.derived()};
  }
  void apply(const T* in, T* out) const { (*apply_)(in, out); }

 private:
  Apply* apply_;
  Eigen::Index size_;
};

}  // namespace cambium::detail

namespace Eigen::internal {

template <class T, class Apply, class Right>
struct generic_product_impl<cambium::detail::MatrixFree<T, Apply>, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<cambium::detail::MatrixFree<T, Apply>, Right,
                                generic_product_impl<cambium::detail::MatrixFree<T, Apply>, Right>> {
  template <class To>
  static void scaleAndAddTo(To& to, const cambium::detail::MatrixFree<T, Apply>& matrix, const Right& right,
                            const T& factor) {
    const Matrix<T, Dynamic, 1> x = right;
    Matrix<T, Dynamic, 1> y(x.size());
    matrix.apply(x.data(), y.data());
    to += factor * y;
  }
  template <class To>
  static void evalTo(To& to, const cambium::detail::MatrixFree<T, Apply>& matrix, const Right& right) {
    if constexpr (requires {
                    right.data();
                    to.data();
                  }) {
      matrix.apply(right.data(), to.data());
    } else {
      const Matrix<T, Dynamic, 1> x = right;
      Matrix<T, Dynamic, 1> y(x.size());
      matrix.apply(x.data(), y.data());
      to = y;
    }
  }
};

}  // namespace Eigen::internal

namespace cambium {
namespace detail {

/// A function z = M r of vectors as one of Eigen's preconditioners. What it is called with is noted: residuals.
template <class T>
class Preconditioner {
 public:
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic };

  template <class Matrix>
  Preconditioner& compute(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  Preconditioner& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  Preconditioner& factorize(const Matrix&) {
    return *this;
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }
  // NOLINTEND(readability-identifier-naming)

  /// \param every  of so many calls, the one numbered `first` gets a residual
  template <class Apply>
  void set(Apply& apply, double scale, int every, int first) {
    object_ = const_cast<void*>(static_cast<const void*>(&apply));  // call_ gives back what is const
    call_ = [](void* object, const T* in, T* out) { (*static_cast<Apply*>(object))(in, out); };
    scale_ = scale;
    every_ = every;
    first_ = first;
  }
  const Vector& solve(const Vector& r) const {
    if (calls_++ % every_ == first_) residuals_.push_back(static_cast<double>(r.norm()) / scale_);
    if (z_.size() != r.size()) z_.resize(r.size());
    call_(object_, r.data(), z_.data());
    return z_;
  }
  const std::vector<double>& residuals() const { return residuals_; }

 private:
  void* object_ = nullptr;
  void (*call_)(void*, const T*, T*) = nullptr;
  double scale_ = 1.0;
  int every_ = 1;
  int first_ = 0;
  mutable int calls_ = 0;
  mutable Vector z_;
  mutable std::vector<double> residuals_;
};

}  // namespace detail

/// Conjugate gradients (Eigen's): A and the preconditioner are symmetric and positive definite.
struct ConjugateGradient {
  template <class T, class Matrix>
  using Solver = Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, detail::Preconditioner<T>>;
  /// Preconditioner calls to a residual, and which of them has it.
  static constexpr int every = 1, first = 0;
};
/// Stabilised biconjugate gradients (Eigen's): two applications of A and of the preconditioner an iteration.
struct BiCGStab {
  template <class T, class Matrix>
  using Solver = Eigen::BiCGSTAB<Matrix, detail::Preconditioner<T>>;
  static constexpr int every = 2, first = 1;
};
/// GMRES (Eigen's), restarted after `Restart` iterations, of which each keeps a vector; residuals are noted at
/// restarts, and the tolerance is one of preconditioned residuals.
template <int Restart = 30>
struct GMRES {
  static_assert(Restart >= 1);
  template <class T, class Matrix>
  using Solver = Eigen::GMRES<Matrix, detail::Preconditioner<T>>;
  static constexpr int every = Restart + 1, first = 0;
  static constexpr int restart = Restart;
};

/// When a Krylov loop ends.
struct KrylovBounds {
  double tolerance = 1e-8;  ///< of the residual, relative to the right-hand side
  int most_iterations = 100;
};

/// Solves A x = b, A and the preconditioner being functions (in, out) of arrays as long as b, by Krylov =
/// ConjugateGradient, BiCGStab or GMRES. x holds the first guess. The residual that counts is found from A itself:
/// where that of the loop, which drifts by round-off or is a preconditioned one (GMRES), was too good, the loop starts
/// again from where it came to. It keeps 4 (CG) to 11 (BiCGStab) vectors. \throws ConvergenceError if the tolerance is
/// not reached; x is then unchanged. SizeError unless x is as long as b
template <class Krylov, class T, class Apply, class Precondition>
SolveReport solve_krylov(Apply&& apply, Precondition&& precondition, std::span<const T> b, std::span<T> x,
                         const KrylovBounds& bounds = {}) {
  using Matrix = detail::MatrixFree<T, std::remove_reference_t<Apply>>;
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  require_size(x.size(), b.size(), "the solution");
  const Matrix matrix(apply, b.size());
  const Eigen::Map<const Vector> right(b.data(), static_cast<Eigen::Index>(b.size()));
  Vector solution = Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
  const auto norm = static_cast<double>(right.norm());
  const double scale = norm > 0.0 ? norm : 1.0;
  if (norm == 0.0) solution.setZero();
  Vector image(right.size());
  const auto residual = [&] {
    apply(solution.data(), image.data());
    return static_cast<double>((right - image).norm()) / scale;
  };
  SolveReport report;
  report.residuals.push_back(report.residual = residual());
  for (double before = 0.0; !(report.residual <= bounds.tolerance);) {
    const bool stuck = before > 0.0 && !(report.residual < 0.5 * before);
    if (stuck || report.iterations >= bounds.most_iterations || !std::isfinite(report.residual)) {
      throw ConvergenceError(
          detail::message("the Krylov loop has a relative residual of ", report.residual, " after ", report.iterations,
                          " iterations and was to reach ", bounds.tolerance,
                          ": allow more iterations, precondition better, or ask for no less than round-off allows"),
          report.residuals);
    }
    before = report.residual;
    typename Krylov::template Solver<T, Matrix> solver;
    solver.preconditioner().set(precondition, scale, Krylov::every, Krylov::first);
    solver.compute(matrix);
    solver.setTolerance(static_cast<T>(bounds.tolerance));
    solver.setMaxIterations(bounds.most_iterations - report.iterations);
    if constexpr (requires { Krylov::restart; }) {
      solver.set_restart(Krylov::restart);
      // Its tolerance is relative to the first residual.
      solver.setTolerance(static_cast<T>(std::min(0.5, 0.5 * bounds.tolerance / before)));
    }
    const Vector guess = solution;
    solution = solver.solveWithGuess(right, guess);
    report.iterations += std::max(1, static_cast<int>(solver.iterations()));
    report.residual = residual();
    const auto& on_the_way = solver.preconditioner().residuals();
    report.residuals.insert(report.residuals.end(), on_the_way.begin(), on_the_way.end());
    report.residuals.push_back(report.residual);
  }
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = solution[static_cast<Eigen::Index>(i)];
  return report;
}

}  // namespace cambium
