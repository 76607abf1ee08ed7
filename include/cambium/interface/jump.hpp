// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <cambium/interface/jump_data.hpp>
#include <cambium/interface/jump_patch.hpp>
#include <cambium/interface/jump_rule.hpp>
#include <cambium/kernels/m4_prime.hpp>
#include <cambium/levelset/field_patch.hpp>
#include <cambium/operators/differences.hpp>

namespace cambium {

/// The two sides of a solution at the closest points of the nodes of a band; see BasicJump::at_interface().
template <int D, class T = double>
struct InterfaceSides {
  Field<T, D, Sparse> inside;
  Field<T, D, Sparse> outside;
  Field<Vec<D, T>, D, Sparse> gradient_inside;
  Field<Vec<D, T>, D, Sparse> gradient_outside;

  explicit InterfaceSides(const Lattice<D>& lattice)
      : inside(lattice), outside(lattice), gradient_inside(lattice), gradient_outside(lattice) {}
};

/// The jump continued off the interface: D(y) = a + phi b + phi^2 / 2 ([Lap p] - kappa b - Lap_Gamma a), all taken at
/// the closest point of y. It is the Taylor polynomial along the normal of the function with these data on the
/// interface.
struct JumpExtension {
  /// \param surface_laplacian  of a
  template <class T>
  static T at_node(T distance, T curvature, T a, T b, T laplacian, T surface_laplacian) {
    return a + distance * (b + T(0.5) * distance * (laplacian - curvature * b - surface_laplacian));
  }
  /// On a leg, from D and phi at its near and at its far node: D at the far node.
  template <class T>
  static T on_leg(T, T far, T, T) {
    return far;
  }
  template <class T, int D>
  static Vec<D, T> gradient(const Vec<D, T>& surface_gradient, const Vec<D, T>& normal, T b) {
    return surface_gradient + b * normal;
  }
};

/// Corrections of -Lap p = f for a solution that jumps across an interface: solvers of the centred stencils are used
/// unchanged.
///
///     cambium::Jump<2> jump(lattice);
///     jump.attach(level_set.band());
///     jump.set(a, b, source);             // [p], [dp/dn], [f]: functions of the position, or fields of the band
///     jump.correct(f);                    // f of each side on its own nodes
///     poisson.solve(f, p);                // with SecondOrder
///     jump.gradient(p, g);                // right up to the interface
///     jump.at_interface(p, sides);        // values and gradients of both sides on it
///
/// Brackets are outside minus inside, n points outwards: [p] = p_out - p_in. A leg from a node inside to y outside
/// reads p_in(y) = p(y) - D(y), one from outside to y inside p_out(y) = p(y) + D(y), where D continues the jump off the
/// interface. It is exact to O(distance^3), which makes p second-order in the maximum norm, and its gradient but for a
/// logarithm (Beale and Layton 2006). The corrected f has a mean of the size of the error: periodic solvers must be
/// told to take it off (MeanPart::subtract).
///
/// A user of the object calls attach() for every new interface and set() for new data on it. Interfaces must stay 3
/// nodes away from bounded faces. Where it comes within a spacing of itself no smooth jump can be read: see
/// UnresolvedLegs. \tparam Rule  what is put on a leg, see JumpRule \tparam K     kernel of the geometry and of the
/// surface derivatives of a
template <int D, class T, class Rule, class K = Lambda<4, 4>>
class BasicJump {
 public:
  using Scalar = T;
  using Band = NarrowBand<T, D>;
  using Points = ClosestPoints<K, T, D>;
  static constexpr int dimension = D;
  /// Spacings between a point and the nodes that kernel G reads there.
  template <class G>
  static double reach_of() {
    return 0.5 * G::support * std::sqrt(static_cast<double>(D));
  }

  struct Params {
    UnresolvedLegs unresolved = UnresolvedLegs::reject;
    /// Distance from the interface, in spacings, up to which nodes know the jump and get values at_interface(): at
    /// least 2, and what its stencils need, which the default is.
    double reach = reach_of<M4Prime>();
  };

  explicit BasicJump(const Lattice<D>& lattice, const Params& params = {})
      : params_(params),
        geometry_((check_jump_rule<Rule>(), lattice), params.reach),
        value_(lattice),
        normal_(lattice),
        source_(lattice),
        extension_(lattice),
        gradient_(lattice) {}

  const Lattice<D>& lattice() const { return geometry_.lattice(); }
  /// Legs of one step that two parts of the interface cross; zero unless UnresolvedLegs::keep.
  std::size_t unresolved() const { return geometry_.legs().unresolved(); }

  /// Takes a new interface: finds its closest points, or copies `points`, those of points.find(band, ...), as
  /// LevelSet::method().points() are. set() must follow.
  /// \throws SizeError if the band is on another lattice; ValueError if it is too thin; InterfaceError if there is no
  ///         interface, it is within two nodes of a bounded face, or within a spacing of itself
  template <Execution E = OpenMP>
  void attach(const Band& band, const E& execution = {}) {
    attach(band, nullptr, execution);
  }
  template <Execution E = OpenMP>
  void attach(const Band& band, const Points& points, const E& execution = {}) {
    attach(band, &points, execution);
  }

  /// Sets a = [p], b = [dp/dn] and [f]; see JumpData. Functions are called by several threads, at points within
  /// rounding and the error of the closest points of the interface; a must be smooth along it. \throws ValueError if a
  /// value is not finite; SizeError if a field has other blocks than the band
  template <class A, class B = NoJump, class F = NoJump, Execution E = OpenMP>
  void set(const A& a, const B& b = {}, const F& f = {}, const E& execution = {}) {
    ready_ = false;
    if (!attached_) throw ValueError("the jump has no interface yet: call attach() first");
    detail::read_jump(a, geometry_, "the jump of the value", value_, execution);
    detail::read_jump(b, geometry_, "the jump of the normal derivative", normal_, execution);
    detail::read_jump(f, geometry_, "the jump of the right-hand side", source_, execution);
    extend(execution);
    ready_ = true;
  }

  /// Adds to f what makes the stencil's solution that with the jump. \throws SizeError if f is on another lattice,
  /// ValueError before set()
  template <class Symbol = SecondOrder, Execution E = OpenMP>
  void correct(Field<T, D>& f, const E& execution = {}) const {
    require(f);
    const double h = lattice().spacing();
    for_each_crossed_leg(execution, StencilLegs<Symbol>::second,
                         [&](const detail::JumpLeg& leg, double weight, T jump) {
                           const T change = static_cast<T>(weight / (h * h)) * jump;
                           f[leg.node] += leg.inside ? -change : change;
                         });
  }

  /// g := gradient of p by centred differences, each node's own side continued across crossed legs.
  /// \throws as correct(), LatticeError if an axis has fewer nodes than the stencil
  template <class Symbol = SecondOrder, Execution E = OpenMP>
  void gradient(const Field<T, D>& p, Field<Vec<D, T>, D>& g, const E& execution = {}) const {
    require(p);
    CentredDifference<Symbol::order>::gradient(p, g, execution);
    const double h = lattice().spacing();
    for_each_crossed_leg(execution, StencilLegs<Symbol>::first, [&](const detail::JumpLeg& leg, double weight, T jump) {
      const T change = static_cast<T>((leg.steps < 0 ? -weight : weight) / h) * jump;
      g[leg.node][leg.axis] += leg.inside ? -change : change;
    });
  }

  /// Values and gradients of both sides at the closest points of the nodes within Params::reach; zero elsewhere. Every
  /// node on a normal has the same, so these are extensions off the interface.
  /// \tparam G  interpolating kernel; its order of the gradient, K::moments, should be 2 at least
  /// \throws as correct(), ValueError if the stencils of G reach further than Params::reach
  template <class G = M4Prime, Execution E = OpenMP>
  void at_interface(const Field<T, D>& p, InterfaceSides<D, T>& sides, const E& execution = {}) {
    require(p);
    if (geometry_.reach() < reach_of<G>() * (1.0 - 1e-12)) {
      throw ValueError(detail::message("the jump is known up to ", geometry_.reach(),
                                       " spacings from the interface, but ", "stencils there read ", reach_of<G>(),
                                       ": choose a larger Params::reach"));
    }
    const Band& band = geometry_.band();
    take_blocks(sides.inside, band);
    take_blocks(sides.outside, band);
    take_blocks(sides.gradient_inside, band);
    take_blocks(sides.gradient_outside, band);
    const detail::SmoothedJump<D, T> smooth{p, extension_, band};
    smooth_patches_.resize(static_cast<std::size_t>(execution.count()));
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      auto& patch = smooth_patches_[worker];
      geometry_.template for_each_near<G>(
          b, smooth, patch,
          [&](std::size_t i, const Vec<D, T>& u) {
            write(sides, b, i, Interpolant<G, T, D>::jet(patch.data(), patch.stride(), u));
          },
          [&](std::size_t i) {
            sides.inside.block(b)[i] = sides.outside.block(b)[i] = T(0);
            sides.gradient_inside.block(b)[i] = sides.gradient_outside.block(b)[i] = {};
          });
    });
  }

  /// D at the nodes of the band within the reach of stencils.
  const Field<T, D, Sparse>& extension() const { return extension_; }

 private:
  template <Execution E>
  void attach(const Band& band, const Points* points, const E& execution) {
    ready_ = false;
    attached_ = false;
    geometry_.find(band, points, params_.unresolved, execution);
    attached_ = true;
  }

  /// The extension of the jump and the jump of the gradient, from the data.
  template <Execution E>
  void extend(const E& execution) {
    const Band& band = geometry_.band();
    take_blocks(extension_, band);
    take_blocks(gradient_, band);
    patches_.resize(static_cast<std::size_t>(execution.count()));
    const T per_length = static_cast<T>(1.0 / band.spacing());
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      auto& patch = patches_[worker];
      geometry_.template for_each_near<K>(
          b, value_, patch,
          [&](std::size_t i, const Vec<D, T>& u) {
            // a is constant along normals off the interface, so that its Laplacian there is that of the surface.
            const Jet<T, D> jet = Interpolant<K, T, D>::jet(patch.data(0), patch.stride(), u);
            T surface_laplacian{};
            for (int d = 0; d < D; ++d) surface_laplacian += jet.hessian[d][d] * per_length * per_length;
            const T a = value_.block(b)[i], slope = normal_.block(b)[i];
            extension_.block(b)[i] = Rule::at_node(geometry_.distance(b, i), geometry_.curvature(b, i), a, slope,
                                                   -source_.block(b)[i], surface_laplacian);
            gradient_.block(b)[i] = Rule::gradient(jet.gradient * per_length, geometry_.normal(b, i), slope);
          },
          [&](std::size_t i) {
            extension_.block(b)[i] = T(0);
            gradient_.block(b)[i] = {};
          });
    });
  }
  void write(InterfaceSides<D, T>& sides, std::size_t b, std::size_t i, const Jet<T, D>& smooth) const {
    const T half = T(0.5) * value_.block(b)[i];
    const Vec<D, T> half_gradient = T(0.5) * gradient_.block(b)[i];
    const Vec<D, T> middle = smooth.gradient / static_cast<T>(lattice().spacing());
    sides.inside.block(b)[i] = smooth.value - half;
    sides.outside.block(b)[i] = smooth.value + half;
    sides.gradient_inside.block(b)[i] = middle - half_gradient;
    sides.gradient_outside.block(b)[i] = middle + half_gradient;
  }

  /// Calls f(leg, weight, jump) for the crossed legs that a stencil with these weights has.
  template <std::size_t N, Execution E, class F>
  void for_each_crossed_leg(const E& execution, const std::array<double, N>& weights, F&& f) const {
    const auto at = [](const Field<T, D, Sparse>& field, std::size_t entry) {
      return field.block(entry / Band::volume)[entry % Band::volume];
    };
    const auto distance = [&](std::size_t entry) {
      return geometry_.distance(entry / Band::volume, entry % Band::volume);
    };
    for_each_piece(execution, geometry_.band().blocks(), 1, [&](std::size_t b, std::size_t) {
      geometry_.legs().for_each(b, [&](const detail::JumpLeg& leg) {
        const auto steps = static_cast<std::size_t>(leg.steps < 0 ? -leg.steps : leg.steps);
        if (steps > N) return;
        f(leg, weights[steps - 1],
          Rule::on_leg(at(extension_, leg.here), at(extension_, leg.far), distance(leg.here), distance(leg.far)));
      });
    });
  }
  void require(const Field<T, D>& field) const {
    if (!ready_) throw ValueError("the jump has no interface yet: call attach() and set() first");
    if (!(field.lattice() == lattice())) {
      throw SizeError("the field is not on the lattice that the jump was made for: make one jump per lattice");
    }
  }

  Params params_;
  detail::JumpGeometry<D, T, K> geometry_;
  Field<T, D, Sparse> value_;
  Field<T, D, Sparse> normal_;
  Field<T, D, Sparse> source_;
  Field<T, D, Sparse> extension_;
  Field<Vec<D, T>, D, Sparse> gradient_;
  std::vector<FieldPatch<T, D>> patches_;
  std::vector<detail::JumpPatch<T, D>> smooth_patches_;
  bool attached_ = false;
  bool ready_ = false;
};

/// The whole jump, by one formula for every leg and dimension.
template <int D, class T = double, class K = Lambda<4, 4>>
using Jump = BasicJump<D, T, JumpExtension, K>;

}  // namespace cambium
