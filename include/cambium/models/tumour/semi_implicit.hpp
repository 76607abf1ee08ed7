// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <limits>

#include <cambium/models/tumour/adams_bashforth.hpp>
#include <cambium/models/tumour/growth.hpp>
#include <cambium/models/tumour/tension_damping.hpp>
#include <cambium/models/tumour/value_at.hpp>
#include <cambium/surface/surface_band.hpp>

namespace cambium {

/// Steps of second order that surface tension does not bound, with one evaluation each and no Poisson solve more: the
/// backward differentiation formula of second order, with the fast part of the tension at the new time,
///   share V* - (share - 1) V*_before = V + w (V - V_before) - dt B (V* - V*_before),
///   w = dt / dt_before, share = (1 + 2 w) / (1 + w),
///   B = gamma m (-Lap_Gamma)^(3/2) (1 - h^2 Lap_Gamma / 2), m = 1/2 (pressure on both sides) or 1 (p = 0 outside).
/// A wave of wave number k decays at gamma m k^3 when it is short (Hou, Lowengrub & Shelley 1994, J. Comput. Phys.
/// 114); what it decays at in truth, of long waves too, is in V. What is added is O(dt^2), so that the order stays.
/// With y' = -lambda y and dt B = a z, z = lambda dt, growth factors are the roots of
///   3/2 r^2 - 2 r + 1/2 + z (2 r - 1 + a (r - 1)^2) = 0,
/// |r| < 1 for all z > 0 if a >= 3/4, and r -> 0 for the shortest waves if a = 1. The first step is implicit Euler's.
struct SemiImplicit {
  using Kind = tumour_kind::Stepping;
  static constexpr bool keeps_speed = true;
  static constexpr double real_axis = std::numeric_limits<double>::infinity();

  template <int D>
  class Method {
   public:
    explicit Method(const Lattice<D>& lattice) : last_(lattice), next_(lattice), change_(lattice) {}

    template <class L, class Growth, class Move>
    int operator()(L& level_set, const L&, Growth& growth, const Field<double, D, Sparse>& before, double dt,
                   double dt_before, Field<double, D, Sparse>& rate, Move&& move, const OpenMP& execution) {
      const double ratio = dt_before > 0.0 ? dt / dt_before : 0.0;
      int products = 0;
      if (growth.parameters().tension > 0.0) {
        const detail::Stopwatch watch(growth.times().implicit);
        surface_.fit(level_set, execution);
        products = damp(level_set.band(), growth, before, dt, ratio, rate, execution);
      } else {
        detail::extrapolate_speed(growth.speed(), before, 0.5 * ratio, rate, execution);
      }
      next_ = rate;  // the rate of this step is that before the next only if this one succeeds
      move(rate);
      return products;
    }
    void accept() { std::swap(last_, next_); }
    /// The rate of the last step is its state.
    template <class Self, class Archive>
    static void visit(Self& self, Archive& archive) {
      archive("rate.last", self.last_);
    }

   private:
    using Band = NarrowBand<double, D>;

    /// rate := V*.
    template <class Growth>
    int damp(const Band& band, const Growth& growth, const Field<double, D, Sparse>& before, double dt, double ratio,
             Field<double, D, Sparse>& rate, const OpenMP& execution) {
      const double h = band.spacing();
      const auto negative_laplacian = [&](const auto& in, auto& out) {
        surface_.laplacian(in, out, execution);
        for_each(execution, out.size(), [&](std::size_t k) { out[k] *= -h * h; });
      };
      const auto& speed = growth.speed();
      list_nodes(band, execution);
      for (auto* values : {&x_, &last_rate_, &trend_}) values->resize(surface_.size());
      for_each(execution, x_.size(), [&](std::size_t k) {
        x_[k] = speed.block(place_[k] / Band::volume)[place_[k] % Band::volume];
        last_rate_[k] = ratio > 0.0 ? value_of(last_, speed, place_[k], x_[k]) : 0.0;
        trend_[k] = ratio > 0.0 ? ratio * (x_[k] - value_of(before, speed, place_[k], x_[k])) : 0.0;
      });
      int products = 0;
      if (ratio > 0.0) {
        products += solve_.smooth(negative_laplacian, last_rate_, execution);
        products += solve_.smooth(negative_laplacian, trend_, execution);
      }
      for_each(execution, x_.size(), [&](std::size_t k) { x_[k] += trend_[k] - last_rate_[k]; });
      const double weight = dt * growth.tension_mobility() / (h * h * h);
      products += solve_.damp((1.0 + 2.0 * ratio) / (1.0 + ratio), weight, negative_laplacian, x_, execution);
      spread(band, growth, rate, execution);
      return products;
    }
    /// Where the values of the surface are in the fields of the band.
    void list_nodes(const Band& band, const OpenMP& execution) {
      place_.resize(surface_.size());
      for_each(execution, place_.size(), [&](std::size_t k) {
        const Index<D>& node = surface_.node(k);
        const std::ptrdiff_t b = band.values().find(band.values().block_of(node));
        place_[k] = static_cast<std::size_t>(b) * Band::volume + band.values().offset(node);
      });
    }
    static double& at(Field<double, D, Sparse>& field, std::size_t place) {
      return field.block(place / Band::volume)[place % Band::volume];
    }
    /// Value of a field of a band of before at a node of the band of `now`; `none` where it has none.
    static double value_of(const Field<double, D, Sparse>& field, const Field<double, D, Sparse>& now,
                           std::size_t place, double none) {
      const std::ptrdiff_t b = field.find(now.block_index(place / Band::volume));
      if (b < 0) return none;
      const double value = field.block(static_cast<std::size_t>(b))[place % Band::volume];
      return std::isnan(value) ? none : value;
    }
    /// rate := that of the last step, smoothed, + x, at all nodes of the band.
    template <class Growth>
    void spread(const Band& band, const Growth& growth, Field<double, D, Sparse>& rate, const OpenMP& execution) {
      take_blocks(change_, band);
      change_.fill(std::numeric_limits<double>::quiet_NaN());
      for (std::size_t k = x_.size(); k-- > 0;) at(change_, place_[k]) = last_rate_[k] + x_[k];
      rate = growth.speed();
      for_each_piece(execution, band.blocks(), 1, [&](std::size_t b, std::size_t) {
        for (std::size_t i = 0; i < Band::volume; ++i) {
          double& v = rate.block(b)[i];
          if (std::isnan(v)) continue;
          const double known = change_.block(b)[i];
          v = std::isnan(known) ? detail::value_at(change_, band, growth.closest_point(band, b, i)) : known;
        }
      });
    }

    detail::TensionDamping solve_;
    SurfaceBand<SurfaceLaplacian<2>, D> surface_;
    Field<double, D, Sparse> last_, next_, change_;
    std::vector<std::size_t> place_;
    std::vector<double> x_, last_rate_, trend_;
  };
};

}  // namespace cambium
