// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <utility>

#include <cambium/levelset/advection/backward.hpp>
#include <cambium/models/chemistry_steps.hpp>
#include <cambium/models/surface_chemistry.hpp>
#include <cambium/models/surface_motion.hpp>
#include <cambium/surface/surface_integral.hpp>
#include <cambium/surface/surface_transport.hpp>
#include <cambium/time/adaptive.hpp>

namespace cambium {

/// Options of SurfacePattern.
struct SurfacePatternParams {
  AdaptiveParams steps;     ///< of the chemistry
  double penalty = 0.0;     ///< of the surface band; 0: its default
  int motion_substeps = 1;  ///< of paths along which species are carried, per step
};

/// Species that react, diffuse along a surface, and are carried with it (Bergdorf, Milde & Koumoutsakos, eq. 11.40):
///   dc_s/dt + div(c_s u) = F_s(c) + D_s div((1 - n n) grad c_s)
/// Moving surfaces take Strang's splitting: half a step of chemistry, one of motion, half a step of chemistry; a
/// velocity that depends on surface or species is that of the middle of the step (midpoint rule). Second order in time.
/// \tparam Motion   FixedSurface, PrescribedMotion<U>, GrowthBySpecies, MotionBySpecies<F>, CurvatureMotion
/// \tparam Steps    StabilisedSteps, ImplicitDiffusion<ARK3>, ExplicitSteps<M>
template <Kinetics K, class Motion = FixedSurface, class Steps = StabilisedSteps, class Stencil = SurfaceLaplacian<2>,
          int D = 3, class T = double, Execution E = OpenMP>
class SurfacePattern {
  static_assert((check_kinetics<K>(), check_surface_motion<Motion>(), true));

 public:
  static constexpr int species = K::species;
  using Surface = LevelSet<ClosestPoint, D, T>;
  using Band = SurfaceBand<Stencil, D, T>;
  using Params = SurfacePatternParams;

  SurfacePattern(Surface surface, const K& kinetics, const Vec<species>& diffusivity, const Motion& motion = Motion(),
                 const Params& params = {}, const E& execution = {})
      : surface_(std::move(surface)),
        kinetics_(kinetics),
        diffusivity_(diffusivity),
        motion_(motion),
        params_(params),
        execution_(execution),
        band_(params.penalty > 0.0 ? Band({.penalty = params.penalty}) : Band()),
        chemistry_(Method(execution), params.steps, execution) {
    for (int s = 0; s < species; ++s) {
      if (diffusivity[s] >= 0.0 && std::isfinite(diffusivity[s])) continue;
      throw ValueError(
          detail::message("diffusivity ", diffusivity[s], " of species ", s, ": it must be finite and not negative"));
    }
    band_.fit(surface_, execution_);
    for (auto& column : c_) column.assign(band_.size(), T(0));
  }

  /// c := f(x), a Vec<species> at points of the surface.
  template <class F>
  void sample(F&& f) {
    const auto c = state();
    for_each(execution_, band_.size(), [&](std::size_t k) {
      const Vec<species> value = f(band_.point(k));
      for (int s = 0; s < species; ++s) c.column(s)[k] = static_cast<T>(value[s]);
    });
  }

  /// Advances by dt. \throws StabilityError and ConvergenceError of the chemistry, InterfaceError and BandError of the
  /// motion; then the pattern is as after the last part of the step that succeeded
  AdaptiveReport advance(double dt) {
    return advance(dt, [](double, const StepSize&, double) {});
  }
  /// observe(t, StepSize, error) is called after every step of the chemistry.
  template <class Observe>
  AdaptiveReport advance(double dt, Observe&& observe) {
    if constexpr (!Motion::moves) {
      const AdaptiveReport report = react_for(dt, observe);
      t_ += dt;
      return report;
    } else {
      detail::require_step(t_, dt);
      AdaptiveReport report = react_for(0.5 * dt, observe);
      move(dt);
      t_ += dt;
      const AdaptiveReport second = react_for(0.5 * dt, observe);
      report.steps += second.steps;
      report.rejected += second.rejected;
      report.evaluations += second.evaluations;
      report.error = second.error;
      report.last = second.last;
      if (second.longest.dt > report.longest.dt) report.longest = second.longest;
      for (std::size_t l = 0; l < limit_count; ++l) report.bound_by[l] += second.bound_by[l];
      return report;
    }
  }

  double time() const { return t_; }
  const Surface& surface() const { return surface_; }
  Band& band() { return band_; }
  const Band& band() const { return band_; }
  const K& kinetics() const { return kinetics_; }
  const Motion& motion() const { return motion_; }
  /// Concentrations at the values of the band; they may be changed.
  Columns<species, T> state() {
    std::array<T*, static_cast<std::size_t>(species)> first;
    for (std::size_t s = 0; s < first.size(); ++s) first[s] = c_[s].data();
    return columns<species>(first, band_.size());
  }
  std::span<const T> concentration(int s) const { return c_[static_cast<std::size_t>(s)]; }
  /// Amount of a species on the surface.
  double amount(int s) {
    SurfaceIntegral<Stencil, D, T> integral;
    integral.fit(surface_, band_, execution_);
    return integral(concentration(s));
  }
  /// dc/dt of reaction and diffusion.
  void rate(const Columns<species, const T>& c, const Columns<species, T>& rate) {
    SurfaceChemistry<K, Stencil, D, T, E>(band_, kinetics_, diffusivity_, execution_).rate(c, rate);
  }
  /// The chemistry's steps, e.g. their method.
  auto& steps() { return chemistry_; }

 private:
  using State = Columns<species, T>;
  using Method = typename Steps::template Method<State, E>;
  using Species = std::array<AlignedVector<T>, static_cast<std::size_t>(species)>;

  template <int N, class Pointers>
  static Columns<N, T> columns(const Pointers& first, std::size_t size) {
    std::array<T*, N> pointers;
    std::ranges::copy(first, pointers.begin());
    return {pointers, size};
  }
  static State view(Species& values, std::size_t size) {
    std::array<T*, static_cast<std::size_t>(species)> first;
    for (std::size_t s = 0; s < first.size(); ++s) {
      values[s].resize(size);
      first[s] = values[s].data();
    }
    return columns<species>(first, size);
  }
  template <class Observe>
  AdaptiveReport react_for(double dt, Observe&& observe) {
    SurfaceChemistry<K, Stencil, D, T, E> chemistry(band_, kinetics_, diffusivity_, execution_);
    auto rhs = Steps::rhs(chemistry);
    return chemistry_.advance(
        state(), t_, t_ + dt, rhs,
        [&](const auto&, double t, const StepSize& step, double error) { observe(t, step, error); });
  }
  void move(double dt) {
    moved_ = surface_;
    if constexpr (Motion::coupled) {
      // Half a step with the velocity of its beginning, then the whole one with that of the middle.
      carry(motion_.velocity(surface_, band_, state(), execution_), 0.5 * dt);
      const auto& u = motion_.velocity(moved_, next_, view(carried_, next_.size()), execution_);
      moved_ = surface_;
      carry(u, dt);
    } else {
      carry(motion_.velocity(surface_, band_, state(), execution_), dt);
    }
    std::swap(surface_, moved_);
    std::swap(band_, next_);
    std::swap(c_, carried_);
  }
  /// Moves moved_; next_ and carried_ are those of the moved one.
  template <class U>
  void carry(const U& u, double dt) {
    advection_.step(moved_, u, t_, dt, execution_);
    next_.fit(moved_, execution_);
    const auto to = view(carried_, next_.size());
    transport_(band_, state(), u, t_, dt, next_, to, execution_);
  }

  struct Nothing {
    template <class... Any>
    explicit Nothing(Any&&...) {}
  };
  template <class X>
  using IfMoving = std::conditional_t<Motion::moves, X, Nothing>;

  Surface surface_;
  K kinetics_;
  Vec<species> diffusivity_;
  Motion motion_;
  Params params_;
  E execution_;
  Band band_;
  Species c_;
  Adaptive<Method, State, E> chemistry_;
  double t_ = 0.0;
  [[no_unique_address]] IfMoving<Surface> moved_{surface_};
  [[no_unique_address]] IfMoving<Band> next_{band_};
  [[no_unique_address]] IfMoving<Species> carried_{c_};
  [[no_unique_address]] IfMoving<Backward<>> advection_{BackwardParams{.path_error = 1e-4, .octaves = 1e-3}};
  [[no_unique_address]] IfMoving<SurfaceTransport<Stencil, D, T>> transport_{
      typename SurfaceTransport<Stencil, D, T>::Params{.substeps = params_.motion_substeps}};
};

}  // namespace cambium
