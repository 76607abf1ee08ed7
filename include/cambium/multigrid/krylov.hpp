// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <cambium/multigrid/bicgstab_loop.hpp>
#include <cambium/multigrid/convergence_error.hpp>
#include <cambium/multigrid/eigen.hpp>

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
/// Stabilised biconjugate gradients, in a loop that keeps its vectors: two applications of A and of the preconditioner
/// an iteration, of which the last may be half of one.
struct BiCGStab {
  template <class T, Execution E>
  using Loop = detail::BiCGStabLoop<T, E>;
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

/// Vectors of solve_krylov that are kept from call to call, and the threads that sweep over them.
template <class Krylov, class T, Execution E = Serial>
class KrylovSpace {
 public:
  explicit KrylovSpace(const E& execution = {}) : loop_(execution) {}

 private:
  template <class E2>
  struct NoLoop {
    explicit NoLoop(const E2&) {}
  };
  template <class L, class E2>
  struct Choose {
    using Type = NoLoop<E2>;
  };
  template <class L, class E2>
  requires requires { typename L::template Loop<T, E2>; }
  struct Choose<L, E2> {
    using Type = typename L::template Loop<T, E2>;
  };

  template <class K, class U, class Apply, class Precondition, Execution F>
  friend SolveReport solve_krylov(Apply&&, Precondition&&, std::span<const U>, std::span<U>, const KrylovBounds&,
                                  KrylovSpace<K, U, F>&);

  AlignedVector<T> solution_, residual_;  // Eigen's vectors take memory anew when they get shorter
  typename Choose<Krylov, E>::Type loop_;
};

namespace detail {

/// One call of Eigen's loop, which takes its vectors anew. \return iterations
template <class Krylov, class T, class Apply, class Precondition>
int run_eigen(Apply& apply, Precondition& precondition, std::span<const T> b, std::span<T> x, double scale,
              const KrylovBounds& bounds, SolveReport& report) {
  using Matrix = MatrixFree<T, std::remove_reference_t<Apply>>;
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  const Matrix matrix(apply, b.size());
  typename Krylov::template Solver<T, Matrix> solver;
  solver.preconditioner().set(precondition, scale, Krylov::every, Krylov::first);
  solver.compute(matrix);
  solver.setTolerance(static_cast<T>(bounds.tolerance));
  solver.setMaxIterations(bounds.most_iterations - report.iterations);
  if constexpr (requires { Krylov::restart; }) {
    solver.set_restart(Krylov::restart);
    // Its tolerance is relative to the first residual.
    solver.setTolerance(static_cast<T>(std::min(0.5, 0.5 * bounds.tolerance / report.residual)));
  }
  const Eigen::Map<const Vector> right(b.data(), static_cast<Eigen::Index>(b.size()));
  Eigen::Map<Vector> solution(x.data(), static_cast<Eigen::Index>(x.size()));
  const Vector guess = solution;
  solution = solver.solveWithGuess(right, guess);
  const auto& on_the_way = solver.preconditioner().residuals();
  report.residuals.insert(report.residuals.end(), on_the_way.begin(), on_the_way.end());
  return static_cast<int>(solver.iterations());
}

/// \param before  residual of the last call of a loop, 0 if there was none
inline void require_progress(const SolveReport& report, double before, const KrylovBounds& bounds) {
  const bool stuck = before > 0.0 && !(report.residual < 0.5 * before);
  if (!stuck && report.iterations < bounds.most_iterations && std::isfinite(report.residual)) return;
  throw ConvergenceError(message("the Krylov loop has a relative residual of ", report.residual, " after ",
                                 report.iterations, " iterations and was to reach ", bounds.tolerance,
                                 ": allow more iterations, precondition better, or ask for no less than round-off "
                                 "allows"),
                         report.residuals);
}

}  // namespace detail

/// Solves A x = b, A and the preconditioner being functions (in, out) of arrays as long as b, by Krylov =
/// ConjugateGradient, BiCGStab or GMRES. x holds the first guess. The residual that counts is found from A itself:
/// where that of the loop, which drifts by round-off or is a preconditioned one (GMRES), was too good, the loop starts
/// again from where it came to. Of vectors, BiCGStab has 9 in `space` and takes none; Eigen's loops take 7 (CG) or as
/// many as the restart (GMRES) besides the 2 there. \throws ConvergenceError if the tolerance is not reached; x is
/// then unchanged. SizeError unless x is as long as b
template <class Krylov, class T, class Apply, class Precondition, Execution E>
SolveReport solve_krylov(Apply&& apply, Precondition&& precondition, std::span<const T> b, std::span<T> x,
                         const KrylovBounds& bounds, KrylovSpace<Krylov, T, E>& space) {
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  require_size(x.size(), b.size(), "the solution");
  const Eigen::Map<const Vector> right(b.data(), static_cast<Eigen::Index>(b.size()));
  space.solution_.resize(x.size());
  space.residual_.resize(x.size());
  Eigen::Map<Vector> solution(space.solution_.data(), right.size());
  Eigen::Map<Vector> rest(space.residual_.data(), right.size());
  std::copy_n(x.data(), x.size(), solution.data());
  const auto norm = static_cast<double>(right.norm());
  const double scale = norm > 0.0 ? norm : 1.0;
  if (norm == 0.0) solution.setZero();
  const auto residual = [&] {
    apply(solution.data(), rest.data());
    rest = right - rest;
    return static_cast<double>(rest.norm()) / scale;
  };
  SolveReport report;
  report.residuals.reserve(static_cast<std::size_t>(2 * std::min(bounds.most_iterations, 100)) + 8);
  report.residuals.push_back(report.residual = residual());
  for (double before = 0.0; !(report.residual <= bounds.tolerance);) {
    detail::require_progress(report, before, bounds);
    before = report.residual;
    int taken = 0;
    const std::span<T> improved(space.solution_);
    if constexpr (requires { typename Krylov::template Loop<T, E>; }) {
      taken = space
                  .loop_(apply, precondition, std::span<const T>(space.residual_), improved, bounds.tolerance * scale,
                         bounds.most_iterations - report.iterations,
                         [&](double r) { report.residuals.push_back(r / scale); })
                  .iterations;
    } else {
      taken = detail::run_eigen<Krylov, T>(apply, precondition, b, improved, scale, bounds, report);
    }
    report.iterations += std::max(1, taken);
    report.residual = residual();
    report.residuals.push_back(report.residual);
  }
  std::copy_n(solution.data(), x.size(), x.data());
  return report;
}

/// The same with vectors of its own.
template <class Krylov, class T, class Apply, class Precondition>
SolveReport solve_krylov(Apply&& apply, Precondition&& precondition, std::span<const T> b, std::span<T> x,
                         const KrylovBounds& bounds = {}) {
  KrylovSpace<Krylov, T> space;
  return solve_krylov<Krylov, T>(apply, precondition, b, x, bounds, space);
}

}  // namespace cambium
