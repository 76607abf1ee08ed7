// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <cambium/interpolation/displacements.hpp>
#include <cambium/interpolation/interpolator.hpp>
#include <cambium/interpolation/place_particles.hpp>
#include <cambium/interpolation/remesh_params.hpp>
#include <cambium/interpolation/split_pass.hpp>
#include <cambium/simd/stream.hpp>

namespace cambium::detail {

/// Split remeshing of C strength components of particles that left the nodes of a lattice, in two stages.
///
/// In 3D the first stage takes planes of constant axis 1, moves them along axis 2 and then axis 0 while they are in
/// cache; in 2D it takes strips of columns and moves them along axis 1. The second stage moves planes (3D) or strips
/// of rows (2D) along the axis that is left and writes the new particles. Planes and strips are spread over threads.
template <class K, class T, class P, int D, int C>
class SplitPlan {
 public:
  explicit SplitPlan(const Lattice<D>& lattice)
      : engine{lattice},
        nodes_{1, 1, 1},
        streams_(lattice.size() * (D * sizeof(P) + C * sizeof(T)) > (std::size_t{16} << 20)),
        first_(lattice, D - 1),
        middle_(lattice, 0),
        last_(lattice, D == 3 ? 1 : 0) {
    for (int d = 0; d < D; ++d) nodes_[d] = lattice.nodes()[d];
    for (auto& array : between_) array.resize(D > 1 ? lattice.size() : 0);
    for (int d = 0; d < D; ++d) {
      for (Index<D> node{}; node[d] < nodes_[d]; ++node[d]) {
        coordinates_[d].push_back(static_cast<P>(lattice.position(node)[d]));
      }
    }
  }

  /// Replaces the particles. \throws PositionError, ValueError with the particles unchanged
  template <Execution E, class... V>
  RemeshReport<V...> operator()(Particles<D, P>& particles, const E& execution, Attribute<V>... attributes) {
    const Lattice<D>& lattice = engine.on;
    const Particles<D, P>& before = particles;
    prepare(execution);
    Source source{before.positions(), {}, {lattice, before.positions()}};
    collect(source.strength, columns_of(before[attributes])...);
    try {
      if (!source.moved.finite()) require_positions(lattice.domain(), before.positions(), execution);
      first_stages(source, execution);
    } catch (const Error&) {  // wrong input comes first, in the order of the particles
      (require_finite(read_columns(before[attributes]), "strength", execution), ...);
      require_positions(lattice.domain(), before.positions(), execution);
      throw;
    }
    if (particles.names().size() != sizeof...(V)) {
      particles.resize(0);
      particles.resize(lattice.size());
    }
    std::array<T*, C> result{};
    collect(result, columns_of(particles[attributes])...);
    const std::ptrdiff_t tiles = D == 3 ? nodes_[2] : D == 2 ? (nodes_[1] + strip - 1) / strip : 1;
    for_each_piece_by_worker(
        execution, static_cast<std::size_t>(tiles), 1, [&](std::size_t w, std::size_t tile, std::size_t) {
          second_stage(static_cast<std::ptrdiff_t>(tile), result, particles.positions(), workers_[w]);
        });
    RemeshReport<V...> report;
    report.created = lattice.size();
    return report;
  }

  OnLattice<D> engine;

 private:
  static constexpr std::ptrdiff_t strip = 64;
  static constexpr int carried = D - 1;
  static constexpr int locals = 2 * (C + carried) + 1;

  struct Source {
    Columns<D, const P> x;
    std::array<const T*, C> strength;
    Displacements<P, T, D> moved;
  };

  /// Each thread's arrays: the tile before and after its first move, then scratch of a pass.
  template <Execution E>
  void prepare(const E& execution) {
    rows_ = D == 3 ? std::max(nodes_[1], nodes_[2]) : D == 2 ? nodes_[1] : 1;
    // Eight more than the columns of a tile: rows do not all fall into one set of the cache.
    pitch_ = (D == 2 ? strip : nodes_[0]) + 8;
    const std::size_t scratch = std::max({first_.scratch_size(), middle_.scratch_size(), last_.scratch_size()});
    const std::size_t size = (static_cast<std::size_t>(rows_ * pitch_) * locals + 63) / 64 * 64 + scratch;
    if (workers_.size() < static_cast<std::size_t>(execution.count())) {
      workers_.resize(static_cast<std::size_t>(execution.count()));
    }
    for (auto& worker : workers_) worker.resize(size);
  }
  T* local(AlignedVector<T>& worker, int m) const { return worker.data() + rows_ * pitch_ * m; }
  T* scratch(AlignedVector<T>& worker) const {
    return worker.data() + (static_cast<std::size_t>(rows_ * pitch_) * locals + 63) / 64 * 64;
  }
  template <class Pointer, class... Views>
  static void collect(std::array<Pointer, C>& pointers, const Views&... views) {
    int next = 0;
    const auto take = [&](const auto& view) {
      for (int c = 0; c < view.count; ++c) pointers[next++] = view.column(c).data();
    };
    (take(views), ...);
  }

  /// Displacements and strengths of `count` particles from number p on, whose node is `node`, as rows of local arrays:
  /// displacement along the moving axis; strengths; displacements along the others, next axis first.
  /// \throws PositionError, ValueError that may name another particle than the first
  void read_row(const Source& source, std::size_t p, std::size_t count, const Index<D>& node, std::ptrdiff_t row,
                AlignedVector<T>& worker) const {
    std::array<const P*, D> x;
    std::array<const T*, C> strength;
    for (int d = 0; d < D; ++d) x[d] = source.x.column(d).data() + p;
    for (int c = 0; c < C; ++c) strength[c] = source.strength[c] + p;
    require_finite(Columns<C, const T>(strength, count), "strength", Serial{});
    if (!positions_valid(engine.on.domain(), source.x, p, p + count)) {
      require_positions(engine.on.domain(), Columns<D, const P>(x, count), Serial{});
    }
    for (int d = 0; d < D; ++d) {
      const int m = d == D - 1 ? 0 : 1 + C + d;
      source.moved.row(d, node[d], x[d], count, local(worker, m) + row * pitch_);
    }
    for (int c = 0; c < C; ++c) std::copy_n(strength[c], count, local(worker, 1 + c) + row * pitch_);
  }

  template <Execution E>
  void first_stages(const Source& source, const E& execution) {
    if constexpr (D > 1) {
      const std::ptrdiff_t tiles = D == 3 ? nodes_[1] : (nodes_[0] + strip - 1) / strip;
      for_each_piece_by_worker(execution, static_cast<std::size_t>(tiles), 1,
                               [&](std::size_t w, std::size_t tile, std::size_t) {
                                 first_stage(source, static_cast<std::ptrdiff_t>(tile), workers_[w]);
                               });
    } else {
      read_row(source, 0, engine.on.size(), Index<D>{}, 0, workers_[0]);
    }
  }
  /// 3D: plane y of all x and z, along axes 2 and 0. 2D: columns of a strip, along axis 1.
  void first_stage(const Source& source, std::ptrdiff_t tile, AlignedVector<T>& worker) requires(D > 1) {
    constexpr int moving = D - 1;
    const std::ptrdiff_t x0 = D == 2 ? tile * strip : 0;
    const std::ptrdiff_t columns = D == 2 ? std::min(strip, nodes_[0] - x0) : nodes_[0];
    const auto at = [&](std::ptrdiff_t row) {
      return D == 2 ? row * nodes_[0] + x0 : (row * nodes_[1] + tile) * nodes_[0];
    };
    for (std::ptrdiff_t row = 0; row < nodes_[moving]; ++row) {
      Index<D> node{};
      node[0] = x0;
      node[1] = D == 2 ? row : tile;
      node[moving] = row;
      read_row(source, static_cast<std::size_t>(at(row)), static_cast<std::size_t>(columns), node, row, worker);
    }
    std::array<const T*, C + carried> in;
    std::array<T*, C + carried> out;
    for (int m = 0; m < C + carried; ++m) {
      in[m] = local(worker, 1 + m);
      out[m] = D == 2 ? between_[m].data() + x0 : local(worker, 1 + C + carried + m);
    }
    const LineTile inner{columns, pitch_, 1};
    if constexpr (D == 2) {
      first_(inner, local(worker, 0), in, {columns, nodes_[0], 1}, out, scratch(worker));
    } else {
      first_(inner, local(worker, 0), in, inner, out, scratch(worker));
      std::array<const T*, C + 1> next_in;
      std::array<T*, C + 1> next_out;
      for (int m = 0; m <= C; ++m) {
        next_in[m] = out[m == C ? C + 1 : m];
        next_out[m] = between_[m].data() + tile * nodes_[0];
      }
      middle_({nodes_[2], 1, pitch_}, out[C], next_in, {nodes_[2], 1, nodes_[0] * nodes_[1], streams_}, next_out,
              scratch(worker));
      simd::finish_streams();
    }
  }

  /// 3D: plane z, along axis 1. 2D: rows of a strip, along axis 0. 1D: the line. Then the new positions.
  void second_stage(std::ptrdiff_t tile, const std::array<T*, C>& result, Columns<D, P> positions,
                    AlignedVector<T>& worker) {
    const std::ptrdiff_t rows = D == 2 ? std::min(strip, nodes_[1] - tile * strip) : D == 3 ? nodes_[1] : 1;
    const std::ptrdiff_t from = D == 2 ? tile * strip * nodes_[0] : D == 3 ? tile * nodes_[0] * nodes_[1] : 0;
    std::array<const T*, C> in;
    std::array<T*, C> out;
    // In 3D lines run across rows: through local copies, so that memory is read and written row by row.
    for (int c = 0; c < C; ++c) {
      in[c] = D == 2 ? between_[c].data() + from : local(worker, 1 + c);
      out[c] = D == 3 ? local(worker, 1 + C + c) : result[c] + from;
    }
    if constexpr (D == 3) {
      for (int m = 0; m <= C; ++m) {
        copy_rows(between_[m].data() + from, nodes_[0], local(worker, m == C ? 0 : 1 + m), pitch_);
      }
    }
    const T* displacement = D == 2 ? between_[C].data() + from : local(worker, 0);
    const LineTile layout = D == 3 ? LineTile{nodes_[0], pitch_, 1} : LineTile{rows, 1, nodes_[0]};
    last_(layout, displacement, in, layout, out, scratch(worker));
    if constexpr (D == 3) {
      for (int c = 0; c < C; ++c) {
        for (std::ptrdiff_t row = 0; row < rows; ++row) {
          copy(out[c] + row * pitch_, nodes_[0], result[c] + from + row * nodes_[0]);
        }
      }
    }
    place_rows(positions, from, rows);
    simd::finish_streams();
  }
  void copy_rows(const T* from, std::ptrdiff_t from_pitch, T* to, std::ptrdiff_t to_pitch) const {
    for (std::ptrdiff_t row = 0; row < nodes_[1]; ++row) {
      std::copy_n(from + row * from_pitch, nodes_[0], to + row * to_pitch);
    }
  }
  /// What the caller gets is written past the caches if they could not hold it.
  template <class S>
  void copy(const S* from, std::ptrdiff_t count, S* to) const {
    streams_ ? simd::stream_copy(from, static_cast<std::size_t>(count), to) : void(std::copy_n(from, count, to));
  }
  template <class S>
  void fill(S* to, std::ptrdiff_t count, S value) const {
    streams_ ? simd::stream_fill(to, static_cast<std::size_t>(count), value) : void(std::fill_n(to, count, value));
  }
  /// Positions of the nodes of `rows` rows along axis 0, the first of them at number `from`.
  void place_rows(Columns<D, P> positions, std::ptrdiff_t from, std::ptrdiff_t rows) const {
    const Index<D> first = engine.on.node(static_cast<std::size_t>(from));
    const auto rest = [&](int d) { return positions.column(d).data() + from; };
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
      copy(coordinates_[0].data(), nodes_[0], rest(0) + row * nodes_[0]);
    }
    for (std::ptrdiff_t row = 0; D > 1 && row < rows; ++row) {
      fill(rest(D > 1) + row * nodes_[0], nodes_[0], coordinates_[D > 1][first[D > 1] + row]);
    }
    if constexpr (D == 3) fill(rest(2), rows * nodes_[0], coordinates_[2][first[2]]);
  }

  std::array<std::ptrdiff_t, 3> nodes_;
  bool streams_;  // the new particles take more than caches usually hold
  std::ptrdiff_t rows_ = 1;
  std::ptrdiff_t pitch_ = 1;
  SplitPass<K, T, C, D - 1> first_;
  SplitPass<K, T, C, 1> middle_;
  SplitPass<K, T, C, 0> last_;
  std::array<AlignedVector<T>, C + 1> between_;
  std::array<std::vector<P>, D> coordinates_;  // of nodes along each axis
  std::vector<AlignedVector<T>> workers_;
};

}  // namespace cambium::detail
