// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/parallel/compensated_sum.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/surface/particle_cells.hpp>

namespace cambium {

/// Species on an interface as strengths of particles in a layer around it, which neighbours exchange in equal and
/// opposite parts: what diffusion conserves to round-off is the sum of the strengths (flux form of Bergdorf, Milde &
/// Koumoutsakos, eq. 11.44, 11.45, 11.54).
///
/// Particles sit on the nodes of the lattice up to Params::half_width from the interface. Each has a volume v_p, its
/// share of the area of the interface, and per species a strength C_p = v_p c_p, c_p the concentration at its closest
/// point. Volumes fall smoothly to zero at the edge of the layer, which needs no condition and no extension there: the
/// exchange is the gradient of the surface's Dirichlet energy as an integral over the layer, so that it is symmetric,
/// never negative, and keeps functions constant along normals. Its error falls with order 1.6 to 1.8 down to a floor
/// that the width of the layer in spacings sets (1e-3 of the amplitude for 3, 1e-4 for 6). exchange() allocates
/// nothing.
template <int D = 3, class T = double>
class SurfaceExchange {
 public:
  static constexpr int dimension = D;
  using Scalar = T;

  struct Params {
    double half_width = 3.0;  ///< of the layer, in spacings
    double binding = 1.0;     ///< diffusivity along normals, over that along the interface
  };

  SurfaceExchange() = default;
  /// \throws ValueError unless the half width is at least 2 spacings and the binding not negative
  explicit SurfaceExchange(const Params& params) : params_(params) {
    if (!(params.half_width >= 2.0) || !std::isfinite(params.half_width)) {
      throw ValueError(detail::message("layer of surface particles of half width ", params.half_width,
                                       " spacings: it must be finite and at least 2; 3 is the usual choice"));
    }
    if (!(params.binding >= 0.0) || !std::isfinite(params.binding)) {
      throw ValueError(detail::message("surface particles with a diffusivity along normals of ", params.binding,
                                       " times that along the interface: it must be finite and not negative"));
    }
  }
  /// For the interface of a level set, see fit().
  template <class LevelSet>
  explicit SurfaceExchange(const LevelSet& level_set, const Params& params = {}) : SurfaceExchange(params) {
    fit(level_set);
  }

  /// Takes the interface of a level set, whose phi is a distance: to be called when it has moved. All particles are new
  /// then. \throws BandError if the band is thinner than the layer and its stencils; InterfaceError where the layer
  /// reaches a bounded face or folds, radii of curvature being of its width or less; the particles are then unchanged
  template <class LevelSet>
  void fit(const LevelSet& level_set) {
    detail::ParticleCells<D, T> cells(level_set.band(), params_.half_width, params_.binding);
    std::vector<std::size_t> first(cells.node.size() + 1, 0);
    for (const auto& corner : cells.corner) {
      for (const std::uint32_t p : corner) ++first[p + 1];
    }
    for (std::size_t p = 0; p < cells.node.size(); ++p) first[p + 1] += first[p];
    std::vector<std::size_t> next(first.begin(), first.end() - 1), of_particle(first.back());
    for (std::size_t e = 0; e < of_particle.size(); ++e) {
      of_particle[next[cells.corner[e / corners][e % corners]]++] = e;
    }
    AlignedVector<T> given(first.back());
    cells_.emplace(std::move(cells));
    first_.swap(first);
    of_particle_.swap(of_particle);
    given_.swap(given);
  }

  std::size_t size() const { return cells_ ? cells_->volume.size() : 0; }
  const Lattice<D>& lattice() const { return cells_->lattice; }
  const Index<D>& node(std::size_t p) const { return cells_->node[p]; }
  Vec<D> position(std::size_t p) const { return lattice().position(node(p)); }
  /// Signed distance of particle p from the interface, and its closest point.
  double phi(std::size_t p) const { return cells_->phi[p]; }
  Vec<D> point(std::size_t p) const { return lattice().domain().wrap(position(p) - phi(p) * cells_->normal[p]); }
  /// Shares v_p of the area of the interface.
  std::span<const T> volumes() const { return cells_->volume; }

  /// strengths[p] := v_p f(closest point of p).
  template <class F, Execution E = OpenMP>
  void sample(F&& f, std::span<T> strengths, const E& execution = {}) const {
    require_size(strengths.size(), size(), "the strengths to sample");
    for_each(execution, size(), [&](std::size_t p) { strengths[p] = cells_->volume[p] * static_cast<T>(f(point(p))); });
  }
  /// c[p] := strengths[p] / v_p.
  template <Execution E = OpenMP>
  void concentrations(std::span<const T> strengths, std::span<T> c, const E& execution = {}) const {
    require_size(strengths.size(), size(), "the strengths");
    require_size(c.size(), size(), "the array of concentrations");
    for_each(execution, size(), [&](std::size_t p) { c[p] = strengths[p] / cells_->volume[p]; });
  }
  /// Amount on the interface: the sum of the strengths.
  template <Execution E = OpenMP>
  double total(std::span<const T> strengths, const E& execution = {}) const {
    require_size(strengths.size(), size(), "the strengths");
    return reduce(
               execution, size(), CompensatedSum{}, [&](std::size_t p) { return static_cast<double>(strengths[p]); },
               std::plus<>{})
        .value();
  }

  /// rate := d strengths / dt of surface diffusion with diffusivity 1. \throws SizeError
  template <Execution E = OpenMP>
  void exchange(std::span<const T> strengths, std::span<T> rate, const E& execution = {}) {
    require_size(strengths.size(), size(), "the strengths");
    require_size(rate.size(), size(), "the rate of the strengths");
    for_each(execution, cells_->corner.size(), [&](std::size_t k) { exchange_in_cell(strengths, k); });
    for_each(execution, size(), [&](std::size_t p) {
      T sum{};
      for (std::size_t i = first_[p]; i < first_[p + 1]; ++i) sum += given_[of_particle_[i]];
      rate[p] = sum;
    });
  }
  /// Bound of the eigenvalues' moduli of exchange(), for explicit steppers: 4 D / h^2 times the largest stretching of
  /// levels to the interface, as a cell's energy has every one of its edges twice.
  double spectral_radius() const { return cells_->stiffest * 4.0 * D / (lattice().spacing() * lattice().spacing()); }

 private:
  static constexpr std::size_t corners = std::size_t{1} << D;

  /// Every corner of the cell has a gradient along the cell's edges; its flux takes from one end what it gives to the
  /// other.
  void exchange_in_cell(std::span<const T> strengths, std::size_t k) {
    std::array<T, corners> c, sum{};
    for (std::size_t m = 0; m < corners; ++m) {
      const std::uint32_t p = cells_->corner[k][m];
      c[m] = strengths[p] / cells_->volume[p];
    }
    const auto& tensor = cells_->tensor[k];
    for (std::size_t m = 0; m < corners; ++m) {
      Vec<D, T> gradient;
      for (int d = 0; d < D; ++d) {
        const std::size_t bit = std::size_t{1} << d;
        gradient[d] = c[m | bit] - c[m & ~bit];
      }
      for (int d = 0; d < D; ++d) {
        const std::size_t bit = std::size_t{1} << d;
        const T flux = dot(tensor[d], gradient);
        sum[m | bit] -= flux;
        sum[m & ~bit] += flux;
      }
    }
    for (std::size_t m = 0; m < corners; ++m) given_[k * corners + m] = sum[m];
  }

  Params params_;
  std::optional<detail::ParticleCells<D, T>> cells_;
  AlignedVector<T> given_;                        ///< what every cell gives to its corners
  std::vector<std::size_t> first_, of_particle_;  ///< entries of given_ for every particle
};

}  // namespace cambium
