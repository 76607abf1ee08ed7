// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>

#include <cambium/core/aligned.hpp>
#include <cambium/particles/cell_grid.hpp>
#include <cambium/particles/particles.hpp>

namespace cambium {

/// The order of particles by cell: a stable counting sort, the same for any number of threads.
///
///     CellOrder<3> order;                                                  // outside the time loop: keeps its buffers
///     order.sort(CellGrid<3>::cells_of(lattice), particles.positions());
///     order.reorder(particles);                                            // particles of a cell are neighbours now
///
/// Cells are sorted in two passes so that many cells need no histogram per thread: particles go to at most 1024 buckets
/// of consecutive cells first, each bucket is then sorted by cell on its own. Both passes are counting sorts:
/// O(particles
/// + cells) time, 16 bytes per particle and 4 bytes per cell of memory.
template <int D>
class CellOrder {
 public:
  /// Computes the order; nothing is moved. Particles may lie in any period along periodic axes.
  /// \throws PositionError if a particle is not finite or outside a bounded axis, naming the first; the order computed
  ///         before is kept then
  template <class T, Execution E = OpenMP>
  void sort(const CellGrid<D>& grid, Columns<D, const T> positions, const E& execution = {}) {
    require_countable(positions.size());
    cell_.resize(positions.size());
    for_each(execution, positions.size(), [&](std::size_t p) {
      const Vec<D, T> x = positions[p];
      require_position(grid.domain(), x, p);
      cell_[p] = static_cast<std::uint32_t>(grid.number(x));
    });
    grid_ = grid;
    sort_buckets(execution);
    sort_cells(execution);
  }
  template <class T, Execution E = OpenMP>
  void sort(const CellGrid<D>& grid, Columns<D, T> positions, const E& execution = {}) requires(!std::is_const_v<T>) {
    sort(grid, Columns<D, const T>(positions), execution);
  }

  const CellGrid<D>& grid() const { return grid_; }
  /// Number of particles that were sorted.
  std::size_t size() const { return order_.size(); }
  /// Particle numbers in the order of their cells; within a cell in ascending order.
  std::span<const std::uint32_t> order() const { return order_; }
  /// order()[starts()[c]], ..., order()[starts()[c + 1] - 1] are the particles of cell c; grid().size() + 1 entries.
  std::span<const std::uint32_t> starts() const { return starts_; }

  /// Writes the values in the order of the cells: to[s] = from[order()[s]].
  /// \throws SizeError unless both have size() entries
  template <class V, Execution E = OpenMP>
  void gather(std::span<const V> from, std::span<V> to, const E& execution = {}) const {
    require_size(from.size(), size(), "array to take from");
    require_size(to.size(), size(), "array to write to");
    for_each(execution, size(), [&](std::size_t s) { to[s] = from[order_[s]]; });
  }

  /// Moves positions and all attributes of the particles into the order of the cells. Views of the particles taken
  /// before are no longer valid.
  /// \throws SizeError if these are not as many particles as were sorted
  template <class T, Execution E = OpenMP>
  void reorder(Particles<D, T>& particles, const E& execution = {}) {
    require_size(particles.size(), size(), "particles");
    particles.for_each_array([&](auto& array) {
      using Array = std::remove_reference_t<decltype(array)>;
      using V = typename Array::value_type;
      auto& spare = std::get<Array>(spare_);
      spare.resize(size());
      gather(std::span<const V>(array), std::span<V>(spare), execution);
      array.swap(spare);
    });
  }

 private:
  struct Entry {
    std::uint32_t cell;
    std::uint32_t particle;
  };
  static constexpr std::size_t most_buckets = 1024;
  static constexpr std::size_t most_chunks = 64;

  static void require_countable(std::size_t count) {
    if (count >= std::numeric_limits<std::uint32_t>::max()) {
      throw SizeError(detail::message(count, " particles are more than 32-bit numbers can count: sort them in parts"));
    }
  }

  std::size_t buckets() const { return (grid_.size() >> shift_) + 1; }

  /// Stable sort by bucket. The chunks, and so the result, depend on the number of particles alone.
  template <Execution E>
  void sort_buckets(const E& execution) {
    const std::size_t count = cell_.size();
    for (shift_ = 0; (grid_.size() >> shift_) >= most_buckets;) ++shift_;
    const std::size_t width = buckets();
    const std::size_t chunk = std::max<std::size_t>(4096, (count + most_chunks - 1) / most_chunks);
    const std::size_t chunks = (count + chunk - 1) / chunk;
    histogram_.assign(chunks * width, 0);
    for_each_piece(execution, count, chunk, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* row = histogram_.data() + begin / chunk * width;
      for (std::size_t p = begin; p < end; ++p) ++row[cell_[p] >> shift_];
    });
    bucket_start_.resize(width + 1);
    std::uint32_t sum = 0;
    for (std::size_t b = 0; b < width; ++b) {
      bucket_start_[b] = sum;
      for (std::size_t c = 0; c < chunks; ++c) {
        const std::uint32_t here = histogram_[c * width + b];
        histogram_[c * width + b] = sum;
        sum += here;
      }
    }
    bucket_start_[width] = sum;
    entry_.resize(count);
    for_each_piece(execution, count, chunk, [&](std::size_t begin, std::size_t end) {
      std::uint32_t* row = histogram_.data() + begin / chunk * width;
      for (std::size_t p = begin; p < end; ++p) {
        entry_[row[cell_[p] >> shift_]++] = {cell_[p], static_cast<std::uint32_t>(p)};
      }
    });
  }

  /// Stable sort of each bucket by cell.
  template <Execution E>
  void sort_cells(const E& execution) {
    const std::size_t cells = grid_.size();
    order_.resize(entry_.size());
    starts_.resize(cells + 1);
    for_each_piece(execution, buckets(), 1, [&](std::size_t b, std::size_t) {
      const std::size_t first = b << shift_;
      const std::size_t last = std::min(cells + 1, (b + 1) << shift_);
      std::fill(starts_.begin() + first, starts_.begin() + last, 0u);
      for (std::size_t i = bucket_start_[b]; i < bucket_start_[b + 1]; ++i) ++starts_[entry_[i].cell];
      std::uint32_t sum = bucket_start_[b];
      for (std::size_t c = first; c < last; ++c) sum += std::exchange(starts_[c], sum);
      for (std::size_t i = bucket_start_[b]; i < bucket_start_[b + 1]; ++i) {
        order_[starts_[entry_[i].cell]++] = entry_[i].particle;
      }
      // Every start has moved to the end of its cell, which is the start of the next one.
      for (std::size_t c = last; c-- > first + 1;) starts_[c] = starts_[c - 1];
      starts_[first] = bucket_start_[b];
    });
  }

  CellGrid<D> grid_;
  int shift_ = 0;
  AlignedVector<std::uint32_t> cell_;
  AlignedVector<std::uint32_t> histogram_;
  AlignedVector<std::uint32_t> bucket_start_;
  AlignedVector<Entry> entry_;
  AlignedVector<std::uint32_t> order_;
  AlignedVector<std::uint32_t> starts_;
  std::tuple<AlignedVector<float>, AlignedVector<double>> spare_;
};

}  // namespace cambium
