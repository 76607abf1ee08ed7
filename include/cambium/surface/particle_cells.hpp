// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <cambium/core/error.hpp>
#include <cambium/levelset/band_field.hpp>
#include <cambium/levelset/geometry/centred_differences.hpp>
#include <cambium/levelset/patch.hpp>

namespace cambium::detail {

/// Cells of the lattice in a layer around an interface, and the particles at their corners, see SurfaceParticles.
///
/// With phi the distance, n its gradient, H its second derivatives, S = 1 - phi H on the tangent plane: the integral
/// over the layer of w(phi) det(S) f is that over the interface of f if f is constant along normals and w has integral
/// one; the surface gradient of f at the closest point is S^-1 grad f.
template <int D, class T>
struct ParticleCells {
  using Band = NarrowBand<T, D>;
  using Tensor = std::array<Vec<D, T>, D>;
  static constexpr std::size_t corners = std::size_t{1} << D;

  Lattice<D> lattice;
  std::vector<Index<D>> node;                              ///< of every particle
  std::vector<double> phi;                                 ///< of every particle
  std::vector<Vec<D>> normal;                              ///< of every particle
  AlignedVector<T> volume;                                 ///< of every particle
  std::vector<std::array<std::uint32_t, corners>> corner;  ///< of every cell: particles, bit d is the side on axis d
  std::vector<Tensor> tensor;  ///< of every cell: w det(S) (S^-2 + binding n n) h^(D-2) / 2^D
  double stiffest = 0.0;       ///< bound of |S^-2 + binding n n|

  /// \throws BandError, InterfaceError as SurfaceParticles::fit()
  ParticleCells(const Band& band, double half_width, double binding)
      : lattice(band.lattice()), half_width_(half_width), binding_(binding) {
    const double needed = half_width + 1.5 * std::sqrt(static_cast<double>(D));
    if (static_cast<double>(band.half_width()) < needed * band.spacing()) {
      throw BandError(message("half width of the band is ", static_cast<double>(band.half_width()) / band.spacing(),
                              " spacings, but a layer of surface particles of half width ", half_width, " needs ",
                              needed, ": choose a wider band or a thinner layer"));
    }
    Field<std::int32_t, D, Sparse> number(lattice, -1);
    take_blocks(number, band);
    number.fill(-1);
    Patch<T, D> patch;
    for (std::size_t b = 0; b < band.blocks(); ++b) {
      const Index<D> origin = band.values().block_origin(b);
      patch.read(band, origin - Index<D>::constant(1), Index<D>::constant(Band::extent + 3));
      for (std::size_t i = 0; i < Band::volume; ++i) take(band.values().node(b, i), origin, patch, number);
    }
  }

 private:
  using Differences = CentredDifferences<2>;

  /// Takes the cell above a node if it is in the layer.
  void take(const Index<D>& base, const Index<D>& origin, const Patch<T, D>& patch,
            Field<std::int32_t, D, Sparse>& number) {
    const double reach = (half_width_ + std::sqrt(static_cast<double>(D))) * lattice.spacing();
    if (!lattice.contains(base) || std::abs(static_cast<double>(patch[place(base - origin, patch)])) > reach) return;
    std::array<Jet<T, D>, corners> jets;
    Jet<T, D> middle{};
    for (std::size_t m = 0; m < corners; ++m) {
      jets[m] = Differences::jet({}, patch.data() + place(corner_of(base, m) - origin, patch), patch.stride());
      middle.value += jets[m].value / static_cast<T>(corners);
      middle.gradient += jets[m].gradient / static_cast<T>(corners);
      for (int d = 0; d < D; ++d) middle.hessian[d] += jets[m].hessian[d] / static_cast<T>(corners);
    }
    const T h = static_cast<T>(lattice.spacing());
    const T s = middle.value / (h * static_cast<T>(half_width_));
    if (!(std::abs(s) < T(1))) return;
    const T inside = T(1) - s * s;
    // (1 - s^2)^3 has the integral 32/35 over (-1, 1).
    weigh(base, middle, inside * inside * inside * T(35.0 / 32.0) / (h * static_cast<T>(half_width_)));
    for (std::size_t m = 0; m < corners; ++m) corner.back()[m] = particle(corner_of(base, m), jets[m], number);
    for (const std::uint32_t p : corner.back()) volume[p] += share_;
  }
  static Index<D> corner_of(Index<D> base, std::size_t m) {
    for (int d = 0; d < D; ++d) base[d] += static_cast<std::ptrdiff_t>(m >> d & 1);
    return base;
  }
  static std::ptrdiff_t place(const Index<D>& offset, const Patch<T, D>& patch) {
    std::ptrdiff_t at = 0;
    for (int d = 0; d < D; ++d) at += (offset[d] + 1) * patch.stride()[d];
    return at;
  }
  /// The tensor of the cell and its share of the area for each corner.
  void weigh(const Index<D>& base, const Jet<T, D>& jet, T weight) {
    const T h = static_cast<T>(lattice.spacing());
    const Vec<D, T> n = jet.gradient / norm(jet.gradient);
    Tensor tangent, bent, s;
    for (int d = 0; d < D; ++d) tangent[d] = Vec<D, T>::unit(d) - n[d] * n;
    for (int d = 0; d < D; ++d) {
      for (int e = 0; e < D; ++e) bent[d][e] = bilinear(jet, tangent[d], tangent[e]) / (h * h);
      s[d] = tangent[d] - jet.value * bent[d];
    }
    const T trace = trace_of(s);
    const T det = D == 2 ? trace : T(0.5) * (trace * trace - trace_of(times(s, s)));
    // On the tangent plane S^-1 = (trace - S) / det by Cayley and Hamilton in 3D, 1 / det in 2D.
    Tensor adjugate = tangent;
    if constexpr (D == 3) {
      for (int d = 0; d < D; ++d) adjugate[d] = trace * tangent[d] - s[d];
    }
    const T sharpest = largest(times(bent, adjugate)) / det;  // curvature of the interface
    if (!(trace > T(0) && det > T(0) && sharpest * static_cast<T>(half_width_) * h < T(1))) {
      throw InterfaceError(message("the layer of surface particles folds at node ", base,
                                   ": radii of curvature must be larger than its half width of ", half_width_,
                                   " spacings; refine the lattice or choose a thinner layer"));
    }
    Tensor flux = times(adjugate, adjugate);
    stiffest = std::max({stiffest, binding_, static_cast<double>(trace_of(flux) / (det * det))});
    const T part = weight * static_cast<T>(std::pow(h, D)) / static_cast<T>(corners);
    const T along = static_cast<T>(binding_) * det * det;
    for (int d = 0; d < D; ++d) flux[d] = (flux[d] + along * n[d] * n) * (part / (det * h * h));
    share_ = part * det;
    tensor.push_back(flux);
    corner.emplace_back();
  }
  static T bilinear(const Jet<T, D>& jet, const Vec<D, T>& a, const Vec<D, T>& b) {
    T sum{};
    for (int d = 0; d < D; ++d) sum += a[d] * dot(jet.hessian[d], b);
    return sum;
  }
  static T trace_of(const Tensor& a) {
    T sum{};
    for (int d = 0; d < D; ++d) sum += a[d][d];
    return sum;
  }
  /// Largest modulus of an eigenvalue of a tensor of the tangent plane.
  static T largest(const Tensor& a) {
    const T half = T(0.5) * trace_of(a);
    return std::abs(half) + std::sqrt(std::max(T(0), T(0.5) * trace_of(times(a, a)) - half * half));
  }
  /// Product of symmetric tensors.
  static Tensor times(const Tensor& a, const Tensor& b) {
    Tensor result;
    for (int d = 0; d < D; ++d) {
      for (int e = 0; e < D; ++e) result[d][e] = dot(a[d], b[e]);
    }
    return result;
  }
  std::uint32_t particle(Index<D> at, const Jet<T, D>& jet, Field<std::int32_t, D, Sparse>& number) {
    for (int d = 0; d < D; ++d) at[d] = lattice.wrap(d, at[d]);
    if (!lattice.contains(at)) {
      throw InterfaceError(message("the layer of surface particles reaches beyond the bounded face at node ", at,
                                   ": make the box larger"));
    }
    const std::ptrdiff_t b = number.find(Field<std::int32_t, D, Sparse>::block_of(at));
    std::int32_t& known = number.block(static_cast<std::size_t>(b))[Field<std::int32_t, D, Sparse>::offset(at)];
    if (known < 0) {
      known = static_cast<std::int32_t>(node.size());
      node.push_back(at);
      phi.push_back(static_cast<double>(jet.value));
      const T slope = norm(jet.gradient);
      normal.emplace_back();
      for (int d = 0; d < D; ++d) normal.back()[d] = static_cast<double>(jet.gradient[d] / slope);
      volume.push_back(T(0));
    }
    return static_cast<std::uint32_t>(known);
  }

  double half_width_, binding_;
  T share_{};  ///< of the last cell for each of its corners
};

}  // namespace cambium::detail
