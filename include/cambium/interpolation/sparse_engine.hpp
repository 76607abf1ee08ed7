// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include <cambium/core/sparse.hpp>
#include <cambium/interpolation/row_order.hpp>
#include <cambium/interpolation/sparse_tiles.hpp>
#include <cambium/interpolation/sweep.hpp>
#include <cambium/interpolation/tile_links.hpp>
#include <cambium/interpolation/tile_targets.hpp>
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

  explicit SparseEngine(const Lattice<D>& lattice) : tiles_(lattice) {}

  const Lattice<D>& lattice() const { return tiles_.lattice(); }

  /// See SparseTiles::order.
  template <Execution E>
  void order(Columns<D, const P> x, RowOrder& order, const E& execution) {
    tiles_.order(x, order, execution);
  }

  template <class V, Execution E>
  void p2m(const std::array<const P*, D>& x, const std::array<const T*, C>& strength, const RowOrder& order,
           Field<V, D, Sparse>& mesh, const E& execution) {
    prepare(execution);
    nodes_.resize(tiles_.size() * tile_size);
    for_each_piece_by_worker(execution, tiles_.size(), 1, [&](std::size_t w, std::size_t k, std::size_t) {
      spread_tile(*workers_[w], k, x, strength, order);
    });
    targets_.list(tiles_, std::type_identity<T>{}, mesh);
    for_each_piece(execution, mesh.blocks(), 1, [&](std::size_t b, std::size_t) {
      T* block = &component(mesh.block(b)[0], 0);
      std::fill_n(block, Shape::volume * C, T(0));
      for (const std::uint32_t tile : targets_.sources(b)) add_tile(tile, mesh, b, block);
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
  using Links = TileLinks<K, T, D>;
  static constexpr std::size_t tile_size = static_cast<std::size_t>(product(Index<D>::constant(padded))) * C;

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
    while (workers_.size() < count) workers_.push_back(std::make_unique<AnyWorker>(lattice()));
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
    const CellBox<D> box = tiles_.cells_of(k);
    worker.sweep.spread(box, x, strength, tiles_.rows_of(k, order),
                        Sink{*this, k, static_cast<std::size_t>(box.count[0]) + K::support - 1});
  }
  void spread_tile(LineWorker& worker, std::size_t k, const std::array<const P*, D>& x,
                   const std::array<const T*, C>& strength, const RowOrder& order) requires(D == 1) {
    const auto [begin, end] = order.row(k);
    for (int c = 0; c < C; ++c) {
      worker.line.fill(T(0));
      for (std::size_t p = begin; p < end; ++p) {
        const auto [cell, g] = tiles_.axis(0)(x[0][p]);
        T* node = worker.line.data() + (cell - tiles_[k][0] * extent);
        fma(worker.taps(static_cast<T>(g)), Lanes(strength[c][p]), Lanes::load(node)).store(node);
      }
      std::copy_n(worker.line.data(), padded, tile_row(k, 0, 0, c));
    }
  }
  void collect_tile(Worker& worker, std::size_t k, const std::array<const P*, D>& x, const std::array<T*, C>& value,
                    const RowOrder& order) requires(D > 1) {
    const CellBox<D> box = tiles_.cells_of(k);
    const auto columns = static_cast<std::size_t>(box.count[0]) + K::support - 1;
    worker.sweep.collect(box, x, value, tiles_.rows_of(k, order), [&](std::size_t p, std::size_t r, int c, T* line) {
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
        const auto [cell, g] = tiles_.axis(0)(x[0][p]);
        value[c][p] =
            sum(worker.taps(static_cast<T>(g)) * Lanes::load(worker.line.data() + (cell - tiles_[k][0] * extent)));
      }
    }
  }

  template <class V>
  void add_tile(std::size_t k, const Field<V, D, Sparse>& mesh, std::size_t b, T* block) {
    const Links links(lattice(), tiles_.cells_of(k), &mesh.block_index(b));
    const auto& first_axis = links.axis(0);
    links.for_each_row([&](std::size_t p, std::size_t r, const Index<3>& node, T weight) {
      std::ptrdiff_t first = 0;
      for (int d = D - 1; d > 0; --d) first = first * extent + node[d] % extent;
      for (int c = 0; c < C; ++c) {
        const T* from = tile_row(k, p, r, c);
        T* out = block + first * extent * C + c;
        for (std::size_t i = 0; i < first_axis.count; ++i) {
          const auto& link = first_axis.link[i];
          out[link.node % extent * C] += weight * link.weight * from[link.padded];
        }
      }
    });
  }
  template <class V>
  void read_tile(std::size_t k, const Field<V, D, Sparse>& mesh) {
    const Links links(lattice(), tiles_.cells_of(k));
    std::fill_n(nodes_.data() + k * tile_size, tile_size, T(0));
    const auto& first_axis = links.axis(0);
    links.for_each_row([&](std::size_t p, std::size_t r, const Index<3>& row, T weight) {
      for (std::size_t i = 0; i < first_axis.count; ++i) {
        const auto& link = first_axis.link[i];
        Index<D> node;
        for (int d = 0; d < D; ++d) node[d] = d == 0 ? link.node : row[d];
        const V& value = mesh(node);
        for (int c = 0; c < C; ++c) {
          tile_row(k, p, r, c)[link.padded] += weight * link.weight * component(value, c);
        }
      }
    });
  }

  using Lanes = simd::Pack<T, tap_lanes<K>>;

  SparseTiles<K, P, D> tiles_;
  TileTargets targets_;
  AlignedVector<T> nodes_;
  std::vector<std::unique_ptr<AnyWorker>> workers_;
};

}  // namespace cambium::detail
