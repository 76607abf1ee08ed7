// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <cambium/kernels/m4_prime.hpp>
#include <cambium/levelset/advection/band_reader.hpp>
#include <cambium/levelset/advection/cell_random.hpp>

namespace cambium {

/// How markers are seeded; lengths in spacings (Enright, Fedkiw, Ferziger & Mitchell 2002, section 3.1).
struct MarkerParams {
  /// Markers in a cell near the interface; 0: 16 in 2D and 64 in 3D.
  int per_cell = 0;
  /// Cells with a corner nearer to the interface than this are seeded.
  double width = 3.0;
  double smallest_radius = 0.1;
  double largest_radius = 0.5;
  /// Two runs with the same seed are the same to the last bit.
  std::uint64_t seed = 1;
};

/// Markers of both sides of an interface: balls that touch it. The radius of a marker is positive outside, negative
/// inside, so that it stands for the side, too.
template <class T, int D>
class Markers {
 public:
  using Band = NarrowBand<T, D>;
  using Reader = detail::BandReader<T, D>;
  /// phi at markers is read by this kernel: of third order, and no higher than a kinked phi bears.
  using Kernel = M4Prime;

  std::size_t size() const { return radius_.size(); }
  Columns<D, T> positions() { return columns<T>(*this); }
  Columns<D, const T> positions() const { return columns<const T>(*this); }
  /// Signed radii, length units.
  std::span<const T> radius() const { return radius_; }
  /// phi at the markers, of the last call of read().
  std::span<const T> phi() const { return phi_; }
  /// True if marker p is on the wrong side by more than its radius.
  bool escaped(std::size_t p) const { return (radius_[p] < T(0) ? -phi_[p] : phi_[p]) < -std::abs(radius_[p]); }

  /// Wraps markers on periodic axes and drops those beyond bounded faces. \return how many were dropped
  std::size_t stay_inside(const Lattice<D>& lattice) {
    std::size_t kept = 0;
    for (std::size_t p = 0; p < size(); ++p) {
      bool inside = true;
      for (int d = 0; d < D; ++d) {
        auto x = static_cast<double>(x_[d][p]);
        if (lattice.periodic(d)) x = lattice.domain().wrap(d, x);
        inside &= x >= lattice.box().lo[d] && x <= lattice.box().hi[d];
        x_[d][kept] = static_cast<T>(x);
      }
      radius_[kept] = radius_[p];
      if (inside) ++kept;
    }
    const std::size_t dropped = size() - kept;
    resize(kept);
    return dropped;
  }
  /// Reads phi at the markers.
  template <Execution E>
  void read(const Band& band, const E& execution) {
    phi_.resize(size());
    reader_.locate(band, std::as_const(*this).positions(), execution);
    reader_.template read<Kernel>(band, std::as_const(*this).positions(), phi_, execution);
  }
  /// Radii := distance to the interface of phi within the limits; the smallest for escaped markers.
  void touch(double spacing, const MarkerParams& params) {
    for (std::size_t p = 0; p < size(); ++p) {
      const T side = std::copysign(T(1), radius_[p]);
      radius_[p] = side * limited(side * phi_[p], spacing, params);
    }
  }
  /// Brings the number of markers of every cell near the interface to what it should be: escaped markers stay; of the
  /// others, those away from the interface go, and of too many in a cell the ones that touch the interface least; where
  /// some lack, new ones come. Needs read(). \param round  tells apart the random numbers of repeated calls
  template <Execution E>
  void reseed(const Band& band, const MarkerParams& params, std::uint64_t round, const E& execution) {
    sown_.resize(band.blocks() + 1);
    patches_.resize(std::max(patches_.size(), static_cast<std::size_t>(execution.count())));
    for_each_piece_by_worker(execution, band.blocks(), 1, [&](std::size_t w, std::size_t b, std::size_t) {
      sown_[b].clear();
      patches_[w].read_block(band, b, halo);
      reseed_block(band, b, params, round, patches_[w]);
    });
    sown_.back().clear();
    for (const std::size_t p : reader_.points(band.blocks())) keep(p, sown_.back(), escaped(p));
    gather();
  }

 private:
  struct Marker {
    Vec<D, T> x;
    T radius;
    T phi;
  };
  /// An attracted marker may go as far as the width of the seeded cells and half of their diagonal.
  static constexpr std::ptrdiff_t halo = 6 + Kernel::support / 2;
  static constexpr int most_attractions = 15;

  template <class U, class M>
  static Columns<D, U> columns(M& markers) {
    std::array<U*, D> first;
    for (int d = 0; d < D; ++d) first[d] = markers.x_[d].data();
    return {first, markers.radius_.size()};
  }
  void resize(std::size_t size) {
    for (auto& column : x_) column.resize(size);
    radius_.resize(size);
  }
  static int wanted(const MarkerParams& params) { return params.per_cell > 0 ? params.per_cell : D == 2 ? 16 : 64; }
  static T limited(T distance, double spacing, const MarkerParams& params) {
    return std::clamp(distance, static_cast<T>(params.smallest_radius * spacing),
                      static_cast<T>(params.largest_radius * spacing));
  }
  void keep(std::size_t p, std::vector<Marker>& to, bool stays) const {
    if (stays) to.push_back({positions()[p], radius_[p], phi_[p]});
  }

  /// Cell by cell: a cell is known by its lowest node.
  void reseed_block(const Band& band, std::size_t b, const MarkerParams& params, std::uint64_t round,
                    const Patch<T, D>& patch) {
    const auto points = reader_.points(b);
    std::vector<std::vector<std::size_t>> of_cell(points.empty() ? 0 : Band::volume);
    for (const std::size_t p : points) {
      of_cell[band.values().offset(Reader::cell(band.lattice(), positions()[p]))].push_back(p);
    }
    const std::vector<std::size_t> none;
    for (std::size_t i = 0; i < Band::volume; ++i) {
      const bool near = is_near(band, b, i, patch, params);
      const int kept = thin_out(of_cell.empty() ? none : of_cell[i], near ? wanted(params) : 0, sown_[b]);
      if (!near || kept >= wanted(params)) continue;
      const auto number = static_cast<std::uint64_t>(band.lattice().number(band.values().node(b, i)));
      detail::CellRandom random(params.seed + round * 0x9e3779b97f4a7c15u, number);
      for (int k = kept; k < wanted(params); ++k) sow(band, patch, i, params, random, sown_[b]);
    }
  }
  /// True if node i is the lowest of a cell with a corner near the interface.
  static bool is_near(const Band& band, std::size_t b, std::size_t i, const Patch<T, D>& patch,
                      const MarkerParams& params) {
    const Index<D> node = band.values().node(b, i);
    const T width = static_cast<T>(params.width * band.spacing());
    bool near = false;
    for (std::size_t corner = 0; corner < (std::size_t{1} << D); ++corner) {
      std::ptrdiff_t at = patch.entry(i);
      for (int d = 0; d < D; ++d) {
        if (!(corner >> d & 1u)) continue;
        if (!band.lattice().periodic(d) && node[d] + 1 >= band.lattice().nodes()[d]) return false;
        at += patch.stride()[d];
      }
      near |= std::abs(patch[at]) < width;
    }
    return near && band.lattice().contains(node);
  }
  /// Keeps the escaped markers of a cell, and as many others as are wanted. \return how many others
  int thin_out(const std::vector<std::size_t>& points, int wanted, std::vector<Marker>& to) const {
    std::vector<std::size_t> others;
    for (const std::size_t p : points) {
      keep(p, to, escaped(p));
      if (!escaped(p)) others.push_back(p);
    }
    const auto gap = [&](std::size_t p) { return std::pair(std::abs(phi_[p]) - std::abs(radius_[p]), p); };
    std::sort(others.begin(), others.end(), [&](std::size_t p, std::size_t q) { return gap(p) < gap(q); });
    others.resize(std::min(others.size(), static_cast<std::size_t>(wanted)));
    for (const std::size_t p : others) keep(p, to, true);
    return static_cast<int>(others.size());
  }
  /// A new marker at a random place of the cell of node i, drawn along the normal to a random distance on its side.
  static void sow(const Band& band, const Patch<T, D>& patch, std::size_t i, const MarkerParams& params,
                  detail::CellRandom& random, std::vector<Marker>& to) {
    Vec<D, T> u = patch.position(patch.entry(i));
    for (int d = 0; d < D; ++d) u[d] += static_cast<T>(random());
    const T h = static_cast<T>(band.spacing());
    const T low = static_cast<T>(params.smallest_radius) * h;
    const T high = static_cast<T>(params.width) * h;
    const T goal = low + static_cast<T>(random()) * (high - low);
    const Jet<T, D> jet = Interpolant<Kernel, T, D>::jet(patch.data(), patch.stride(), u);
    const T slope = norm(jet.gradient);
    if (!(slope > T(0))) return;
    const T side = jet.value < T(0) ? T(-1) : T(1);
    // A goal that leads out of the cells near the interface, over a ridge, say, is approached half as far.
    T way = (side * goal - jet.value) / h;
    for (int attraction = 0; attraction < most_attractions; ++attraction, way *= T(0.5)) {
      const Vec<D, T> at = u + (way / slope) * jet.gradient;
      if (!is_inside(band, patch, at)) continue;
      const T phi = Interpolant<Kernel, T, D>::value(patch.data(), patch.stride(), at);
      if (!(side * phi >= low && side * phi <= high)) continue;
      to.push_back({place(band, patch, at), side * limited(side * phi, band.spacing(), params), phi});
      return;
    }
  }
  /// True if the stencil at a point of the patch is in it, and the point in the box.
  static bool is_inside(const Band& band, const Patch<T, D>& patch, const Vec<D, T>& u) {
    for (int d = 0; d < D; ++d) {
      const auto stencil = static_cast<T>(Kernel::support / 2);
      if (!(u[d] >= stencil && u[d] < static_cast<T>(patch.edge()[d] - 1) - stencil)) return false;
      const T node = u[d] + static_cast<T>(patch.first()[d]);
      if (!band.lattice().periodic(d) && !(node >= T(0) && node <= static_cast<T>(band.lattice().nodes()[d] - 1))) {
        return false;
      }
    }
    return true;
  }
  static Vec<D, T> place(const Band& band, const Patch<T, D>& patch, const Vec<D, T>& u) {
    Vec<D, T> x;
    for (int d = 0; d < D; ++d) {
      const double node = static_cast<double>(u[d]) + static_cast<double>(patch.first()[d]);
      const double at = band.lattice().box().lo[d] + node * band.spacing();
      x[d] = static_cast<T>(band.lattice().periodic(d) ? band.lattice().domain().wrap(d, at) : at);
    }
    return x;
  }
  void gather() {
    std::size_t count = 0;
    for (const auto& markers : sown_) count += markers.size();
    resize(count);
    phi_.resize(count);
    std::size_t p = 0;
    for (const auto& markers : sown_) {
      for (const Marker& marker : markers) {
        positions().set(p, marker.x);
        radius_[p] = marker.radius;
        phi_[p++] = marker.phi;
      }
    }
  }

  std::array<AlignedVector<T>, D> x_;
  AlignedVector<T> radius_;
  AlignedVector<T> phi_;
  Reader reader_;
  std::vector<std::vector<Marker>> sown_;
  std::vector<Patch<T, D>> patches_;
};

}  // namespace cambium
