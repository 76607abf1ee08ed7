// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include <cambium/particles/cell_order.hpp>

namespace cambium {

/// Particles within a radius of a point or of each other, found through cells.
///
///     Neighbours<3> near(domain, particles.positions(), 2.0 * h);
///     near.for_each(x, [&](std::size_t q, const Vec<3>& r) { ... });                   // r = x_q - x, nearest image
///     near.for_each_pair([&](std::size_t p, std::size_t q, const Vec<3>& r) { ... });  // r = x_q - x_p
///
/// The object keeps its own copy of the positions, wrapped into the box along periodic axes and in the order of the
/// cells; later motion of the particles is seen after the next build(). Distances are computed in double precision, so
/// that r(p, q) = -r(q, p) to the last bit, and p finds q if and only if q finds p. Queries do not change the object:
/// any number of threads may run them at once.
template <int D, class T = double>
class Neighbours {
 public:
  Neighbours() = default;
  /// As build().
  template <Execution E = OpenMP>
  Neighbours(const Domain<D>& domain, Columns<D, const T> positions, double radius, const E& execution = {}) {
    build(domain, positions, radius, execution);
  }

  /// Takes in new positions, reusing the memory of the last ones.
  /// \param radius  distance up to which particles are neighbours; at most half of each period, so that no particle is
  ///                a neighbour through two images
  /// \throws ValueError if the radius is not positive and finite or larger than half a period; LatticeError if the box
  ///         has no extent; PositionError if a particle is not finite or outside a bounded axis. The neighbours of the
  ///         positions before are kept then.
  template <Execution E = OpenMP>
  void build(const Domain<D>& domain, Columns<D, const T> positions, double radius, const E& execution = {}) {
    require_extent(domain);
    require_radius(domain, radius);
    order_.sort(CellGrid<D>(domain, choose_cells(domain, positions.size(), radius)), positions, execution);
    radius_ = radius;
    set_tolerances(domain);
    for (auto& axis : position_) axis.resize(positions.size());
    slot_.resize(positions.size());
    cambium::for_each(execution, positions.size(), [&](std::size_t s) {
      const std::uint32_t p = order_.order()[s];
      const Vec<D> x = domain.wrap(in_double(positions[p]));
      for (int d = 0; d < D; ++d) position_[d][s] = x[d];
      slot_[p] = static_cast<std::uint32_t>(s);
    });
  }

  const Domain<D>& domain() const { return order_.grid().domain(); }
  double radius() const { return radius_; }
  /// Number of particles.
  std::size_t size() const { return order_.size(); }
  /// Particle numbers in the order of the cells: queries for order()[0], order()[1], ... find their data in cache.
  std::span<const std::uint32_t> order() const { return order_.order(); }
  /// Position of particle p as it was given to build(), wrapped into the box along periodic axes.
  Vec<D> position(std::size_t p) const { return at_slot(slot_[p]); }

  /// Calls f(q, r) for every particle q with |r| <= radius, r = x_q - at along the shortest way; a particle at the
  /// point itself is one of them. The point may lie in any period, or outside of a bounded box. The order is
  /// deterministic. \throws PositionError if `at` is not finite
  template <class F>
  void for_each(const Vec<D>& at, F&& f) const {
    require_finite_point(at);
    search(domain().wrap(at), 0, [&](std::size_t s, const Vec<D>& r) { f(std::size_t{order()[s]}, r); });
  }

  /// Calls f(q, r) for every particle q != p with |r| <= radius, r = x_q - x_p along the shortest way.
  template <class F>
  void for_each_neighbour(std::size_t p, F&& f) const {
    search(position(p), 0, [&](std::size_t s, const Vec<D>& r) {
      const std::size_t q = order()[s];
      if (q != p) f(q, r);
    });
  }

  /// Calls f(p, q, r) once for every unordered pair of particles with |r| <= radius, r = x_q - x_p along the shortest
  /// way; on the calling thread, in an order that depends on the positions alone.
  template <class F>
  void for_each_pair(F&& f) const {
    for (std::size_t s = 0; s < size(); ++s) {
      const std::size_t p = order()[s];
      search(at_slot(s), s + 1, [&](std::size_t t, const Vec<D>& r) { f(p, std::size_t{order()[t]}, r); });
    }
  }

  /// A particle and the way to it.
  struct Found {
    std::size_t particle;
    Vec<D> r;
  };
  /// The particle closest to `at`, however far, and r = x_q - at; the one of the lowest number if several are; none if
  /// there are no particles. Particle `excluded` does not count, so that nearest(position(p), p) is p's neighbour.
  /// \throws PositionError if `at` is not finite
  std::optional<Found> nearest(const Vec<D>& at, std::size_t excluded = no_particle) const {
    require_finite_point(at);
    const Vec<D> x = domain().wrap(at);
    std::optional<Found> best;
    double farthest = slack_;
    for (int d = 0; d < D; ++d) farthest += domain().box.extent()[d] + std::abs(x[d] - domain().box.centre()[d]);
    for (double reach = radius_; size() > 0; reach *= 2.0) {
      double least = reach * reach;
      for_each_run(x, 0, reach, [&](std::size_t begin, std::size_t end, const Vec<D>& shift) {
        for (std::size_t s = begin; s < end; ++s) {
          const std::size_t q = order()[s];
          const Vec<D> r = way(x, s, shift);
          const double square = dot(r, r);
          if (q == excluded || square > least || (square == least && best && q > best->particle)) continue;
          least = square;
          best = Found{q, r};
        }
      });
      if (best || reach > farthest) break;
    }
    return best;
  }
  static constexpr std::size_t no_particle = std::numeric_limits<std::size_t>::max();

 private:
  static void require_finite_point(const Vec<D>& at) {
    for (int d = 0; d < D; ++d) {
      if (std::isfinite(at[d])) continue;
      throw PositionError(detail::message("neighbours of the point ", at, ": component ", d, " is not finite"));
    }
  }

  static Vec<D> in_double(const Vec<D, T>& x) {
    Vec<D> result;
    for (int d = 0; d < D; ++d) result[d] = static_cast<double>(x[d]);
    return result;
  }

  static void require_radius(const Domain<D>& domain, double radius) {
    if (!(radius > 0.0) || !std::isfinite(radius)) {
      throw ValueError(detail::message("neighbour radius is ", radius, ": it must be a positive, finite length"));
    }
    for (int d = 0; d < D; ++d) {
      const double period = domain.box.extent()[d];
      if (domain.periodic[d] && radius > 0.5 * period) {
        throw ValueError(detail::message("neighbour radius ", radius, " is larger than half the period ", period,
                                         " of axis ", d,
                                         ", so that a particle would be met through two images: choose "
                                         "a smaller radius, or a larger box"));
      }
    }
  }

  /// Two cells on a radius, but not more than one for four particles: finer cells hug the sphere more closely, coarser
  /// ones have fewer rows to go through. Measured best for radii of 1.5 to 6 particle distances in 2D and 3D.
  static Index<D> choose_cells(const Domain<D>& domain, std::size_t particles, double radius) {
    constexpr double cells_per_radius = 2.0;
    const double most = std::max(1.0, 0.25 * static_cast<double>(particles));
    Vec<D> cells;
    for (int d = 0; d < D; ++d) {
      cells[d] = std::clamp(std::floor(cells_per_radius / radius * domain.box.extent()[d]), 1.0, most);
    }
    while (product(cells) > most) {
      int widest = 0;
      for (int d = 1; d < D; ++d) widest = cells[d] > cells[widest] ? d : widest;
      cells[widest] = std::max(1.0, std::floor(0.9 * cells[widest]));
    }
    Index<D> result;
    for (int d = 0; d < D; ++d) result[d] = static_cast<std::ptrdiff_t>(cells[d]);
    return result;
  }

  void set_tolerances(const Domain<D>& domain) {
    double scale = radius_;
    for (int d = 0; d < D; ++d) {
      const double period = domain.box.extent()[d];
      scale = std::max({scale, std::abs(domain.box.lo[d]), std::abs(domain.box.hi[d]), period});
      ambiguous_[d] = domain.periodic[d] && radius_ > 0.5 * period * (1.0 - 1e-12);
    }
    slack_ = 64.0 * std::numeric_limits<double>::epsilon() * scale;
  }

  Vec<D> at_slot(std::size_t s) const {
    Vec<D> x;
    for (int d = 0; d < D; ++d) x[d] = position_[d][s];
    return x;
  }

  /// Calls f(s, r) for every slot s >= first whose particle is within the radius of `at`, a point in the box along
  /// periodic axes. Candidates are sifted in blocks without a branch: about one in two is a hit, which no processor
  /// predicts.
  template <class F>
  void search(const Vec<D>& at, std::size_t first, F&& f) const {
    constexpr std::size_t block = 64;
    const double square = radius_ * radius_;
    for_each_run(at, first, radius_, [&](std::size_t begin, std::size_t end, const Vec<D>& shift) {
      for (; begin < end; begin += block) {
        std::array<std::size_t, block> hit;
        std::size_t hits = 0;
        for (std::size_t s = begin; s < std::min(end, begin + block); ++s) {
          const Vec<D> r = way(at, s, shift);
          hit[hits] = s;
          hits += dot(r, r) <= square ? 1 : 0;
        }
        for (std::size_t k = 0; k < hits; ++k) {
          const Vec<D> r = way(at, hit[k], shift);
          if (is_nearest_image(at, hit[k], r)) f(hit[k], r);
        }
      }
    });
  }

  /// Way from `at` to the image of slot s.
  Vec<D> way(const Vec<D>& at, std::size_t s, const Vec<D>& shift) const {
    Vec<D> r;
    for (int d = 0; d < D; ++d) r[d] = position_[d][s] - at[d] + shift[d];
    return r;
  }

  /// Calls f(begin, end, shift) for runs of slots >= first that hold all particles within `reach` of `at`, and others;
  /// `shift` leads to the image that is meant.
  template <class F>
  void for_each_run(const Vec<D>& at, std::size_t first, double reach, F&& f) const {
    if (size() > 0) visit<D - 1>(at, first, 0, Vec<D>{}, (reach + slack_) * (reach + slack_), f);
  }

  /// Goes through the cells along axis A that come within sqrt(left) of `at` along that axis; `row` numbers the cells
  /// chosen along the axes above, `shift` is the way to their image. Along axis 0 the particles of all these cells are
  /// consecutive.
  ///
  /// Cells are taken `slack` wider than they are: round-off of 64 units covers that of wrapping and of cell numbers.
  template <int A, class F>
  void visit(const Vec<D>& at, std::size_t first, std::size_t row, Vec<D> shift, double left, F& f) const {
    const auto& grid = order_.grid();
    const std::ptrdiff_t n = grid.cells()[A];
    const double lo = domain().box.lo[A];
    const double reach = std::sqrt(left) + slack_;
    std::ptrdiff_t begin = cell_within(A, at[A] - reach);
    std::ptrdiff_t end = cell_within(A, at[A] + reach) + 1;
    const double period = domain().box.hi[A] - lo;
    for (std::ptrdiff_t i = begin; i < end;) {
      const std::ptrdiff_t image = i < 0 ? -1 : i < n ? 0 : 1;
      shift[A] = static_cast<double>(image) * period;
      const std::size_t cell = row * static_cast<std::size_t>(n) + static_cast<std::size_t>(i - image * n);
      if constexpr (A == 0) {
        const std::ptrdiff_t next = std::min(end, (image + 1) * n);
        f(std::max<std::size_t>(first, order_.starts()[cell]),
          std::size_t{order_.starts()[cell + static_cast<std::size_t>(next - i)]}, std::as_const(shift));
        i = next;
      } else {
        const double below = lo + static_cast<double>(i) * grid.edge()[A] - at[A];
        const double gap = std::max({below - slack_, -below - grid.edge()[A] - slack_, 0.0});
        if (left > gap * gap) visit<A - 1>(at, first, cell, shift, left - gap * gap, f);
        ++i;
      }
    }
  }

  /// Cell coordinate of x along an axis, held to the cells of the box (bounded) or of it and its two images (periodic).
  std::ptrdiff_t cell_within(int axis, double x) const {
    const auto n = static_cast<double>(order_.grid().cells()[axis]);
    const bool periodic = domain().periodic[axis];
    return static_cast<std::ptrdiff_t>(
        std::clamp(order_.grid().coordinate(axis, x), periodic ? -n : 0.0, periodic ? 2.0 * n - 1.0 : n - 1.0));
  }

  /// With a radius of half a period a particle can be within reach through two images: the one of Domain::difference
  /// counts.
  bool is_nearest_image(const Vec<D>& at, std::size_t s, const Vec<D>& r) const {
    for (int d = 0; d < D; ++d) {
      if (ambiguous_[d] && r[d] != domain().difference(at, at_slot(s))[d]) return false;
    }
    return true;
  }

  CellOrder<D> order_;
  double radius_ = 0.0;
  double slack_ = 0.0;
  std::array<bool, D> ambiguous_{};
  std::array<AlignedVector<double>, D> position_;
  AlignedVector<std::uint32_t> slot_;
};

}  // namespace cambium
