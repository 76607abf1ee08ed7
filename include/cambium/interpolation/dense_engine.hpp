// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <vector>

#include <cambium/interpolation/closure.hpp>
#include <cambium/interpolation/row_order.hpp>
#include <cambium/interpolation/sweep.hpp>

namespace cambium::detail {

/// P2M and M2P between particles in row order and a dense mesh of interleaved components, in 2D and 3D.
///
/// The lattice is cut into slabs along the last axis whose number depends on the lattice alone; each is swept by one
/// thread. Planes that two slabs share are kept apart and added afterwards in the order of slabs, so that results are
/// the same bits for any number of threads.
template <class K, class T, class P, int D, int C>
class DenseEngine {
 public:
  static constexpr int last = D - 1;
  static constexpr std::ptrdiff_t before = Taps<K>::before;
  static constexpr std::size_t support = K::support;

  explicit DenseEngine(const Lattice<D>& lattice) : lattice_(lattice), z_(lattice, last) {
    for (int d = 0; d < D; ++d) cells_[d] = cells_along<K>(lattice, d);
    // Planes shared by two slabs are worked on twice: slabs of at least 4 supports (8 in 2D, where a plane is a row).
    const std::ptrdiff_t most = cells_[last] / ((D == 2 ? 8 : 4) * K::support);
    slabs_ = std::bit_floor(static_cast<std::size_t>(std::max<std::ptrdiff_t>(most, 1)));
  }

  const Lattice<D>& lattice() const { return lattice_; }

  template <Execution E>
  void p2m(const std::array<const P*, D>& x, const std::array<const T*, C>& strength, const RowOrder& order, T* mesh,
           const E& execution) {
    prepare(execution);
    const std::size_t plane = workers_[0]->closer.plane_size();
    pending_.resize(slabs_ * pending_planes * plane);
    for_each_piece_by_worker(execution, slabs_, 1, [&](std::size_t w, std::size_t k, std::size_t) {
      Worker& worker = *workers_[w];
      const CellBox<D> box = slab(k);
      worker.sweep.spread(box, x, strength, rows_of(order), Sink{*this, worker.closer, k, box, mesh, plane});
    });
    add_pending(mesh, plane, execution);
  }

  template <Execution E>
  void m2p(const std::array<const P*, D>& x, const std::array<T*, C>& value, const RowOrder& order, const T* mesh,
           const E& execution) {
    prepare(execution);
    for_each_piece_by_worker(execution, slabs_, 1, [&](std::size_t w, std::size_t k, std::size_t) {
      Worker& worker = *workers_[w];
      const CellBox<D> box = slab(k);
      worker.sweep.collect(box, x, value, rows_of(order), [&](std::size_t p, std::size_t r, int c, T* line) {
        read_row(worker, box.first[last] + static_cast<std::ptrdiff_t>(p) - before, r, c, mesh, line);
      });
    });
  }

 private:
  /// Planes of a slab that are not its own: support - 1 behind it, and those beyond a lower face.
  static constexpr std::size_t pending_planes = support - 1 + before;

  struct Worker {
    explicit Worker(const Lattice<D>& lattice) : sweep(lattice), closer(lattice) {}
    Sweep<K, T, P, D, C> sweep;
    PlaneCloser<K, T, D, C> closer;
    AlignedVector<T> row;
  };

  struct Sink {
    DenseEngine& engine;
    PlaneCloser<K, T, D, C>& closer;
    std::size_t number;
    const CellBox<D>& box;
    T* mesh;
    std::size_t plane_size;
    T* plane = nullptr;

    void begin(std::size_t p) {
      plane = engine.plane_of(number, box, p, mesh, plane_size);
      closer.expect(plane, 0);
    }
    void row(std::size_t, std::size_t r, int c, const T* line) {
      closer.put(plane, r, c, line);
      if (c == C - 1) closer.expect(plane, r + 1);
    }
    void end(std::size_t) { closer.finish(plane); }
  };

  template <Execution E>
  void prepare(const E& execution) {
    const auto count = static_cast<std::size_t>(execution.count());
    while (workers_.size() < count) workers_.push_back(std::make_unique<Worker>(lattice_));
  }
  /// Cells of slab k, all slabs as equal as can be.
  CellBox<D> slab(std::size_t k) const {
    CellBox<D> box{Index<D>{}, cells_};
    const auto bound = [&](std::size_t i) {
      return static_cast<std::ptrdiff_t>(i) * cells_[last] / static_cast<std::ptrdiff_t>(slabs_);
    };
    box.first[last] = bound(k);
    box.count[last] = bound(k + 1) - bound(k);
    return box;
  }
  auto rows_of(const RowOrder& order) const {
    return [this, &order](const Index<D>& cell) {
      std::ptrdiff_t row = 0;
      for (int d = last; d > 0; --d) row = row * cells_[d] + cell[d];
      return order.row(static_cast<std::size_t>(row));
    };
  }
  /// Number of the first of a slab's padded planes that are not its own. On a bounded axis nobody follows the last
  /// slab, so that the planes behind it that lie in the lattice are its own.
  std::ptrdiff_t own_planes(std::size_t k, const CellBox<D>& box) const {
    if (k + 1 < slabs_ || z_.periodic()) return box.count[last];
    return z_.nodes() - box.first[last] + before;
  }
  /// Where padded plane p of slab k goes: into the mesh if it is the slab's own, else into the slab's pending planes.
  T* plane_of(std::size_t k, const CellBox<D>& box, std::size_t p, T* mesh, std::size_t size) {
    const std::ptrdiff_t z = box.first[last] + static_cast<std::ptrdiff_t>(p) - before;
    const bool below = z < 0 && !z_.periodic();
    if (!below && static_cast<std::ptrdiff_t>(p) < own_planes(k, box)) {
      return mesh + static_cast<std::size_t>(z < 0 ? z + z_.nodes() : z) * size;
    }
    const std::size_t slot =
        below ? p : static_cast<std::size_t>(before) + p - static_cast<std::size_t>(box.count[last]);
    return pending_.data() + (k * pending_planes + slot) * size;
  }
  /// Calls f(padded plane, pending values) for every pending plane in the order of slabs.
  template <class F>
  void for_each_pending(std::size_t size, F&& f) {
    for (std::size_t k = 0; k < slabs_; ++k) {
      const CellBox<D> box = slab(k);
      const auto padded = static_cast<std::size_t>(box.count[last]) + support - 1;
      for (std::size_t p = 0; p < padded; ++p) {
        const std::ptrdiff_t z = box.first[last] + static_cast<std::ptrdiff_t>(p) - before;
        const bool below = z < 0 && !z_.periodic();
        if (!below && static_cast<std::ptrdiff_t>(p) < own_planes(k, box)) continue;
        f(z, plane_of(k, box, p, nullptr, size));
      }
    }
  }
  template <Execution E>
  void add_pending(T* mesh, std::size_t size, const E& execution) {
    for_each_piece(execution, size, 4096, [&](std::size_t begin, std::size_t end) {
      for_each_pending(size, [&](std::ptrdiff_t z, const T* from) {
        z_(z, [&](std::ptrdiff_t to, double w) {
          T* out = mesh + static_cast<std::size_t>(to) * size;
          const T weight = static_cast<T>(w);
          for (std::size_t i = begin; i < end; ++i) out[i] += weight * from[i];
        });
      });
    });
  }
  /// Padded row r of the plane at z, which may lie beyond the lattice.
  void read_row(Worker& worker, std::ptrdiff_t z, std::size_t r, int c, const T* mesh, T* line) const {
    const auto& closer = worker.closer;
    const auto size = static_cast<std::ptrdiff_t>(closer.plane_size());
    const T* only = nullptr;
    int rows = 0;
    const auto visit = [&](auto&& f) {
      z_(z, [&](std::ptrdiff_t from, double wz) {
        closer.for_each_row(mesh + from * size, r, [&](const T* row, double wy) { f(row, static_cast<T>(wz * wy)); });
      });
    };
    visit([&](const T* row, T) {
      only = row;
      ++rows;
    });
    if (rows > 1) {
      worker.row.assign(static_cast<std::size_t>(closer.row_size()), T(0));
      visit([&](const T* row, T w) {
        for (std::size_t i = 0; i < worker.row.size(); ++i) worker.row[i] += w * row[i];
      });
      only = worker.row.data();
    }
    closer.get(only, c, line);
  }

  Lattice<D> lattice_;
  Closure<K> z_;
  Index<D> cells_;
  std::size_t slabs_ = 1;
  std::vector<std::unique_ptr<Worker>> workers_;
  AlignedVector<T> pending_;
};

}  // namespace cambium::detail
