// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/core/vec.hpp>
#include <cambium/parallel/execution.hpp>
#include <cambium/poisson/line_transform.hpp>
#include <cambium/simd/transpose.hpp>

namespace cambium::detail {

/// Sine, cosine or Hartley transforms along every axis of a box, in an array of its own.
///
/// The array holds sizes()[d] values along axis d, axis 0 fastest; rows are filled up to whole tiles and are an odd
/// number of cache lines apart, so that the rows of a tile do not drive each other out of the cache. Along axis 0 tiles
/// are transposed, along the others neighbouring lines lie side by side as they are.
template <int D, class T, Execution E>
class BoxTransform {
 public:
  static_assert(D == 2 || D == 3, "cambium: transforms of boxes are made for two and three dimensions");
  using Line = LineTransform<T>;
  static constexpr std::size_t lines = Line::lines;
  static constexpr int last = D - 1;

  BoxTransform(const std::array<Boundary, D>& boundary, const Index<D>& cells, const E& execution)
      : execution_(execution), pitch_(Index<D>::constant(1)) {
    std::size_t work = 0;
    for (int d = 0; d < D; ++d) {
      line_.emplace_back(boundary[d], static_cast<std::size_t>(cells[d]));
      sizes_[d] = static_cast<std::ptrdiff_t>(line_.back().size());
      work = std::max({work, line_.back().work_size(), line_.back().size() * lines});
    }
    constexpr auto width = static_cast<std::ptrdiff_t>(Line::width);
    pitch_[1] = round_up(sizes_[0]) + width;
    if (D == 3) pitch_[last] = round_up(sizes_[1]) * pitch_[1] + width;
    const auto size = (D == 3 ? sizes_[last] : round_up(sizes_[1])) * pitch_[last];
    values_.resize(static_cast<std::size_t>(size));
    work_.resize(static_cast<std::size_t>(execution.count()));
    for (auto& arrays : work_) {
      for (auto& array : arrays) array.resize(work);
    }
  }

  const Index<D>& sizes() const { return sizes_; }
  const Line& line(int axis) const { return line_[static_cast<std::size_t>(axis)]; }
  /// Transforming all axes twice multiplies by this.
  double norm() const {
    double result = 1.0;
    for (const Line& one : line_) result *= one.norm();
    return result;
  }
  /// Number of rows along axis 0, and the wave numbers (or nodes) of the first entry of a row.
  std::size_t rows() const { return static_cast<std::size_t>(product(sizes_) / sizes_[0]); }
  Index<D> row(std::size_t number) const {
    Index<D> result;
    auto rest = static_cast<std::ptrdiff_t>(number);
    for (int d = 1; d < D; ++d) {
      result[d] = rest % sizes_[d];
      rest /= sizes_[d];
    }
    return result;
  }
  T* at(const Index<D>& m) { return values_.data() + dot(m, pitch_); }
  std::size_t pitch(int axis) const { return static_cast<std::size_t>(pitch_[axis]); }

  void clear() { std::fill(values_.begin(), values_.end(), T(0)); }
  /// Calls f(row, first entry) for every row along axis 0; what f does not write of a row stays as it is.
  template <class F>
  void for_each_row(F&& f) {
    for_each_piece(execution_, rows(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t r = begin; r < end; ++r) f(row(r), at(row(r)));
    });
  }

  /// Clears what fills rows up to whole tiles: transforms leave round-off there, which would grow from one to the next.
  void clear_margins() {
    const std::ptrdiff_t rows = round_up(sizes_[1]);
    const std::ptrdiff_t planes = D == 3 ? sizes_[last] : 1;
    for_each(execution_, static_cast<std::size_t>(rows * planes), [&](std::size_t r) {
      Index<D> m;
      m[1] = static_cast<std::ptrdiff_t>(r) % rows;
      if (D == 3) m[last] = static_cast<std::ptrdiff_t>(r) / rows;
      std::fill(at(m) + (m[1] < sizes_[1] ? sizes_[0] : 0), at(m) + round_up(sizes_[0]), T(0));
    });
  }

  /// Fills rows by read(m, row), m the wave numbers (or nodes) of the first entry, and transforms them along every axis
  /// but the last, each while it is in the cache.
  template <class Read>
  void to_waves(Read&& read) {
    for_each_row_tile([&](const Index<D>& m, T* values, Work& work) {
      fill_rows(m, values, read);
      transform_rows(values, work);
    });
    if (D == 3) transform_axis(1);
  }
  /// The same in reverse order, write(m, row) taking what comes out: what there was times the norms.
  template <class Write>
  void to_nodes(Write&& write) {
    if (D == 3) transform_axis(1);
    for_each_row_tile([&](const Index<D>& m, T* values, Work& work) {
      transform_rows(values, work);
      for (std::ptrdiff_t r = 0; r < static_cast<std::ptrdiff_t>(lines) && m[1] + r < sizes_[1]; ++r) {
        write(m + Index<D>::unit(1, r), static_cast<const T*>(values + r * pitch_[1]));
      }
    });
  }
  /// Transforms what is there along every axis; twice gives it back, times the norms.
  void transform() {
    for_each_row_tile([&](const Index<D>&, T* values, Work& work) { transform_rows(values, work); });
    for (int d = 1; d < D; ++d) transform_axis(d);
  }
  /// Transforms along the last axis and calls use(m, waves), where entry k pitch(last) + i of `waves` is the wave
  /// m + (i, 0, k). Tiles of the same m[0], a multiple of `lines`, are called for one after the other, in order.
  template <class F>
  void use_waves(F&& use) {
    const std::ptrdiff_t blocks = round_up(sizes_[0]) / static_cast<std::ptrdiff_t>(lines);
    const auto run = [&](std::size_t worker, std::size_t block, std::size_t) {
      auto& work = work_[worker];
      Index<D> m = Index<D>::unit(0, static_cast<std::ptrdiff_t>(block * lines));
      for (std::ptrdiff_t j = 0; j < (D == 3 ? sizes_[1] : 1); ++j) {
        if (D == 3) m[1] = j;
        line(last).run(at(m), pitch(last), at(m), pitch(last), work[0].data(), work[1].data());
        use(m, at(m));
      }
    };
    for_each_piece_by_worker(execution_, static_cast<std::size_t>(blocks), 1, run);
  }
  /// Calls change(m, waves) in any order, then transforms along the last axis.
  template <class F>
  void put_waves(F&& change) {
    for_each_tile(last, [&](const Index<D>& m, Work& work) {
      change(m, at(m));
      line(last).run(at(m), pitch(last), at(m), pitch(last), work[0].data(), work[1].data());
    });
  }
  /// Transforms along the last axis, calls change(m, tile) and transforms back: entry k `lines` + i of `tile` is the
  /// wave m + (i, 0, k), m[0] a multiple of `lines`. Entries beyond sizes()[0] mean nothing and must stay finite.
  template <class F>
  void change_waves(F&& change) {
    for_each_tile(last, [&](const Index<D>& m, auto& work) {
      T* const values = at(m);
      T* const tile = work[2].data();
      line(last).run(values, pitch(last), tile, lines, work[0].data(), work[1].data());
      change(m, tile);
      line(last).run(tile, lines, values, pitch(last), work[0].data(), work[1].data());
    });
  }

 private:
  using Work = std::array<AlignedVector<T>, 3>;

  static std::ptrdiff_t round_up(std::ptrdiff_t n) {
    constexpr auto whole = static_cast<std::ptrdiff_t>(lines);
    return (n + whole - 1) / whole * whole;
  }

  /// Calls f(m, work) for every tile of lines along `axis` > 0, which starts at m.
  template <class F>
  void for_each_tile(int axis, F&& f) {
    const std::ptrdiff_t blocks = round_up(sizes_[0]) / static_cast<std::ptrdiff_t>(lines);
    const std::ptrdiff_t others = product(sizes_) / (sizes_[0] * sizes_[axis]);
    const auto run = [&](std::size_t worker, std::size_t begin, std::size_t end) {
      for (auto tile = static_cast<std::ptrdiff_t>(begin); tile < static_cast<std::ptrdiff_t>(end); ++tile) {
        Index<D> m;
        m[0] = tile % blocks * static_cast<std::ptrdiff_t>(lines);
        if (D == 3) m[3 - axis] = tile / blocks;
        f(m, work_[worker]);
      }
    };
    for_each_piece_by_worker(execution_, static_cast<std::size_t>(blocks * others), 8, run);
  }

  void transform_axis(int axis) {
    for_each_tile(axis, [&](const Index<D>& m, Work& work) {
      line(axis).run(at(m), pitch(axis), at(m), pitch(axis), work[0].data(), work[1].data());
    });
  }

  /// Calls f(m, row, work) for every `lines` rows along axis 0, of which `row` is the first and starts at m.
  template <class F>
  void for_each_row_tile(F&& f) {
    const std::ptrdiff_t blocks = round_up(sizes_[1]) / static_cast<std::ptrdiff_t>(lines);
    const std::ptrdiff_t planes = D == 3 ? sizes_[last] : 1;
    const auto run = [&](std::size_t worker, std::size_t begin, std::size_t end) {
      for (auto tile = static_cast<std::ptrdiff_t>(begin); tile < static_cast<std::ptrdiff_t>(end); ++tile) {
        Index<D> m;
        if (D == 3) m[last] = tile / blocks;
        m[1] = tile % blocks * static_cast<std::ptrdiff_t>(lines);
        f(m, at(m), work_[worker]);
      }
    };
    for_each_piece_by_worker(execution_, static_cast<std::size_t>(blocks * planes), 8, run);
  }
  /// What fills rows and tiles up is cleared: transforms leave round-off there, which would grow from one to the next.
  template <class Read>
  void fill_rows(const Index<D>& m, T* values, Read&& read) {
    for (std::ptrdiff_t r = 0; r < static_cast<std::ptrdiff_t>(lines); ++r) {
      T* const row = values + r * pitch_[1];
      const bool inside = m[1] + r < sizes_[1];
      if (inside) read(m + Index<D>::unit(1, r), row);
      std::fill(row + (inside ? sizes_[0] : 0), row + round_up(sizes_[0]), T(0));
    }
  }
  void transform_rows(T* values, Work& work) {
    constexpr std::size_t width = Line::width;
    T* const tile = work[2].data();
    const std::size_t whole = line(0).size() / width * width;
    const auto rest = [&](auto&& move) {
      for (std::size_t i = whole; i < line(0).size(); ++i) {
        for (std::size_t j = 0; j < lines; ++j) move(values[j * pitch(1) + i], tile[i * lines + j]);
      }
    };
    for (std::size_t j = 0; j < lines; j += width) {
      for (std::size_t i = 0; i < whole; i += width) {
        simd::transpose<width>(values + j * pitch(1) + i, pitch_[1], tile + i * lines + j,
                               static_cast<std::ptrdiff_t>(lines));
      }
    }
    rest([](const T& value, T& entry) { entry = value; });
    line(0).run(tile, lines, tile, lines, work[0].data(), work[1].data());
    for (std::size_t j = 0; j < lines; j += width) {
      for (std::size_t i = 0; i < whole; i += width) {
        simd::transpose<width>(tile + i * lines + j, static_cast<std::ptrdiff_t>(lines), values + j * pitch(1) + i,
                               pitch_[1]);
      }
    }
    rest([](T& value, const T& entry) { value = entry; });
  }

  E execution_;
  std::vector<Line> line_;
  Index<D> sizes_;
  Index<D> pitch_;
  AlignedVector<T> values_;
  std::vector<Work> work_;
};

}  // namespace cambium::detail
