// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <cambium/core/sparse.hpp>
#include <cambium/interpolation/closure.hpp>
#include <cambium/interpolation/row_order.hpp>
#include <cambium/interpolation/sweep.hpp>
#include <cambium/parallel/execution.hpp>

namespace cambium::detail {

/// P2M and M2P between particles and a sparse mesh: every block of cells that holds particles is swept as a tile of
/// its own, padded by the kernel's support.
///
/// P2M activates the blocks under the particles' stencils in an order that depends on the set of particles alone. Each
/// block then adds the tiles that reach it in that order: the same bits for any number of threads.
template <class K, class T, class P, int D, int C>
class SparseEngine {
 public:
  using Shape = BlockShape<D>;
  static constexpr std::ptrdiff_t extent = Shape::extent;
  static constexpr std::ptrdiff_t padded = extent + K::support - 1;
  static constexpr std::size_t rows_per_block = Shape::volume / extent;

  explicit SparseEngine(const Lattice<D>& lattice) : lattice_(lattice), grid_(Shape::count(lattice)) {
    for (int d = 0; d < D; ++d) axis_[d] = AxisLocator<K, P>(lattice, d);
    slot_.assign(static_cast<std::size_t>(product(grid_)), -1);
  }

  const Lattice<D>& lattice() const { return lattice_; }

  /// Finds the blocks of cells that hold particles and orders the particles by their rows.
  /// \throws PositionError for the first particle that is not finite or outside a bounded box
  template <Execution E>
  void order(Columns<D, const P> x, RowOrder& order, const E& execution) {
    require_positions(lattice_.domain(), x, execution);
    for (const auto& tile : tiles_) slot_[entry(tile)] = -1;
    tiles_.clear();
    block_of_.resize(x.size());
    row_in_block_.resize(x.size());
    for_each(execution, x.size(), [&](std::size_t p) { locate(x, p); });
    for (const std::uint32_t block : block_of_) {
      if (slot_[block] >= 0) continue;
      slot_[block] = 0;
      tiles_.push_back(block_at(block));
    }
    std::sort(tiles_.begin(), tiles_.end(), [&](const auto& a, const auto& b) { return entry(a) < entry(b); });
    for (std::size_t k = 0; k < tiles_.size(); ++k) slot_[entry(tiles_[k])] = static_cast<std::int32_t>(k);
    order.build(
        x.size(), tiles_.size() * rows_per_block,
        [&](std::size_t p) {
          return static_cast<std::size_t>(slot_[block_of_[p]]) * rows_per_block + row_in_block_[p];
        },
        execution);
  }

  template <class V, Execution E>
  void p2m(const std::array<const P*, D>& x, const std::array<const T*, C>& strength, const RowOrder& order,
           Field<V, D, Sparse>& mesh, const E& execution) {
    prepare(execution);
    nodes_.resize(tiles_.size() * tile_size);
    for_each_piece_by_worker(execution, tiles_.size(), 1, [&](std::size_t w, std::size_t k, std::size_t) {
      spread_tile(*workers_[w], k, x, strength, order);
    });
    list_targets(mesh);
    for_each_piece(execution, mesh.blocks(), 1, [&](std::size_t b, std::size_t) {
      T* block = &component(mesh.block(b)[0], 0);
      std::fill_n(block, Shape::volume * C, T(0));
      for (std::uint32_t i = first_source_[b]; i < first_source_[b + 1]; ++i) add_tile(sources_[i], mesh, b, block);
    });
  }

  template <class V, Execution E>
  void m2p(const std::array<const P*, D>& x, const std::array<T*, C>& value, const RowOrder& order,
           const Field<V, D, Sparse>& mesh, const E& execution) {
    prepare(execution);
    nodes_.resize(tiles_.size() * tile_size);
    for_each_piece_by_worker(execution, tiles_.size(), 1, [&](std::size_t w, std::size_t k, std::size_t) {
      read_tile(k, mesh);
      collect_tile(*workers_[w], k, x, value, order);
    });
  }

 private:
  static constexpr std::size_t power(std::size_t base, int exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
  }
  static constexpr std::size_t tile_size = power(static_cast<std::size_t>(padded), D) * C;

  /// Padded node of a tile along one axis, and a node of the lattice that it stands for.
  struct Link {
    std::ptrdiff_t padded;
    std::ptrdiff_t node;
    T weight;
  };
  /// Links of a tile along one axis, sorted by block of the node they lead to.
  struct AxisLinks {
    std::array<Link, static_cast<std::size_t>(padded + K::support * (K::moments + 1))> link;
    std::size_t count = 0;
  };
  struct Worker {
    explicit Worker(const Lattice<D>& lattice) : sweep(lattice) {}
    Sweep<K, T, P, (D == 1 ? 2 : D), C> sweep;
  };
  struct LineWorker {
    explicit LineWorker(const Lattice<D>&) { taps.rotate(0); }
    RotatedTaps<K, T> taps;
    alignas(64) std::array<T, static_cast<std::size_t>(padded) + tap_lanes<K>> line{};
  };
  using AnyWorker = std::conditional_t<D == 1, LineWorker, Worker>;

  template <Execution E>
  void prepare(const E& execution) {
    const auto count = static_cast<std::size_t>(execution.count());
    while (workers_.size() < count) workers_.push_back(std::make_unique<AnyWorker>(lattice_));
  }
  std::size_t entry(const Index<D>& block) const {
    std::ptrdiff_t n = block[D - 1];
    for (int d = D - 2; d >= 0; --d) n = n * grid_[d] + block[d];
    return static_cast<std::size_t>(n);
  }
  Index<D> block_at(std::size_t number) const {
    Index<D> block;
    auto rest = static_cast<std::ptrdiff_t>(number);
    for (int d = 0; d < D; ++d) {
      block[d] = rest % grid_[d];
      rest /= grid_[d];
    }
    return block;
  }
  void locate(Columns<D, const P> x, std::size_t p) {
    Index<D> block;
    std::ptrdiff_t row = 0;
    for (int d = D - 1; d >= 0; --d) {
      const std::ptrdiff_t cell = axis_[d](x.column(d)[p]).cell;
      block[d] = cell / extent;
      if (d > 0) row = row * extent + cell % extent;
    }
    block_of_[p] = static_cast<std::uint32_t>(entry(block));
    row_in_block_[p] = static_cast<std::uint32_t>(row);
  }
  /// Cells of a tile; on the upper side the lattice may end before the block does.
  CellBox<D> cells_of(std::size_t k) const {
    CellBox<D> box;
    for (int d = 0; d < D; ++d) {
      box.first[d] = tiles_[k][d] * extent;
      box.count[d] = std::min<std::ptrdiff_t>(extent, cells_along<K>(lattice_, d) - box.first[d]);
    }
    return box;
  }
  auto rows_of(std::size_t k, const RowOrder& order) const {
    return [k, &order](const Index<D>& cell) {
      std::size_t row = 0;
      for (int d = D - 1; d > 0; --d) row = row * extent + static_cast<std::size_t>(cell[d] % extent);
      return order.row(k * rows_per_block + row);
    };
  }
  /// Entry of a tile: plane p along the last axis, row r along the middle one, component c, column 0.
  T* tile_row(std::size_t k, std::size_t p, std::size_t r, int c) {
    const std::size_t row = D == 3 ? p * padded + r : p;
    return nodes_.data() + k * tile_size + (row * C + static_cast<std::size_t>(c)) * padded;
  }

  void spread_tile(Worker& worker, std::size_t k, const std::array<const P*, D>& x,
                   const std::array<const T*, C>& strength, const RowOrder& order) requires(D > 1) {
    struct Sink {
      SparseEngine& engine;
      std::size_t k;
      std::size_t columns;
      void begin(std::size_t) {}
      void row(std::size_t p, std::size_t r, int c, const T* line) {
        T* out = engine.tile_row(k, p, r, c);
        std::copy_n(line, columns, out);
      }
      void end(std::size_t) {}
    };
    const CellBox<D> box = cells_of(k);
    worker.sweep.spread(box, x, strength, rows_of(k, order),
                        Sink{*this, k, static_cast<std::size_t>(box.count[0]) + K::support - 1});
  }
  void spread_tile(LineWorker& worker, std::size_t k, const std::array<const P*, D>& x,
                   const std::array<const T*, C>& strength, const RowOrder& order) requires(D == 1) {
    const auto [begin, end] = order.row(k);
    for (int c = 0; c < C; ++c) {
      worker.line.fill(T(0));
      for (std::size_t p = begin; p < end; ++p) {
        const auto [cell, g] = axis_[0](x[0][p]);
        T* node = worker.line.data() + (cell - tiles_[k][0] * extent);
        fma(worker.taps(static_cast<T>(g)), Lanes(strength[c][p]), Lanes::load(node)).store(node);
      }
      std::copy_n(worker.line.data(), padded, tile_row(k, 0, 0, c));
    }
  }
  void collect_tile(Worker& worker, std::size_t k, const std::array<const P*, D>& x, const std::array<T*, C>& value,
                    const RowOrder& order) requires(D > 1) {
    const CellBox<D> box = cells_of(k);
    const auto columns = static_cast<std::size_t>(box.count[0]) + K::support - 1;
    worker.sweep.collect(box, x, value, rows_of(k, order), [&](std::size_t p, std::size_t r, int c, T* line) {
      const T* in = tile_row(k, p, r, c);
      std::copy_n(in, columns, line);
    });
  }
  void collect_tile(LineWorker& worker, std::size_t k, const std::array<const P*, D>& x, const std::array<T*, C>& value,
                    const RowOrder& order) requires(D == 1) {
    const auto [begin, end] = order.row(k);
    for (int c = 0; c < C; ++c) {
      worker.line.fill(T(0));
      std::copy_n(tile_row(k, 0, 0, c), padded, worker.line.data());
      for (std::size_t p = begin; p < end; ++p) {
        const auto [cell, g] = axis_[0](x[0][p]);
        value[c][p] =
            sum(worker.taps(static_cast<T>(g)) * Lanes::load(worker.line.data() + (cell - tiles_[k][0] * extent)));
      }
    }
  }

  /// Links of tile k along an axis, only those to nodes in block `target` unless it is negative.
  AxisLinks links(std::size_t k, int axis, std::ptrdiff_t target) const {
    AxisLinks result;
    const Closure<K> close(lattice_, axis);
    const CellBox<D> box = cells_of(k);
    for (std::ptrdiff_t i = 0; i < box.count[axis] + K::support - 1; ++i) {
      close(box.first[axis] + i - Taps<K>::before, [&](std::ptrdiff_t node, double w) {
        if (target >= 0 && node / extent != target) return;
        result.link[result.count++] = {i, node, static_cast<T>(w)};
      });
    }
    return result;
  }

  /// Activates the blocks that tiles reach and lists, for each, the tiles that reach it.
  template <class V>
  void list_targets(Field<V, D, Sparse>& mesh) {
    mesh.clear();
    reached_.clear();
    for (std::size_t k = 0; k < tiles_.size(); ++k) {
      std::array<std::vector<std::ptrdiff_t>, 3> blocks{{{}, {0}, {0}}};
      for (int d = 0; d < D; ++d) blocks[d] = reached_blocks(k, d);
      for (const std::ptrdiff_t z : blocks[2]) {
        for (const std::ptrdiff_t y : blocks[1]) {
          for (const std::ptrdiff_t x : blocks[0]) {
            const std::array<std::ptrdiff_t, 3> all{x, y, z};
            Index<D> block;
            for (int d = 0; d < D; ++d) block[d] = all[d];
            reached_.push_back({static_cast<std::uint32_t>(mesh.activate(block)), static_cast<std::uint32_t>(k)});
          }
        }
      }
    }
    first_source_.assign(mesh.blocks() + 1, 0);
    for (const auto& [block, tile] : reached_) ++first_source_[block + 1];
    for (std::size_t b = 0; b < mesh.blocks(); ++b) first_source_[b + 1] += first_source_[b];
    sources_.resize(reached_.size());
    std::vector<std::uint32_t>& next = next_;
    next.assign(first_source_.begin(), first_source_.end());
    for (const auto& [block, tile] : reached_) sources_[next[block]++] = tile;
  }
  std::vector<std::ptrdiff_t> reached_blocks(std::size_t k, int axis) const {
    const AxisLinks all = links(k, axis, -1);
    std::vector<std::ptrdiff_t> blocks;
    for (std::size_t i = 0; i < all.count; ++i) {
      const std::ptrdiff_t block = all.link[i].node / extent;
      if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.push_back(block);
    }
    return blocks;
  }
  /// Links along all axes; along the axes that a lower dimension lacks, the one link 0 -> 0.
  std::array<AxisLinks, 3> all_links(std::size_t k, const Index<D>* target) const {
    std::array<AxisLinks, 3> all;
    for (int d = 0; d < 3; ++d) {
      if (d < D) {
        all[d] = links(k, d, target ? (*target)[d] : -1);
      } else {
        all[d].link[0] = {0, 0, T(1)};
        all[d].count = 1;
      }
    }
    return all;
  }
  template <class V>
  void add_tile(std::size_t k, const Field<V, D, Sparse>& mesh, std::size_t b, T* block) {
    const std::array<AxisLinks, 3> all = all_links(k, &mesh.block_index(b));
    for_each_row_pair(all, [&](std::size_t p, std::size_t r, const Index<3>& node, T weight) {
      std::ptrdiff_t first = 0;
      for (int d = D - 1; d > 0; --d) first = first * extent + node[d] % extent;
      for (int c = 0; c < C; ++c) {
        const T* from = tile_row(k, p, r, c);
        T* out = block + first * extent * C + c;
        for (std::size_t i = 0; i < all[0].count; ++i) {
          const Link& link = all[0].link[i];
          out[link.node % extent * C] += weight * link.weight * from[link.padded];
        }
      }
    });
  }
  template <class V>
  void read_tile(std::size_t k, const Field<V, D, Sparse>& mesh) {
    const std::array<AxisLinks, 3> all = all_links(k, nullptr);
    std::fill_n(nodes_.data() + k * tile_size, tile_size, T(0));
    for_each_row_pair(all, [&](std::size_t p, std::size_t r, const Index<3>& row, T weight) {
      for (std::size_t i = 0; i < all[0].count; ++i) {
        const Link& link = all[0].link[i];
        Index<D> node;
        for (int d = 0; d < D; ++d) node[d] = d == 0 ? link.node : row[d];
        const V& value = mesh(node);
        for (int c = 0; c < C; ++c) {
          tile_row(k, p, r, c)[link.padded] += weight * link.weight * component(value, c);
        }
      }
    });
  }
  /// Calls f(plane, row, node, weight) for the links along all axes but the first.
  template <class F>
  static void for_each_row_pair(const std::array<AxisLinks, 3>& all, F&& f) {
    for (std::size_t l = 0; l < all[2].count; ++l) {
      for (std::size_t m = 0; m < all[1].count; ++m) {
        const Link& middle = all[1].link[m];
        const Link& last = all[2].link[l];
        const auto plane = static_cast<std::size_t>(D == 3 ? last.padded : middle.padded);
        const auto row = static_cast<std::size_t>(D == 3 ? middle.padded : 0);
        f(plane, row, Index<3>{0, middle.node, last.node}, middle.weight * last.weight);
      }
    }
  }

  using Lanes = simd::Pack<T, tap_lanes<K>>;

  Lattice<D> lattice_;
  Index<D> grid_;
  std::array<AxisLocator<K, P>, D> axis_;
  std::vector<std::int32_t> slot_;
  std::vector<Index<D>> tiles_;
  std::vector<std::uint32_t> block_of_;
  std::vector<std::uint32_t> row_in_block_;
  AlignedVector<T> nodes_;
  std::vector<std::unique_ptr<AnyWorker>> workers_;
  struct Reached {
    std::uint32_t block;
    std::uint32_t tile;
  };
  std::vector<Reached> reached_;
  std::vector<std::uint32_t> first_source_;
  std::vector<std::uint32_t> sources_;
  std::vector<std::uint32_t> next_;
};

}  // namespace cambium::detail
