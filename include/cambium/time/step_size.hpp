// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <ostream>

#include <cambium/core/error.hpp>

namespace cambium {

/// Which limit a time step obeys.
enum class Limit {
  none,       ///< nothing moves and nothing diffuses: any step will do
  given,      ///< a largest step set by the caller
  advection,  ///< CFL: a value travels at most C spacings
  strain,     ///< Lagrangian CFL: particle paths do not cross
  diffusion,  ///< stability of explicit diffusion on a lattice
  particles,  ///< stability of explicit diffusion by particle strength exchange
  accuracy,   ///< the estimated error of a step reaches the tolerance
  stability,  ///< the step times the spectral radius reaches the end of the method's stability interval
  growth,     ///< a step is only so much longer than the one before
  rejected,   ///< a longer step was tried and its error was too large
  output,     ///< the step ends at the time asked for
  tension,    ///< stability of explicit steps under surface tension
};
/// How many limits there are.
inline constexpr std::size_t limit_count = 12;

/// The limit in words.
constexpr const char* name(Limit limit) {
  switch (limit) {
    case Limit::none:
      return "no limit";
    case Limit::given:
      return "the largest step given";
    case Limit::advection:
      return "advection (CFL)";
    case Limit::strain:
      return "strain (Lagrangian CFL)";
    case Limit::diffusion:
      return "diffusion on the lattice";
    case Limit::particles:
      return "particle strength exchange";
    case Limit::accuracy:
      return "accuracy";
    case Limit::stability:
      return "stability";
    case Limit::growth:
      return "growth of the step";
    case Limit::rejected:
      return "a rejected step";
    case Limit::output:
      return "the end of the interval";
    case Limit::tension:
      return "surface tension";
  }
  return "unknown limit";
}

/// A time step and the limit that bounds it; dt is infinite if `bound` is Limit::none.
struct StepSize {
  double dt = std::numeric_limits<double>::infinity();
  Limit bound = Limit::none;

  friend constexpr bool operator==(const StepSize&, const StepSize&) = default;
  friend std::ostream& operator<<(std::ostream& out, const StepSize& step) {
    return out << "dt = " << step.dt << ", bound by " << name(step.bound);
  }
};

namespace detail {

/// \throws ValueError unless value is positive (or zero, if allowed) and finite
inline double require_rate(double value, const char* what, bool zero_allowed) {
  if (!std::isfinite(value) || value < 0.0 || (value == 0.0 && !zero_allowed)) {
    throw ValueError(message(what, " is ", value, ": it must be finite and ",
                             zero_allowed ? "not negative; check the field it was measured from" : "positive"));
  }
  return value;
}

inline StepSize limited(double numerator, double rate, Limit limit) {
  return rate == 0.0 ? StepSize{} : StepSize{numerator / rate, limit};
}

}  // namespace detail

/// CFL: dt = C h / |u|max. Lattice methods need it for stability, particle methods only for the width of a band.
/// \throws ValueError unless C and h are positive and the speed is not negative, all finite
inline StepSize advection_limit(double courant, double spacing, double max_speed) {
  return detail::limited(
      detail::require_rate(courant, "Courant number", false) * detail::require_rate(spacing, "lattice spacing", false),
      detail::require_rate(max_speed, "largest speed", true), Limit::advection);
}

/// Lagrangian CFL: dt = C / |grad u|max, independent of the spacing. With C < 1 the map x -> x + dt u(x) keeps
/// orientation, so that particle paths do not cross.
/// \throws ValueError unless C is positive and the gradient is not negative, both finite
inline StepSize strain_limit(double courant, double max_gradient) {
  return detail::limited(detail::require_rate(courant, "Lagrangian Courant number", false),
                         detail::require_rate(max_gradient, "largest velocity gradient", true), Limit::strain);
}

/// Explicit diffusion with the second-order centred Laplacian in D dimensions: its largest eigenvalue is 4 D nu / h^2,
/// so dt = C s h^2 / (4 D nu), where s is the stepper's real_axis (2 for Euler: dt = C h^2 / (2 D nu)).
/// \throws ValueError unless C, h and s are positive and nu is not negative, all finite
inline StepSize diffusion_limit(double courant, double spacing, double viscosity, int dimension,
                                double real_axis = 2.0) {
  detail::require_rate(courant, "diffusion number", false);
  detail::require_rate(spacing, "lattice spacing", false);
  detail::require_rate(real_axis, "stability bound of the stepper on the real axis", false);
  detail::require_rate(dimension, "dimension", false);
  return detail::limited(courant * real_axis * spacing * spacing / (4.0 * dimension),
                         detail::require_rate(viscosity, "viscosity", true), Limit::diffusion);
}

/// Explicit diffusion by particle strength exchange with a Gaussian kernel of width eps and order r (2, 4, 6): its
/// symbol falls to -2 r nu / eps^2, in any dimension, so dt = C s eps^2 / (2 r nu), s the stepper's real_axis.
/// \throws ValueError unless C, eps, r and s are positive and nu is not negative, all finite
inline StepSize exchange_limit(double courant, double width, double viscosity, int kernel_order,
                               double real_axis = 2.0) {
  detail::require_rate(courant, "diffusion number", false);
  detail::require_rate(width, "kernel width", false);
  detail::require_rate(real_axis, "stability bound of the stepper on the real axis", false);
  detail::require_rate(kernel_order, "order of the kernel", false);
  return detail::limited(courant * real_axis * width * width / (2.0 * kernel_order),
                         detail::require_rate(viscosity, "viscosity", true), Limit::particles);
}

/// Explicit surface tension in a potential flow: waves of the interface of wave number k decay at m k^3, and the
/// shortest that a lattice carries has k = pi / h, so dt = C s (h / pi)^3 / m, where s is the stepper's real_axis.
/// \throws ValueError unless C, h and s are positive and m is not negative, all finite
inline StepSize tension_limit(double courant, double spacing, double mobility, double real_axis = 2.0) {
  detail::require_rate(courant, "stiffness number", false);
  detail::require_rate(spacing, "lattice spacing", false);
  detail::require_rate(real_axis, "stability bound of the stepper on the real axis", false);
  const double length = spacing / std::numbers::pi;
  return detail::limited(courant * real_axis * length * length * length,
                         detail::require_rate(mobility, "mobility", true), Limit::tension);
}

/// A largest step set by the caller, e.g. the time that is left. \throws ValueError unless positive and finite
inline StepSize given_limit(double dt) { return {detail::require_rate(dt, "largest time step", false), Limit::given}; }

/// The smallest of several limits; of equal ones the first.
inline StepSize smallest(std::initializer_list<StepSize> limits) {
  StepSize result;
  for (const StepSize& limit : limits) {
    if (limit.dt < result.dt) result = limit;
  }
  return result;
}

}  // namespace cambium
