// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include <cambium/models/tumour/adams_bashforth.hpp>
#include <cambium/models/tumour/growth.hpp>
#include <cambium/models/tumour/short_gmres.hpp>

namespace cambium {

/// Steps of second order that are 32 times as long as the surface tension lets explicit ones be, with one evaluation
/// each: Adams and Bashforth's rule with the fast part of the tension taken at the new time,
///   V* = V_AB + dt gamma S kappa'(V* - V*_before),   kappa'(x) = -Lap_Gamma x - |A|^2 x,
/// S being the speed that a drop of the pressure causes (one Poisson solve). What is added is O(dt^2), so that the
/// order stays, and it damps every wave: with y' = -lambda y, z = lambda dt, the scheme is (1 + z) r^2 - (1 + z/2) r +
/// z/2 = 0, |r| < 1 for all z > 0. The first step is implicit Euler's.
struct SemiImplicit {
  using Kind = tumour_kind::Stepping;
  static constexpr bool keeps_speed = true;
  /// Steps so many times as long as explicit ones keep the loop short.
  static constexpr double real_axis = 32.0;

  /// Residual of the loop relative to its right-hand side, which is O(dt): its error is one of O(dt^2) in the speed.
  static constexpr double tolerance = 1e-2;
  static constexpr int most_iterations = 100;

  template <int D>
  class Method {
   public:
    explicit Method(const Lattice<D>& lattice) : x_(lattice), response_(lattice), last_(lattice), next_(lattice) {}

    template <class L, class Growth, class Move>
    int operator()(L& level_set, Growth& growth, const Field<double, D, Sparse>& before, double dt, double dt_before,
                   Field<double, D, Sparse>& rate, Move&& move, const OpenMP& execution) {
      const auto& band = level_set.band();
      detail::extrapolate_speed(growth.speed(), before, dt, dt_before, rate, execution);
      int iterations = 0;
      if (growth.parameters().tension > 0.0) {
        const detail::Stopwatch watch(growth.times().implicit);
        iterations = solve(band, growth, dt, dt_before, rate, execution);
      }
      next_ = rate;  // the rate of this step is that before the next only if this one succeeds
      move(rate);
      return iterations;
    }
    void accept() { std::swap(last_, next_); }
    template <class Self, class Archive>
    static void visit(Self& self, Archive& archive) {
      archive("rate.last", self.last_);
    }

   private:
    using Vector = detail::ShortGMRES::Vector;

    template <class Band, class Growth>
    int solve(const Band& band, Growth& growth, double dt, double dt_before, Field<double, D, Sparse>& rate,
              const OpenMP& execution) {
      list_nodes(rate);
      take_blocks(x_, band);
      x_.fill(0.0);  // no NaN: stencils read a lane or two more than they need, with no weight
      right_.resize(nodes_.size());
      guess_.resize(nodes_.size());
      for (std::size_t k = 0; k < nodes_.size(); ++k) {
        guess_[k] = dt_before > 0.0 ? last_rate(rate, nodes_[k]) : 0.0;
        right_[k] = at(rate, nodes_[k]) - guess_[k];
      }
      const int iterations = gmres_(
          [&](const Vector& in, Vector& out) {
            for (std::size_t k = 0; k < nodes_.size(); ++k) at(x_, nodes_[k]) = in[k];
            growth.tension_response(band, x_, response_);
            for (std::size_t k = 0; k < nodes_.size(); ++k) out[k] = in[k] - dt * at(response_, nodes_[k]);
          },
          right_, solution_, tolerance, most_iterations, execution);
      for (std::size_t k = 0; k < nodes_.size(); ++k) at(rate, nodes_[k]) = guess_[k] + solution_[k];
      return iterations;
    }
    /// Nodes with a speed.
    void list_nodes(const Field<double, D, Sparse>& rate) {
      nodes_.clear();
      for (std::size_t b = 0; b < rate.blocks(); ++b) {
        for (std::size_t i = 0; i < rate.block(b).size(); ++i) {
          if (!std::isnan(rate.block(b)[i])) nodes_.push_back(b * rate.block(b).size() + i);
        }
      }
    }
    static double& at(Field<double, D, Sparse>& field, std::size_t node) {
      return field.block(node / BlockShape<D>::volume)[node % BlockShape<D>::volume];
    }
    /// Rate of the last step at a node of the band now; the rate now where there was none.
    double last_rate(Field<double, D, Sparse>& rate, std::size_t node) {
      const std::ptrdiff_t b = last_.find(rate.block_index(node / BlockShape<D>::volume));
      const double now = at(rate, node);
      if (b < 0) return now;
      const double value = last_.block(static_cast<std::size_t>(b))[node % BlockShape<D>::volume];
      return std::isnan(value) ? now : value;
    }

    detail::ShortGMRES gmres_;
    Field<double, D, Sparse> x_, response_, last_, next_;
    std::vector<std::size_t> nodes_;
    Vector right_, guess_, solution_;
  };
};

}  // namespace cambium
