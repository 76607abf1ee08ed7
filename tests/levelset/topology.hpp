// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include <cambium/levelset.hpp>

/// Shapes that merge and pinch, at a resolution at which nothing about it is resolved.
namespace topology {

using namespace cambium;

template <int N>
using Dimension = std::integral_constant<int, N>;
using Dimensions = std::tuple<Dimension<2>, Dimension<3>>;

constexpr int cells = 40;
constexpr double h = 2.0 / cells;

template <int D>
Lattice<D> lattice() {
  return Lattice<D>::bounded_box({Vec<D>::constant(-1.0), Vec<D>::constant(1.0)}, cells);
}

/// Sources of the flows are as many spacings wide: there the speed falls to zero.
constexpr double core = 3.0;

/// Position in a frame whose first axis, that of the scene, lies skew in the lattice.
template <int D>
Vec<D> in_frame(const Vec<D>& x, bool back = false) {
  const double c = std::cos(0.3), s = back ? std::sin(0.3) : -std::sin(0.3);
  const Vec<D> middle = Vec<D>::constant(0.013);
  Vec<D> r = back ? x : x - middle;
  const double turned = c * r[0] - s * r[1];
  r[1] = s * r[0] + c * r[1];
  r[0] = turned;
  return back ? r + middle : r;
}

/// Two balls that grow at speed 1: they merge when t = half of the gap.
template <int D>
struct Merging {
  static constexpr int before = 2, after = 1;
  static constexpr double radius = 0.25;
  static constexpr double half_gap = 2.0 * h;
  static constexpr double event = half_gap;
  static constexpr double end = 3.0 * h;

  static Vec<D> centre(double side) { return in_frame(Vec<D>::unit(0, side * (radius + half_gap)), true); }
  static Vec<D> nearer(const Vec<D>& x) { return centre(in_frame(x)[0] < 0.0 ? -1.0 : 1.0); }
  /// The distance itself, where x is outside or the balls are apart.
  double operator()(const Vec<D>& x) const { return norm(x - nearer(x)) - radius - t; }
  Vec<D> velocity(const Vec<D>& x) const {
    const Vec<D> r = x - nearer(x);
    return r / std::max(norm(r), core * h);
  }
  /// True if the distance is known, and smooth around x as far as stencils reach.
  bool smooth(const Vec<D>& x) const {
    return std::abs(in_frame(x)[0]) > 4.0 * h && (*this)(x) > (t < event ? -h : 0.0);
  }

  double t = 0.0;
};

/// A body of two lobes (Cassini's oval turned about its axis) cut by the growth, at speed 1, of a ring around its neck:
/// everything goes straight away from the ring, and two sides of the neck meet when t is its radius.
template <int D>
struct Pinching {
  static constexpr int before = 1, after = 2;
  static constexpr double focus = 0.42;
  static constexpr double neck = 2.5 * h;
  static constexpr double ring = 0.4;
  static constexpr double event = neck;
  static constexpr double end = 4.0 * h;

  /// Of slope about 1 at the interface, but no distance.
  static double body(const Vec<D>& r) {
    const Vec<D> f = Vec<D>::unit(0, focus);
    return std::sqrt(norm(r - f) * norm(r + f)) - std::sqrt(std::sqrt(std::pow(focus * focus + neck * neck, 2)));
  }
  /// From the nearest point of the ring to r, of length 1 away from it.
  static Vec<D> away(const Vec<D>& r) {
    double across = 0.0;
    for (int d = 1; d < D; ++d) across += r[d] * r[d];
    across = std::sqrt(across);
    Vec<D> from = r;
    for (int d = 1; d < D; ++d) from[d] = across > 1e-12 ? r[d] * (1.0 - ring / across) : (d == 1 ? -ring : 0.0);
    return from / std::max(norm(from), core * h);
  }
  double operator()(const Vec<D>& x) const {
    const Vec<D> r = in_frame(x);
    return body(r - t * away(r));
  }
  Vec<D> velocity(const Vec<D>& x) const { return in_frame(away(in_frame(x)), true) - Vec<D>::constant(0.013); }
  bool smooth(const Vec<D>&) const { return false; }

  double t = 0.0;
};

/// What a level set shows at a time `since` the event, in times that the interface takes for a spacing.
struct State {
  double since = 0.0;
  std::string error;  ///< text of a cambium::Error, or empty
  bool finite = true;
  std::size_t inside = 0;    ///< connected parts of the inside
  std::size_t far_away = 0;  ///< nodes on the wrong side, more than two spacings off the exact interface
  double volume = 0.0;       ///< relative error
  double distance = 0.0;     ///< worst error of phi within 3 h where the distance is smooth, in h
};

/// Volume where f < 0, f being of slope about 1 there: cells around nodes by 4^D points where f may change its sign.
template <int D, class F>
double volume_of(const F& f) {
  constexpr int finer = 4;
  const Index<D> part = Index<D>::constant(finer);
  double sum = 0.0;
  for (std::size_t k = 0; k < lattice<D>().size(); ++k) {
    const Vec<D> x = lattice<D>().position(lattice<D>().node(k));
    const double value = f(x);
    if (std::abs(value) > 2.0 * h) {
      sum += value < 0.0 ? 1.0 : 0.0;
      continue;
    }
    for (std::ptrdiff_t p = 0; p < product(part); ++p) {
      Vec<D> y = x;
      std::ptrdiff_t rest = p;
      for (int d = 0; d < D; ++d, rest /= finer) y[d] += ((static_cast<double>(rest % finer) + 0.5) / finer - 0.5) * h;
      sum += std::clamp(0.5 - f(y) * finer / h, 0.0, 1.0) / static_cast<double>(product(part));
    }
  }
  return sum * lattice<D>().cell_volume();
}

template <class L, class Scene>
State look_at(const L& level_set, const Scene& exact) {
  constexpr int D = L::dimension;
  State state{.since = (exact.t - Scene::event) / h, .error = ""};
  for (std::size_t k = 0; k < level_set.lattice().size(); ++k) {
    const Index<D> node = level_set.lattice().node(k);
    const Vec<D> x = level_set.lattice().position(node);
    const double phi = level_set.band()(node), e = exact(x);
    state.finite &= std::isfinite(phi);
    state.far_away += (phi < 0.0) != (e < 0.0) && std::abs(e) > 2.0 * h ? 1 : 0;
    if (exact.smooth(x) && std::abs(e) < 3.0 * h) state.distance = std::max(state.distance, std::abs(phi - e) / h);
  }
  const Measures<D> found = measures(level_set.band());
  state.inside = found.inside_components;
  state.volume = found.volume / volume_of<D>(exact) - 1.0;
  return state;
}

/// f(), or a state with the text of the error that it throws. What is not a cambium::Error ends the test.
template <class F>
State state_or_error(double since, F&& f) {
  try {
    return f();
  } catch (const Error& error) {
    return {.since = since, .error = error.what()};
  }
}

/// A level set made from the shape at one time after the other, `step` spacings apart.
template <class R, class Scene, int D>
std::vector<State> sampled(double step, const typename R::Params& reinit = {}) {
  std::vector<State> states;
  typename LevelSet<R, D>::Params params;
  params.reinit = reinit;
  for (double t = 0.0; t < Scene::end + 0.1 * h; t += step * h) {
    states.push_back(state_or_error((t - Scene::event) / h,
                                    [&] { return look_at(LevelSet<R, D>(lattice<D>(), Scene{t}, params), Scene{t}); }));
  }
  return states;
}

/// A level set that the flow carries in steps of half a spacing, until the first error.
template <class R, class Scene, int D, class A>
std::vector<State> carried(A advection) {
  std::vector<State> states;
  const Scene start;
  LevelSet<R, D> level_set(lattice<D>(), start);
  const double dt = 0.5 * h;
  for (double t = 0.0; t < Scene::end && (states.empty() || states.back().error.empty()); t += dt) {
    states.push_back(state_or_error((t + dt - Scene::event) / h, [&] {
      advection.step(
          level_set, [&](const Vec<D>& x, double) { return start.velocity(x); }, t, dt);
      return look_at(level_set, Scene{t + dt});
    }));
  }
  return states;
}

/// The worst of all states, for the record.
struct Summary {
  std::size_t errors = 0;
  std::size_t wrong_counts = 0;  ///< more than a step before or after the event
  double volume = 0.0;
  double distance = 0.0;
};

/// Holds states to what no method may do: a value that is not finite, a part of the inside far from the shape.
template <class Scene>
Summary check(const std::string& name, const std::vector<State>& states) {
  Summary worst;
  for (const State& state : states) {
    if (!state.error.empty()) {
      ++worst.errors;
      BOOST_TEST_MESSAGE("  " << state.since << " h: " << state.error);
      continue;
    }
    BOOST_TEST(state.finite);
    BOOST_TEST(state.far_away == 0U);
    const std::size_t parts = state.since < 0.0 ? Scene::before : Scene::after;
    worst.wrong_counts += std::abs(state.since) > 0.6 && state.inside != parts ? 1 : 0;
    worst.volume = std::max(worst.volume, std::abs(state.volume));
    worst.distance = std::max(worst.distance, state.distance);
  }
  BOOST_TEST_MESSAGE(name << ": " << worst.errors << " errors, " << worst.wrong_counts << " wrong counts, volume "
                          << worst.volume << ", distance " << worst.distance << " h");
  return worst;
}

/// check() for a reinitialisation and both scenes. \param step  3D, in spacings. \return the worst of both
template <class R, int D>
Summary check_sampled(const std::string& name, const typename R::Params& reinit = {}, double step = 0.5) {
  step = D == 2 ? 0.25 : step;
  const std::string where = name + " " + std::to_string(D) + "D ";
  const Summary a = check<Merging<D>>(where + "merging", sampled<R, Merging<D>, D>(step, reinit));
  const Summary b = check<Pinching<D>>(where + "pinching", sampled<R, Pinching<D>, D>(step, reinit));
  return {a.errors + b.errors, a.wrong_counts + b.wrong_counts, std::max(a.volume, b.volume),
          std::max(a.distance, b.distance)};
}

}  // namespace topology
