// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/columns.hpp>
#include <cambium/interpolation/axis.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/particles/validation.hpp>
#include <cambium/simd/pack.hpp>

namespace cambium::detail {

/// Cells of a lattice numbered by rows: a row is all cells along axis 0 with the same other coordinates; in one
/// dimension, a run of 1024 cells.
template <class K, class P, int D>
class CellRows {
 public:
  static constexpr double run = 1024.0;

  explicit CellRows(const Lattice<D>& lattice) {
    for (int d = 0; d < D; ++d) {
      axis_[d] = AxisLocator<K, P>(lattice, d);
      cells_[d] = cells_along<K>(lattice, d);
    }
  }
  std::size_t count() const {
    if constexpr (D == 1) return (static_cast<std::size_t>(cells_[0]) + 1023) / 1024;
    std::size_t rows = 1;
    for (int d = 1; d < D; ++d) rows *= static_cast<std::size_t>(cells_[d]);
    return rows;
  }
  /// Row of particles at x (one coordinate or Pack for each axis), exact in floating point.
  template <class V>
  V row(const std::array<V, D>& x) const {
    using std::floor;
    if constexpr (D == 1) return floor(axis_[0].cell(axis_[0].reduce(x[0])) * V(P(1.0 / run)));
    V row(P(0));
    for (int d = D - 1; d > 0; --d) {
      row = row * V(static_cast<P>(cells_[d])) + axis_[d].cell(axis_[d].reduce(x[d]));
    }
    return row;
  }

 private:
  std::array<AxisLocator<K, P>, D> axis_;
  Index<D> cells_;
};

/// Stable order of particles by rows of cells: found to be there already, or made by a counting sort.
class RowOrder {
 public:
  /// Order by the rows of cells of a lattice.
  /// \throws PositionError for the first particle that is not finite or outside a bounded box
  template <class K, int D, class P, Execution E>
  void build(const Lattice<D>& lattice, Columns<D, const P> x, const E& execution) {
    const CellRows<K, P, D> cells(lattice);
    const Domain<D>& domain = lattice.domain();
    resize(x.size(), cells.count());
    for_each_piece(execution, size_, piece_, [&](std::size_t begin, std::size_t end) {
      bool valid = true;
      constexpr std::size_t cached = 1024;  // positions are checked and used while they are in cache
      for (std::size_t p = begin; p < end && valid; p += cached) {
        valid = positions_valid(domain, x, p, std::min(end, p + cached));
        if (valid) number_rows(cells, x, p, std::min(end, p + cached));
      }
      valid_[begin / piece_] = valid;
    });
    if (std::find(valid_.begin(), valid_.end(), 0) != valid_.end()) {
      require_positions(domain, x, execution);
    }
    arrange(execution);
  }

  /// Order by rows [0, rows) of the caller's own: row_of(p) is the row of particle p.
  template <Execution E, class F>
  void build(std::size_t count, std::size_t rows, F&& row_of, const E& execution) {
    resize(count, rows);
    for_each_piece(execution, size_, piece_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) row_of_[p] = static_cast<std::uint32_t>(row_of(p));
    });
    arrange(execution);
  }

  /// True if the particles came in the order of rows.
  bool sorted() const { return sorted_; }
  std::size_t rows() const { return first_.size() - 1; }
  /// First and one-past-last place of the particles of a row in the order of rows.
  std::pair<std::size_t, std::size_t> row(std::size_t r) const { return {first_[r], first_[r + 1]}; }
  /// place()[p] is the place of particle p in the order of rows; valid unless sorted().
  const std::vector<std::uint32_t>& place() const { return place_; }

  /// ordered[place of p] = values[p], in a buffer of the caller.
  template <class T, Execution E>
  void scatter(std::span<const T> values, AlignedVector<T>& ordered, const E& execution) const {
    ordered.resize(size_);
    for_each_piece(execution, size_, piece_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) ordered[place_[p]] = values[p];
    });
  }
  /// values[p] = ordered[place of p].
  template <class T, Execution E>
  void gather(const AlignedVector<T>& ordered, std::span<T> values, const E& execution) const {
    for_each_piece(execution, size_, piece_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) values[p] = ordered[place_[p]];
    });
  }

 private:
  void resize(std::size_t count, std::size_t rows) {
    size_ = count;
    piece_ = std::max<std::size_t>(std::size_t{1} << 15, (size_ + 15) / 16);
    pieces_ = (size_ + piece_ - 1) / piece_;
    row_of_.resize(size_);
    first_.assign(rows + 1, 0);
    valid_.assign(pieces_, 1);
    ascending_.assign(pieces_, 1);
  }
  /// From rows to places: nothing to do for particles that are in order already.
  template <Execution E>
  void arrange(const E& execution) {
    for_each_piece(execution, size_, piece_, [&](std::size_t begin, std::size_t end) {
      unsigned descents = begin > 0 && row_of_[begin - 1] > row_of_[begin];
      for (std::size_t p = begin + 1; p < end; ++p) descents += row_of_[p - 1] > row_of_[p];
      ascending_[begin / piece_] = descents == 0;
    });
    sorted_ = std::find(ascending_.begin(), ascending_.end(), 0) == ascending_.end();
    if (sorted_) {
      find_starts(execution);
    } else {
      sort(execution);
    }
  }

  /// Rows of particles [begin, end).
  template <class K, class P, int D>
  void number_rows(const CellRows<K, P, D>& cells, Columns<D, const P> x, std::size_t begin, std::size_t end) {
    constexpr std::size_t lanes = simd::native_lanes<P>;
    constexpr std::size_t block = 64;
    using V = simd::Pack<P, lanes>;
    alignas(64) P row[block];
    for (std::size_t p = begin; p < end; p += block) {
      const std::size_t count = std::min(block, end - p);
      for (std::size_t i = 0; i < count; i += lanes) {
        std::array<V, D> at;
        for (int d = 0; d < D; ++d) at[d] = load(x.column(d).data() + p + i, std::min(lanes, count - i));
        cells.row(at).store_aligned(row + i);
      }
      for (std::size_t i = 0; i < count; ++i) row_of_[p + i] = static_cast<std::uint32_t>(row[i]);
    }
  }

  /// `count` values, the rest of the lanes filled with the first one.
  template <class P>
  static simd::Pack<P, simd::native_lanes<P>> load(const P* from, std::size_t count) {
    constexpr std::size_t lanes = simd::native_lanes<P>;
    if (count == lanes) return simd::Pack<P, lanes>::load(from);
    P buffer[lanes];
    for (std::size_t l = 0; l < lanes; ++l) buffer[l] = from[l < count ? l : 0];
    return simd::Pack<P, lanes>::load(buffer);
  }

  /// Place of the first particle of each row, the particles being in order.
  template <Execution E>
  void find_starts(const E& execution) {
    for_each_piece(execution, size_, piece_, [&](std::size_t begin, std::size_t end) {
      std::size_t next = begin == 0 ? 0 : row_of_[begin - 1] + std::size_t{1};
      for (std::size_t p = begin; p < end; ++p) {
        if (row_of_[p] + std::size_t{1} == next) continue;
        while (next <= row_of_[p]) first_[next++] = static_cast<std::uint32_t>(p);
      }
    });
    const std::size_t last = size_ == 0 ? 0 : row_of_[size_ - 1] + std::size_t{1};
    std::fill(first_.begin() + static_cast<std::ptrdiff_t>(last), first_.end(), static_cast<std::uint32_t>(size_));
  }

  /// Counting sort: a histogram for each piece, prefix sums over pieces and rows, places.
  template <Execution E>
  void sort(const E& execution) {
    const std::size_t count = rows();
    histogram_.assign(pieces_ * count, 0);
    place_.resize(size_);
    for_each_piece(execution, size_, piece_, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* histogram = histogram_.data() + begin / piece_ * count;
      for (std::size_t p = begin; p < end; ++p) ++histogram[row_of_[p]];
    });
    std::uint32_t total = 0;
    for (std::size_t r = 0; r < count; ++r) {
      first_[r] = total;
      for (std::size_t k = 0; k < pieces_; ++k) total += std::exchange(histogram_[k * count + r], total);
    }
    first_[count] = total;
    for_each_piece(execution, size_, piece_, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* next = histogram_.data() + begin / piece_ * count;
      for (std::size_t p = begin; p < end; ++p) place_[p] = next[row_of_[p]]++;
    });
  }

  std::size_t size_ = 0;
  std::size_t piece_ = 1;
  std::size_t pieces_ = 0;
  bool sorted_ = true;
  std::vector<std::uint32_t> row_of_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> histogram_;
  std::vector<std::uint32_t> place_;
  std::vector<char> ascending_;
  std::vector<char> valid_;
};

}  // namespace cambium::detail
