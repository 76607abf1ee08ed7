// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <cambium/interface/side.hpp>
#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/advection/band_reader.hpp>
#include <cambium/levelset/closest_point_search.hpp>
#include <cambium/particles/validation.hpp>

namespace cambium {

/// Particles in a closed geometry and their images behind its wall: what particles exchange then has no flux through
/// it.
///
///     cambium::Images<2> images(pse.radius());
///     images.update(level_set.band(), domain, particles.positions(), particles[volume]);
///     const auto op = pse.at(domain, images.positions(), images.volumes());
///     images.extend(particles[strength], strength);   // one value for each of positions()
///     op.laplacian(strength, rate);                   // the first rates are those of the particles
///
/// The image of x is 2 y - x, y the closest point of the wall, with the volume and the values of its particle
/// (Sbalzarini, Mezzacasa, Helenius & Koumoutsakos 2005, Biophys. J. 89, 1482). At a flat wall that continues functions
/// of zero flux evenly, and the exchange with the images conserves. At a wall of curvature kappa an image at the
/// distance d stands for (1 + kappa d) / (1 - kappa d) times the volume it has: within the kernel's radius of the wall
/// the Laplacian is off by O(kappa / epsilon) times the gradient along the wall's normal lines, and totals drift.
/// Neumann is the way without these errors; images are kept for comparison and for flat walls.
template <int D, class T = double>
class Images {
 public:
  static_assert(D == 2 || D == 3, "cambium::Images: the dimension must be 2 or 3");
  using Kernel = Lambda<4, 4>;

  /// \param reach  particles within this distance of the wall have images \throws ValueError unless it is positive
  explicit Images(double reach, Side side = Side::inside) : reach_(reach), side_(side) {
    if (!(reach > 0.0) || !std::isfinite(reach)) {
      throw ValueError(detail::message("the reach of images is ", reach, ": it must be a positive length"));
    }
  }

  /// Takes particles, and mirrors those near the wall.
  /// \param band  phi a signed distance at least as far as the reach
  /// \throws SizeError if there is not one volume for each particle; PositionError if a particle is not in the box or
  /// on
  ///         the other side of the wall; BandError if the band ends before the reach. The object is unchanged then
  template <Execution E = OpenMP>
  void update(const NarrowBand<T, D>& band, const Domain<D>& domain, Columns<D, const T> x, std::span<const T> volumes,
              const E& execution = {}) {
    require_size(volumes.size(), x.size(), "the array of particle volumes");
    for (std::size_t p = 0; p < x.size(); ++p) require_position(domain, x[p], p);
    if (reach_ > static_cast<double>(band.half_width())) {
      throw BandError(detail::message("images are to reach ", reach_, " but the band is only ", band.half_width(),
                                      " wide: widen the band or take a smaller kernel"));
    }
    std::vector<T> phi(x.size());
    reader_.locate(band, x, execution);
    reader_.template read<Kernel>(band, x, std::span<T>(phi), execution);
    for (std::size_t p = 0; p < x.size(); ++p) require_side(phi[p], x[p], p);
    std::vector<Vec<D, T>> mirrored(x.size());
    std::vector<std::uint8_t> near(x.size(), 0);
    find_images(band, x, phi, mirrored, near, execution);
    take(x, volumes, mirrored, near);
  }

  /// Particles, then images.
  std::size_t size() const { return origin_.size(); }
  std::size_t images() const { return size() - particles_; }
  Columns<D, const T> positions() const {
    std::array<const T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = position_[d].data();
    return {first, size()};
  }
  std::span<const T> volumes() const { return volume_; }
  /// The particle that entry i is, or is the image of.
  std::size_t origin(std::size_t i) const { return origin_[i]; }
  /// to[i] := values[origin(i)]. \throws SizeError
  template <class V>
  void extend(std::span<const V> values, std::vector<V>& to) const {
    require_size(values.size(), particles_, "the array of particle values");
    to.resize(size());
    for (std::size_t i = 0; i < size(); ++i) to[i] = values[origin_[i]];
  }

 private:
  void require_side(T phi, const Vec<D, T>& x, std::size_t p) const {
    if ((phi < T(0)) == (side_ == Side::inside)) return;
    throw PositionError(detail::message("particle ", p, " at ", x, " is behind the wall, at the distance ",
                                        std::abs(phi), ": reflect particles that step over it"));
  }
  template <Execution E>
  void find_images(const NarrowBand<T, D>& band, Columns<D, const T> x, const std::vector<T>& phi,
                   std::vector<Vec<D, T>>& mirrored, std::vector<std::uint8_t>& near, const E& execution) {
    const Lattice<D>& lattice = band.lattice();
    const T spacing = static_cast<T>(lattice.spacing());
    const auto halo = static_cast<std::ptrdiff_t>(std::ceil(reach_ / lattice.spacing())) + Kernel::support / 2 + 1;
    std::vector<Patch<T, D>> patches(static_cast<std::size_t>(execution.count()));
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      if (reader_.points(b).empty()) return;
      Patch<T, D>& patch = patches[w];
      patch.read_block(band, b, halo);
      for (const std::size_t p : reader_.points(b)) {
        if (!(std::abs(phi[p]) < static_cast<T>(reach_))) continue;
        const Vec<D, T> from = detail::BandReader<T, D>::local(lattice, patch, x[p]);
        const Jet<T, D> jet = Interpolant<Kernel, T, D>::jet(patch.data(), patch.stride(), from);
        Vec<D, T> on = from - jet.value / dot(jet.gradient, jet.gradient) * jet.gradient;
        detail::ClosestPointSearch<Kernel, T, D> search(patch, static_cast<T>(halo));
        if (!search(from, on)) {
          throw BandError(detail::message("no closest point of the wall was found for particle ", p, " at ", x[p],
                                          ": reinitialise the level set, or take a smaller kernel"));
        }
        mirrored[p] = x[p] + T(2) * spacing * (on - from);
        near[p] = 1;
      }
    });
  }
  void take(Columns<D, const T> x, std::span<const T> volumes, const std::vector<Vec<D, T>>& mirrored,
            const std::vector<std::uint8_t>& near) {
    particles_ = x.size();
    origin_.clear();
    for (std::size_t p = 0; p < particles_; ++p) origin_.push_back(p);
    for (std::size_t p = 0; p < particles_; ++p) {
      if (near[p]) origin_.push_back(p);
    }
    volume_.resize(size());
    for (auto& axis : position_) axis.resize(size());
    for (std::size_t i = 0; i < size(); ++i) {
      const std::size_t p = origin_[i];
      volume_[i] = volumes[p];
      for (int d = 0; d < D; ++d) position_[d][i] = i < particles_ ? x[p][d] : mirrored[p][d];
    }
  }

  double reach_;
  Side side_;
  std::size_t particles_ = 0;
  std::array<std::vector<T>, D> position_;
  std::vector<T> volume_;
  std::vector<std::size_t> origin_;
  detail::BandReader<T, D> reader_;
};

}  // namespace cambium
