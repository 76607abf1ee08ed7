// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>

#include <cambium/levelset/level_set.hpp>
#include <cambium/levelset/measures.hpp>
#include <cambium/models/tumour/adams_bashforth.hpp>
#include <cambium/models/tumour/along_normals.hpp>
#include <cambium/models/tumour/diffusing.hpp>
#include <cambium/models/tumour/free_space.hpp>
#include <cambium/models/tumour/gaussian_filter.hpp>
#include <cambium/models/tumour/growth.hpp>
#include <cambium/models/tumour/heun.hpp>
#include <cambium/models/tumour/necrosis.hpp>
#include <cambium/models/tumour/parameters.hpp>
#include <cambium/models/tumour/periodic.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/quasi_steady.hpp>
#include <cambium/models/tumour/semi_implicit.hpp>
#include <cambium/models/tumour/speed_limits.hpp>
#include <cambium/models/tumour/zero_outside.hpp>
#include <cambium/time/step_size.hpp>

namespace cambium {

/// The tumour has come so near to a bounded face of the box that its surroundings no longer fit in.
class TumourAtWallError : public InterfaceError {
 public:
  using InterfaceError::InterfaceError;
};

/// Which reinitialisation of the level-set room a tumour takes: ReinitialiseBy<FastMarching>. ClosestPoint by default.
template <class R>
struct ReinitialiseBy {
  using Kind = tumour_kind::Reinit;
  using Type = R;
};

/// What a step did.
struct TumourStep {
  double dt = 0.0;
  Limit bound = Limit::none;     ///< what the step was bound by
  double advection_limit = 0.0;  ///< the step that the CFL number allows
  double tension_limit = 0.0;    ///< the step that the stiffness of the surface tension allows
  double largest_speed = 0.0;    ///< of the interface, at the beginning of the step
  int iterations = 0;            ///< of the loop that solves for the stiff part; 0 for explicit steps
  std::size_t unresolved = 0;    ///< places where the interface comes back to itself within a spacing
  bool extinct = false;          ///< the tumour has become too small to be seen on the lattice: the run is over
};

/// A tumour that grows, in the plane or in space (11.61-11.63):
///
///     Lap c = c inside, c = 1 on the interface                         or dc/dt = Lap c - c (Diffusing)
///     -Lap p = G (c - A) inside; -G G_N where c < N (Necrosis)
///     Lap p = 0 outside, in free space (FreeSpace); or p = 0 outside (ZeroOutside); or Periodic
///     p_in - p_out = gamma kappa; V = -dp/dn
///
///     cambium::Tumour<3> tumour(lattice, cambium::Ball<3>(centre, 2.0), {.parameters = {.tension = 1.0}});
///     while (tumour.time() < 1.0 && !tumour.extinct()) tumour.step(1.0 - tumour.time());
///
/// Policies are named in any order, one of each kind: cambium::Tumour<2, ZeroOutside, Necrosis, SemiImplicit>. What is
/// not named takes the default (QuasiSteady, FreeSpace, NoNecrosis, NoFilter, AdamsBashforth, AlongNormals,
/// ReinitialiseBy<ClosestPoint>) and is not compiled otherwise. Fields are at all times those of time(). No number of
/// threads changes a bit.
template <int D, class... Policies>
class Tumour {
  static_assert((detail::check_tumour_policies<Policies...>(), true));
  template <class Kind, class Default>
  using Policy = typename detail::PolicyOf<Kind, Default, Policies...>::Type;

 public:
  using Nutrient = Policy<tumour_kind::Nutrient, QuasiSteady>;
  using Outside = Policy<tumour_kind::Outside, FreeSpace>;
  using Core = Policy<tumour_kind::Necrosis, NoNecrosis>;
  using Filter = Policy<tumour_kind::Filter, NoFilter>;
  using Stepping = Policy<tumour_kind::Stepping, AdamsBashforth>;
  using Motion = Policy<tumour_kind::Motion, AlongNormals>;
  using Interface = LevelSet<typename Policy<tumour_kind::Reinit, ReinitialiseBy<ClosestPoint>>::Type, D>;
  using Band = typename Interface::Band;
  static constexpr int dimension = D;

  struct Params {
    TumourParameters parameters = {};
    double courant = 0.25;   ///< spacings that the interface travels in a step
    double change = 0.03;    ///< of the speed in a step, relative to it
    double stiffness = 0.8;  ///< share of the step up to which surface tension is stable that explicit steps take
    std::ptrdiff_t wall_distance = 5;  ///< nodes from a bounded face at which the tumour counts as having reached it
    double smallest_radius = 3.0;      ///< in spacings: a tumour of the volume of a smaller ball counts as extinct
    typename Interface::Params interface = {};
    typename Motion::Params motion = {};
  };

  /// \param shape  negative inside, of any scaling: LevelSet's. \throws as LevelSet; ValueError for parameters out of
  ///               range; TumourAtWallError if the shape is too near to a bounded face
  template <class F>
  Tumour(const Lattice<D>& lattice, F&& shape, const Params& params = {}, const OpenMP& execution = {})
      : Tumour(Interface(lattice, shape, checked(params).interface, execution), params, execution) {
    require_off_walls();
    growth_.evaluate(level_set_, std::numeric_limits<double>::infinity());
    growth_.accept();
    find_size();
  }
  /// One that was saved, with the same policies, lattice and parameters: its steps are those that the saved one takes
  /// next, to the last bit. \throws SnapshotError for what does not fit, as the constructor above
  static Tumour restored(const Lattice<D>& lattice, const Snapshot& snapshot, const Params& params = {},
                         const OpenMP& execution = {}) {
    return Tumour(snapshot, Interface::restored(lattice, snapshot, checked(params).interface), params, execution);
  }
  /// State between two steps, without lattice, parameters and policies.
  Snapshot save() const {
    Snapshot snapshot;
    level_set_.save(snapshot);
    SnapshotWriter writer(snapshot);
    visit(*this, writer);
    return snapshot;
  }

  double time() const { return time_; }
  const Params& params() const { return params_; }
  const TumourParameters& parameters() const { return params_.parameters; }
  const Lattice<D>& lattice() const { return level_set_.lattice(); }
  const Interface& level_set() const { return level_set_; }
  const Field<double, D>& nutrient() const { return growth_.nutrient(); }
  const Field<double, D>& pressure() const { return growth_.pressure(); }
  /// V at the closest points of the nodes of level_set().band(); NaN at nodes without one.
  const Field<double, D, Sparse>& speed() const { return growth_.speed(); }
  /// Normals and curvatures there.
  const BandGeometry<double, D>& geometry() const { return growth_.geometry(); }
  const TumourTimes& times() const { return growth_.times(); }
  bool extinct() const { return extinct_; }

  /// The step that would be taken, at most `longest`, or half of it if the rest of it would be shorter than the step;
  /// and what bounds it.
  TumourStep next_step(double longest = std::numeric_limits<double>::infinity()) const {
    TumourStep step;
    step.largest_speed = detail::largest_speed(level_set_.band(), speed());
    const double h = level_set_.spacing();
    const StepSize advection = advection_limit(params_.courant, h, step.largest_speed);
    const StepSize tension = tension_bound();
    step.advection_limit = advection.dt;
    step.tension_limit = tension.dt;
    StepSize size = smallest({advection, tension, growth_bound(advection), change_bound()});
    if (longest < size.dt) size = given_limit(longest);
    if (size.dt < longest && longest < 2.0 * size.dt) size.dt = 0.5 * longest;  // two equal ones, not a very short last
    step.dt = size.dt;
    step.bound = size.bound;
    return step;
  }

  /// Takes a step, of `longest` at most. \throws TumourAtWallError if the tumour reaches a bounded face, ValueError if
  /// it is extinct already or nothing bounds the step, InterfaceError and ConvergenceError from the rooms below; the
  /// tumour is then as before the step
  TumourStep step(double longest = std::numeric_limits<double>::infinity()) {
    if (extinct_) throw ValueError("the tumour is extinct: there is nothing left to step; see extinct()");
    TumourStep step = next_step(longest);
    if (!std::isfinite(step.dt)) {
      throw ValueError("the interface is at rest and nothing bounds the step: say how long it may be at most");
    }
    start_ = level_set_;
    const double last_step = last_step_;
    try {
      advance(step);
    } catch (...) {
      level_set_ = start_;
      last_step_ = last_step;
      growth_.evaluate(level_set_, 0.0);
      throw;
    }
    step.unresolved = growth_.unresolved();
    find_size();
    step.extinct = extinct_;
    return step;
  }

 private:
  using Growth = detail::TumourGrowth<D, Nutrient, Outside, Core, Filter>;
  static constexpr double unknown = Growth::unknown;

  Tumour(Interface level_set, const Params& params, const OpenMP& execution)
      : params_(params),
        execution_(execution),
        level_set_(std::move(level_set)),
        start_(level_set_),
        growth_(lattice(), params.interface.half_width, params.parameters, execution),
        stepping_(lattice()),
        motion_(lattice(), params.motion),
        rate_(lattice(), unknown),
        before_(lattice(), unknown) {}
  Tumour(const Snapshot& snapshot, Interface level_set, const Params& params, const OpenMP& execution)
      : Tumour(std::move(level_set), params, execution) {
    SnapshotReader reader(snapshot);
    visit(*this, reader);
    growth_.attach(level_set_);
    find_size();
  }
  template <class Self, class Archive>
  static void visit(Self& self, Archive& archive) {
    archive("time", self.time_);
    archive("last_step", self.last_step_);
    archive("speed.before", self.before_);
    Growth::visit(self.growth_, archive);
    detail::visit_part(self.stepping_, archive);
  }

  static const Params& checked(const Params& params) {
    require_parameters(params.parameters);
    if (params.courant > 0.0 && params.change > 0.0 && params.stiffness > 0.0 && params.smallest_radius > 0.0 &&
        params.wall_distance >= 3 && std::isfinite(params.courant) && std::isfinite(params.stiffness) &&
        !std::isnan(params.change)) {
      return params;
    }
    throw ValueError(detail::message("tumour with CFL number ", params.courant, ", change of the speed ", params.change,
                                     ", share of the stable step ", params.stiffness, ", smallest radius ",
                                     params.smallest_radius, " and distance from walls ", params.wall_distance,
                                     ": all must be positive and finite, the last 3 at least"));
  }

  void advance(TumourStep& step) {
    const auto move = [&](const Field<double, D, Sparse>& rate) {
      const detail::Stopwatch watch(growth_.times().motion);
      motion_(level_set_, rate, time_, step.dt, execution_);
      require_off_walls();
    };
    if constexpr (Stepping::keeps_speed) now_ = growth_.speed();
    step.iterations = stepping_(level_set_, start_, growth_, before_, step.dt, last_step_, rate_, move, execution_);
    growth_.evaluate(level_set_, step.dt);
    growth_.accept();
    if constexpr (Stepping::keeps_speed) std::swap(before_, now_);
    if constexpr (requires { stepping_.accept(); }) stepping_.accept();
    time_ += step.dt;
    last_step_ = step.dt;
  }

  void require_off_walls() const {
    try {
      detail::check_walls(level_set_.band(), params_.wall_distance);
    } catch (const InterfaceError& error) {
      throw TumourAtWallError(detail::message("the tumour has reached the box at time ", time_, ": ", error.what()));
    }
  }
  /// Surface tension makes waves of wave number k decay at gamma k^3 / 2 (free space) or gamma k^3 (p = 0 outside).
  StepSize tension_bound() const {
    if constexpr (std::isinf(Stepping::real_axis)) {
      return {};
    } else {
      return tension_limit(params_.stiffness, level_set_.spacing(), growth_.tension_mobility(), Stepping::real_axis);
    }
  }
  /// Rules of two steps are stable if these do not grow by 1 + sqrt(2) at once. They begin with one of first order,
  /// which is short.
  StepSize growth_bound(const StepSize& advection) const {
    if constexpr (!Stepping::keeps_speed) return {};
    if (last_step_ > 0.0) return {2.0 * last_step_, Limit::growth};
    const StepSize tension = tension_limit(params_.stiffness, level_set_.spacing(), growth_.tension_mobility());
    return {std::min(0.25 * advection.dt, tension.dt), Limit::growth};
  }
  StepSize change_bound() const {
    if (!Stepping::keeps_speed || !(last_step_ > 0.0)) return {};
    return detail::change_limit(params_.change, level_set_.band(), speed(), before_, last_step_);
  }
  void find_size() {
    std::size_t nodes = 0;
    detail::for_each_side(level_set_.band(), Serial{}, [&](std::size_t, bool inside) { nodes += inside ? 1 : 0; });
    const double radius = params_.smallest_radius;
    const double ball =
        D == 2 ? std::numbers::pi * radius * radius : 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
    extinct_ = static_cast<double>(nodes) < ball;
  }

  Params params_;
  OpenMP execution_;
  Interface level_set_;
  Interface start_;  ///< of the step, to return to if it fails
  Growth growth_;
  typename Stepping::template Method<D> stepping_;
  typename Motion::template Method<D> motion_;
  double time_ = 0.0;
  double last_step_ = 0.0;
  bool extinct_ = false;
  Field<double, D, Sparse> rate_, before_;
  Field<double, D, Sparse> now_ = before_;
};

}  // namespace cambium
