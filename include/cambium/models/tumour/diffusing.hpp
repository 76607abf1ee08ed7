// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <utility>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>

namespace cambium {

/// Nutrient that takes time: dc/dt = Lap c - c inside (11.61), c = 1 on the interface and outside; at rest at first.
/// The backward differentiation formula of second order, L-stable, for steps of any length: with w the step over the
/// one before,
///   ((1 + 2 w) / (1 + w) + dt - dt Lap) c = (1 + w) c_last - w^2 / (1 + w) c_before;
/// Euler's implicit step where there is none before and where w > 2 (the formula amplifies waves beyond 1 + sqrt 2).
/// Nodes that were outside at earlier times have the smooth continuation of what c was inside then, by polynomials
/// through the 1 on the interface: it reaches 3 nodes. What an interface that goes further in two steps uncovers
/// starts with 1.
struct Diffusing {
  using Kind = tumour_kind::Nutrient;

  template <int D>
  class Method {
   public:
    Method(const Lattice<D>& lattice, const OpenMP& execution)
        : last_(lattice, 1.0), before_(lattice, 1.0), right_(lattice), execution_(execution) {}

    /// c := the nutrient `elapsed` after that of the last accept(); at rest if that is infinite, and that of the last
    /// accept() if it is 0, which belongs to the interface of that.
    void solve(const NarrowBand<double, D>& band, double elapsed, Field<double, D>& c) {
      elapsed_ = elapsed;
      if (elapsed == 0.0) {
        for_each(execution_, c.size(), [&](std::size_t i) { c[i] = last_[i]; });
      } else if (std::isfinite(elapsed)) {
        step(band, elapsed, c);
      } else {
        attach(band, 1.0);
        right_.fill(0.0);
        solve_equations(c);
      }
      detail::for_each_side(band, execution_, [&](std::size_t i, bool inside) {
        if (!inside) c[i] = 1.0;
      });
    }
    /// Takes c, of the last solve(), as the nutrient from which the next is reckoned.
    void accept(const Field<double, D>& c) {
      std::swap(before_, last_);
      last_ = c;
      solver_->continue_beyond(last_, reach);
      last_step_ = elapsed_;
    }
    /// What the next solve() starts from, see SnapshotWriter.
    template <class Self, class Archive>
    static void visit(Self& self, Archive& archive) {
      archive("nutrient.last", self.last_);
      archive("nutrient.before", self.before_);
      archive("nutrient.step", self.last_step_);
    }

   private:
    static constexpr std::ptrdiff_t reach = 3;
    static constexpr double longest_ratio = 2.0;

    void attach(const NarrowBand<double, D>& band, double shift) {
      if (solver_) {
        solver_->update(band, shift);
      } else {
        solver_.emplace(band, typename Dirichlet<D>::Params{.shift = shift}, execution_);
      }
    }
    void solve_equations(Field<double, D>& c) {
      solver_->solve(
          right_, [](const Vec<D>&) { return 1.0; }, c);
    }
    void step(const NarrowBand<double, D>& band, double dt, Field<double, D>& c) {
      const double ratio = std::isfinite(last_step_) && dt <= longest_ratio * last_step_ ? dt / last_step_ : 0.0;
      const double of_last = (1.0 + ratio) / dt;
      const double of_before = ratio * ratio / (1.0 + ratio) / dt;
      attach(band, 1.0 + (1.0 + 2.0 * ratio) / (1.0 + ratio) / dt);
      for_each(execution_, c.size(), [&](std::size_t i) { right_[i] = of_last * last_[i] - of_before * before_[i]; });
      solve_equations(c);
    }

    std::optional<Dirichlet<D>> solver_;
    Field<double, D> last_, before_;  ///< continued beyond the interfaces of their times, 1 further out
    Field<double, D> right_;
    OpenMP execution_;
    double last_step_ = 0.0;  ///< to the nutrient of last_; infinite if that was at rest
    double elapsed_ = 0.0;    ///< of the last solve()
  };
};

}  // namespace cambium
