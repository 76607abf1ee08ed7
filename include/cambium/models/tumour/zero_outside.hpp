// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <cambium/interface/dirichlet.hpp>
#include <cambium/levelset/closest_point_walk.hpp>
#include <cambium/levelset/geometry/band_geometry.hpp>
#include <cambium/levelset/jet.hpp>
#include <cambium/models/tumour/policy.hpp>
#include <cambium/models/tumour/sides.hpp>

namespace cambium {

namespace detail {

/// Value of a field of a band at a point, interpolated by M4'.
template <int D>
double value_at(const Field<double, D, Sparse>& field, const NarrowBand<double, D>& band, const Vec<D>& x) {
  constexpr std::ptrdiff_t support = 4;
  std::array<double, static_cast<std::size_t>(D == 2 ? 16 : 64) + 16> nodes{};
  Index<D> first, stride;
  Vec<D> u;
  for (int d = 0; d < D; ++d) {
    const double place = (x[d] - band.lattice().box().lo[d]) / band.spacing();
    first[d] = static_cast<std::ptrdiff_t>(std::floor(place)) - support / 2 + 1;
    u[d] = place - static_cast<double>(first[d]);
    stride[d] = d == 0 ? 1 : stride[d - 1] * support;
  }
  for (std::ptrdiff_t k = 0; k < (D == 2 ? 16 : 64); ++k) {
    Index<D> node = first;
    for (int d = 0; d < D; ++d) node[d] += k / stride[d] % support;
    nodes[static_cast<std::size_t>(k)] = field(band.inside(node));
  }
  return Interpolant<M4Prime, double, D>::value(nodes.data(), stride, u);
}

/// Pressure inside alone, p given on the interface.
template <int D, class K>
class InsidePressure {
 public:
  using Band = NarrowBand<double, D>;
  using Values = Field<double, D, Sparse>;

  InsidePressure(const Lattice<D>& lattice, double, const OpenMP& execution)
      : execution_(execution), zero_(lattice), grown_(lattice), dropped_(lattice), part_(lattice), slope_(lattice) {}

  void attach(const Band& band, const ClosestPoints<K, double, D>& points, const BandGeometry<double, D>&) {
    if (solver_) {
      solver_->update(band);
    } else {
      solver_.emplace(band, typename Dirichlet<D>::Params{}, execution_);
    }
    band_ = &band;
    points_ = &points;
  }
  /// As JumpPressure::solve(), with p = 0 outside, in two parts: that of f with p = 0 on the interface, whose slope is
  /// taken by cubic polynomials, and that of the drop, see respond(). \throws InterfaceError if the tumour is too thin
  /// for a gradient
  void solve(Field<double, D>& f, const Values& drop, double, Field<double, D>& p, Values& speed) {
    solver_->solve(
        f, [](const Vec<D>&) { return 0.0; }, grown_);
    set_outside(grown_, std::numeric_limits<double>::quiet_NaN());
    solver_->continue_beyond(grown_, 3);
    differentiate(grown_, speed);
    set_outside(grown_, 0.0);
    part_ = speed;
    respond(drop, part_);
    for (std::size_t b = 0; b < speed.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) speed.block(b)[i] += part_.block(b)[i];
    }
    for_each(execution_, p.size(), [&](std::size_t i) { p[i] = grown_[i] + dropped_[i]; });
  }
  /// What a drop of the pressure alone adds to the speed: Lap p = 0. Its slope is that of differences, of second order:
  /// where the drop varies from node to node, as noise does, the cubic polynomials across the interface would have
  /// slopes of the wrong sign, and the noise grow.
  void respond(const Values& drop, Values& speed) {
    solver_->solve(
        zero_, [&](const Vec<D>& x) { return value_at(drop, *band_, x); }, dropped_);
    solver_->normal_derivative(*band_, *points_, dropped_, slope_, Slopes::differences);
    for (std::size_t b = 0; b < speed.blocks(); ++b) {
      for (std::size_t i = 0; i < Band::volume; ++i) {
        if (!std::isnan(speed.block(b)[i])) speed.block(b)[i] = -slope_.block(b)[i];
      }
    }
    set_outside(dropped_, 0.0);
  }
  std::size_t unresolved() const { return 0; }

 private:
  void set_outside(Field<double, D>& p, double value) const {
    for_each_side(*band_, execution_, [&](std::size_t i, bool inside) {
      if (!inside) p[i] = value;
    });
  }
  /// speed := -dp/dn, p continued beyond the interface, from cubic polynomials through four nodes along each axis.
  void differentiate(const Field<double, D>& p, Values& speed) {
    patches_.resize(static_cast<std::size_t>(execution_.count()));
    const double h = band_->spacing();
    for_each_piece_by_worker(execution_, band_->blocks(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      Patch<double, D>& patch = patches_[worker];
      for_each_closest_point(
          *points_, *band_, b, *band_, patch,
          [&](std::size_t i, const Vec<D>& u) {
            const Vec<D> n =
                surface_geometry(Interpolant<K, double, D>::jet(patch.data(), patch.stride(), u), 1.0).normal;
            Vec<D> place;
            for (int d = 0; d < D; ++d) {
              place[d] = static_cast<double>(band_->values().node(b, i)[d]) + points_->offset(b, i)[d];
            }
            const double slope = dot(cubic_gradient(p, place), n) / h;
            if (!std::isfinite(slope)) fail_at(place);
            speed.block(b)[i] = -slope;
          },
          [](std::size_t) {});
    });
  }
  /// In spacings. \param place  in spacings from the first node of the lattice
  static Vec<D> cubic_gradient(const Field<double, D>& p, const Vec<D>& place) {
    std::array<std::array<double, 4>, D> weight{}, slope{};
    Index<D> first;
    for (int d = 0; d < D; ++d) {
      first[d] = static_cast<std::ptrdiff_t>(std::floor(place[d])) - 1;
      const double t = place[d] - static_cast<double>(first[d] + 1);
      weight[d] = {-t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2, -(t + 1) * t * (t - 2) / 2,
                   (t + 1) * t * (t - 1) / 6};
      slope[d] = {-(3 * t * t - 6 * t + 2) / 6, (3 * t * t - 4 * t - 1) / 2, -(3 * t * t - 2 * t - 2) / 2,
                  (3 * t * t - 1) / 6};
    }
    Vec<D> gradient;
    for (std::size_t k = 0; k < (D == 2 ? 16 : 64); ++k) {
      Index<D> node = first;
      Vec<D> product = Vec<D>::constant(1.0);
      for (int d = 0; d < D; ++d) {
        const std::size_t j = (k >> (2 * d)) % 4;
        node[d] = p.lattice().wrap(d, node[d] + static_cast<std::ptrdiff_t>(j));
        for (int e = 0; e < D; ++e) product[e] *= e == d ? slope[d][j] : weight[d][j];
      }
      gradient += product * p(node);
    }
    return gradient;
  }
  [[noreturn]] void fail_at(const Vec<D>& place) const {
    throw InterfaceError(message("the pressure cannot be continued across the interface near ",
                                 band_->lattice().box().lo + place * band_->spacing(),
                                 ": the tumour is thinner than a few spacings there; refine the lattice"));
  }

  OpenMP execution_;
  const Band* band_ = nullptr;
  const ClosestPoints<K, double, D>* points_ = nullptr;
  std::optional<Dirichlet<D>> solver_;
  std::vector<Patch<double, D>> patches_;
  Field<double, D> zero_, grown_, dropped_;
  Values part_, slope_;
};

}  // namespace detail

/// p = 0 outside: there is nothing that the tumour has to push away.
struct ZeroOutside {
  using Kind = tumour_kind::Outside;
  static constexpr bool reaches_outside = false;

  template <int D, class K>
  using Method = detail::InsidePressure<D, K>;
};

}  // namespace cambium
