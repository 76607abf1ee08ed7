// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <cambium/levelset/interface_projection.hpp>

namespace cambium::detail {

/// Climbs on the zero set of kernel K's interpolant from a point of it to a local maximum nearby.
///
/// Steps along the tangents, halved when none leads higher, followed by a projection: a function that is flat at its
/// maximum is found to the square of the last step.
template <class K, class T, int D>
class InterfaceExtremum {
 public:
  explicit InterfaceExtremum(const NarrowBand<T, D>& band) : band_(band) {}

  /// What is to become greatest: `sign` times the position along `axis`, or times the curvature if axis < 0; in
  /// spacings, from the first node of the lattice.
  struct Rank {
    int axis;
    double sign;
  };

  /// \param start  in spacings from the first node of the lattice
  /// \return the greatest rank found
  double operator()(const Vec<D>& start, const Rank& rank) {
    Index<D> first;
    for (int d = 0; d < D; ++d) first[d] = static_cast<std::ptrdiff_t>(std::floor(start[d])) - reach - halo;
    patch_.read(band_, first, Index<D>::constant(2 * (reach + halo) + 2));
    Point best = at(start - corner(), rank);
    const Vec<D> middle = best.y;
    double step = 0.25;
    for (int move = 0; move < most_moves && step > last_step; ++move) {
      Point next = best;
      for (const Vec<D>& way : tangents(best.jet)) {
        for (const double length : {-step, step}) {
          const Vec<D> y = best.y + length * way;
          if (!(norm(y - middle) < static_cast<double>(reach) - 1.0)) continue;
          const Point other = at(y, rank);
          if (other.rank > next.rank) next = other;
        }
      }
      if (!(next.rank > best.rank)) step *= 0.5;
      best = next;
    }
    return best.rank;
  }

 private:
  static constexpr std::ptrdiff_t reach = 3;
  static constexpr std::ptrdiff_t halo = InterfaceProjection<K, T, D>::halo;
  static constexpr double last_step = 1e-4;
  static constexpr int most_moves = 60;  ///< 12 halvings, and 12 spacings of the widest steps

  struct Point {
    Vec<D> y;
    Jet<T, D> jet;
    double rank;
  };

  Vec<D> corner() const {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = static_cast<double>(patch_.first()[d]);
    return x;
  }
  Point at(const Vec<D>& y, const Rank& rank) const {
    Vec<D, T> u;
    for (int d = 0; d < D; ++d) u[d] = static_cast<T>(y[d]);
    Point result;
    result.rank = -std::numeric_limits<double>::infinity();
    const bool found = InterfaceProjection<K, T, D>(patch_, sizeof(T) == 8 ? T(1e-4) : T(1e-3))(u);
    for (int d = 0; d < D; ++d) result.y[d] = static_cast<double>(u[d]);
    result.jet = Interpolant<K, T, D>::jet(patch_.data(), patch_.stride(), u);
    if (!found) return result;
    result.rank = rank.sign * (rank.axis < 0 ? static_cast<double>(curvature(result.jet))
                                             : result.y[rank.axis] + corner()[rank.axis]);
    return result;
  }
  /// Orthonormal directions along the level of a jet.
  static std::array<Vec<D>, D - 1> tangents(const Jet<T, D>& jet) {
    Vec<D> n;
    for (int d = 0; d < D; ++d) n[d] = static_cast<double>(jet.gradient[d] / norm(jet.gradient));
    if constexpr (D == 2) {
      return {Vec<2>{-n[1], n[0]}};
    } else {
      int least = 0;
      for (int d = 1; d < 3; ++d) least = std::abs(n[d]) < std::abs(n[least]) ? d : least;
      Vec<3> a = Vec<3>::unit(least) - n[least] * n;
      a /= norm(a);
      return {a, Vec<3>{n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0]}};
    }
  }

  const NarrowBand<T, D>& band_;
  Patch<T, D> patch_;
};

}  // namespace cambium::detail
