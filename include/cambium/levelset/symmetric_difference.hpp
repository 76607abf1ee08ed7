// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <cambium/kernels/lambda.hpp>
#include <cambium/levelset/cut_cell.hpp>
#include <cambium/levelset/interface_projection.hpp>
#include <cambium/parallel/compensated_sum.hpp>

namespace cambium {

struct SymmetricDifferenceParams {
  /// Pairs of lines side by side in a cell, along each axis; every line is looked at in twice as many pieces.
  int pairs = 2;
};

namespace detail {

/// Mismatch of the inside of a band and of that of a function, block by block.
template <class K, class T, int D, class F>
class BlockMismatch {
 public:
  using Band = NarrowBand<T, D>;
  using Edges = CellEdges<D>;

  BlockMismatch(const Band& band, const F& exact, int pairs) : band_(band), exact_(exact), lines_(2 * pairs) {
    values_.resize(static_cast<std::size_t>(product(Index<D>::constant(Band::extent + 1))));
  }
  /// Volume in spacings in the cells that start in block `block`.
  double operator()(const Index<D>& block) {
    origin_ = block * Band::extent;
    const std::ptrdiff_t b = band_.values().find(block);
    stored_ = b >= 0;
    far_ = band_.far_value(block);
    if (stored_) patch_.read_block(band_, static_cast<std::size_t>(b), halo);
    Index<D> cells;
    for (int d = 0; d < D; ++d) {
      const std::ptrdiff_t count = band_.lattice().nodes()[d] - (band_.lattice().periodic(d) ? 0 : 1);
      cells[d] = std::min<std::ptrdiff_t>(Band::extent, count - origin_[d]);
      if (cells[d] <= 0) return 0.0;
    }
    sample_exact(cells);
    double sum = 0.0;
    for (std::ptrdiff_t i = 0; i < product(cells); ++i) {
      Index<D> cell;
      std::ptrdiff_t rest = i;
      for (int d = 0; d < D; ++d) {
        cell[d] = rest % cells[d];
        rest /= cells[d];
      }
      sum += mismatch(cell);
    }
    return sum;
  }

 private:
  static constexpr std::ptrdiff_t halo = InterfaceProjection<K, T, D>::halo;

  static constexpr double gauss = 0.28867513459481288;  // 1 / sqrt(12)

  struct Corners {
    std::array<double, Edges::corners> value;
    bool negative = false, positive = false;

    void set(int c, double v) {
      value[c] = v;
      (v < 0.0 ? negative : positive) = true;
    }
    bool mixed() const { return negative && positive; }
    /// Axis along which the values differ most.
    int steepest() const {
      int best = 0;
      double most = -1.0;
      for (int d = 0; d < D; ++d) {
        double change = 0.0;
        for (int c = 0; c < Edges::corners; ++c) change += (c >> d & 1) ? value[c] : -value[c];
        if (std::abs(change) > most) best = d;
        most = std::max(most, std::abs(change));
      }
      return best;
    }
  };

  double exact(const Vec<D>& in_block) const {
    Vec<D> x;
    for (int d = 0; d < D; ++d) {
      x[d] = band_.lattice().box().lo[d] + (static_cast<double>(origin_[d]) + in_block[d]) * band_.spacing();
    }
    const auto value = static_cast<double>(exact_(x));
    if (!std::isfinite(value)) throw ValueError(message("the function to compare with is ", value, " at ", x));
    return value;
  }
  double inexact(const Vec<D>& in_block) const {
    if (!stored_) return static_cast<double>(far_);
    Vec<D, T> u;
    for (int d = 0; d < D; ++d) u[d] = static_cast<T>(in_block[d] + halo);
    return static_cast<double>(Interpolant<K, T, D>::value(patch_.data(), patch_.stride(), u));
  }
  void sample_exact(const Index<D>& cells) {
    const Index<D> nodes = cells + Index<D>::constant(1);
    for (std::ptrdiff_t i = 0; i < product(nodes); ++i) {
      Vec<D> at;
      std::ptrdiff_t rest = i;
      std::ptrdiff_t to = 0, pitch = 1;
      for (int d = 0; d < D; ++d, pitch *= Band::extent + 1) {
        at[d] = static_cast<double>(rest % nodes[d]);
        to += rest % nodes[d] * pitch;
        rest /= nodes[d];
      }
      values_[static_cast<std::size_t>(to)] = exact(at);
    }
  }

  double mismatch(const Index<D>& cell) {
    Corners of_band, of_exact;
    for (int c = 0; c < Edges::corners; ++c) {
      std::ptrdiff_t in_patch = 0, in_values = 0, pitch = 1;
      for (int d = 0; d < D; ++d, pitch *= Band::extent + 1) {
        const std::ptrdiff_t at = cell[d] + (c >> d & 1);
        if (stored_) in_patch += (at + halo) * patch_.stride()[d];
        in_values += at * pitch;
      }
      const T value = stored_ ? patch_[in_patch] : far_;
      if (!std::isfinite(value)) {
        throw ValueError(message("the level set is ", value, " next to node ", origin_ + cell, ": it must be finite"));
      }
      of_band.set(c, static_cast<double>(value));
      of_exact.set(c, values_[static_cast<std::size_t>(in_values)]);
    }
    if (of_exact.mixed()) return along_lines(cell, of_exact.steepest());
    if (of_band.mixed()) return along_lines(cell, of_band.steepest());
    return of_band.negative == of_exact.negative ? 0.0 : 1.0;
  }
  /// Gauss's rule of two points, in pairs, over lines along `axis`, on each of which the ends of the insides are found.
  double along_lines(const Index<D>& cell, int axis) const {
    const int count = D == 2 ? lines_ : lines_ * lines_;
    double sum = 0.0;
    for (int line = 0; line < count; ++line) {
      Vec<D> x;
      int rest = line;
      for (int d = 0; d < D; ++d) {
        x[d] = static_cast<double>(cell[d]);
        if (d == axis) continue;
        const int k = rest % lines_;
        const int pair = k / 2;
        x[d] += (pair + 0.5 + (k % 2 == 0 ? -gauss : gauss)) * 2.0 / lines_;
        rest /= lines_;
      }
      sum += along_line(x, axis);
    }
    return sum / count;
  }
  double along_line(const Vec<D>& start, int axis) const {
    const auto band_at = [&](double s) { return inexact(start + Vec<D>::unit(axis, s)); };
    const auto exact_at = [&](double s) { return exact(start + Vec<D>::unit(axis, s)); };
    double sum = 0.0, from = 0.0, a = band_at(0.0), b = exact_at(0.0);
    for (int j = 1; j <= lines_; ++j) {
      const double to = static_cast<double>(j) / lines_;
      const double next_a = band_at(to), next_b = exact_at(to);
      const double p = crossing(band_at, from, to, a, next_a), q = crossing(exact_at, from, to, b, next_b);
      const double apart = std::abs(p - q);
      // Both sides change at p and q; a side that does not change has its crossing at the end of the piece.
      sum += (a < 0.0) == (b < 0.0) ? apart : to - from - apart;
      from = to;
      a = next_a;
      b = next_b;
    }
    return sum;
  }
  /// Where f changes sign, by two steps of false position; `to` if it does not.
  template <class G>
  static double crossing(const G& f, double from, double to, double at_from, double at_to) {
    if ((at_from < 0.0) == (at_to < 0.0)) return to;
    const double middle = from + (to - from) * at_from / (at_from - at_to);
    const double value = f(middle);
    const bool first = (value < 0.0) != (at_from < 0.0);
    if (first) return from + (middle - from) * at_from / (at_from - value);
    return middle + (to - middle) * value / (value - at_to);
  }

  const Band& band_;
  const F& exact_;
  int lines_;
  Index<D> origin_;
  bool stored_ = false;
  T far_{};
  Patch<T, D> patch_;
  std::vector<double> values_;
};

}  // namespace detail

/// Volume (area in 2D) of the points that are inside of one and not of the other of two shapes: that of a band and that
/// where exact(x) < 0. Divided by the area of the interface it is the L1 distance of two interfaces.
///
/// In cells that either interface cuts, the ends of both insides are found on lines along the axis that their normal is
/// closest to: the band's from the interpolant of kernel K, those of `exact` from its values, which may have any smooth
/// scaling. The error is below 1e-3 spacings times the area; parts of an interface between two corners
/// of a cell on the same side are not seen. `exact` is called at every
/// node of the lattice and by several threads; on periodic axes up to the upper face.
/// \throws InterfaceError if the band is empty; ValueError if a value or `exact` is not finite, or params.pairs < 1
template <class K = Lambda<4, 4>, class T, int D, class F, Execution E = OpenMP>
double symmetric_difference(const NarrowBand<T, D>& band, const F& exact, const SymmetricDifferenceParams& params = {},
                            const E& execution = {}) {
  if (band.blocks() == 0) throw InterfaceError("the band is empty: there is no inside to compare with");
  if (params.pairs < 1) {
    throw ValueError(
        detail::message("symmetric difference with ", params.pairs, " pairs of lines: it needs at least 1"));
  }
  const Index<D>& grid = band.values().block_grid();
  std::vector<double> sums(static_cast<std::size_t>(product(grid)));
  std::vector<detail::BlockMismatch<K, T, D, F>> workers(static_cast<std::size_t>(execution.count()),
                                                         {band, exact, params.pairs});
  for_each_piece_by_worker(execution, sums.size(), 1, [&](std::size_t worker, std::size_t k, std::size_t) {
    Index<D> block;
    auto rest = static_cast<std::ptrdiff_t>(k);
    for (int d = 0; d < D; ++d) {
      block[d] = rest % grid[d];
      rest /= grid[d];
    }
    sums[k] = workers[worker](block);
  });
  CompensatedSum total;
  for (const double sum : sums) total += sum;
  return total.value() * std::pow(band.spacing(), D);
}

}  // namespace cambium
