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

namespace cambium::detail {

/// Values at the nodes of a face of a box, all those on its edges included; axis p is the lower of the two in it.
template <class T>
struct Face {
  std::size_t width = 0;
  AlignedVector<T> values;
  T* at(std::size_t p, std::size_t q) { return values.data() + q * width + p; }
};
template <class T>
using Faces = std::array<std::array<Face<T>, 2>, 3>;

/// Potential that charges on the faces of a box across one axis make on the faces across another one, in space: sums
/// with the lattice Green's function along the edge the faces share, by Hartley's waves of twice its cells, and across
/// it by one matrix product for each wave.
///
/// With a the axis across the charged faces, b that across the others and e the edge, and for the waves along e,
///   u_b(side, alpha) = sum over sides and beta of M(|alpha - side|, |beta - side'|) q_a(side', beta),
/// alpha along a and beta along b. Sums and differences of the two sides and of beta and N_b - beta take this apart
/// into four matrices of a quarter of the size. All pairs (a, b) of a box whose three lengths are the same share them.
template <class T, Execution E>
class EdgeCoupling {
 public:
  using Line = LineTransform<T>;
  using Lanes = typename Line::Lanes;
  static constexpr std::size_t lines = Line::lines;
  static constexpr std::size_t width = Line::width;
  /// From the faces across pair[0] to those across pair[1].
  using Pair = std::array<int, 2>;

  /// \param cells   of the box
  /// \param pairs   of axes with the same N_a, N_b and N_e
  /// \param kernel  K at offsets 0, ..., cells along each axis, axis 0 fastest
  EdgeCoupling(const Index<3>& cells, const std::vector<Pair>& pairs, const AlignedVector<double>& kernel,
               const E& execution)
      : pairs_(pairs),
        along_a_(size(cells, pairs[0][0])),
        along_b_(size(cells, pairs[0][1])),
        along_e_(size(cells, edge(pairs[0]))),
        line_(Boundary::periodic, 2 * along_e_),
        columns_((2 * pairs.size() + width - 1) / width * width),
        execution_(execution) {
    tabulate(cells, kernel);
    charge_.resize((along_e_ + 1) * 4 * betas() * columns_);
    potential_.resize((along_e_ + 1) * 4 * alphas() * columns_);
    work_.resize(static_cast<std::size_t>(execution.count()));
    for (auto& arrays : work_) {
      for (auto& array : arrays) array.resize(line_.work_size());
    }
  }

  /// Adds the potential of the charges.
  void add(Faces<T>& charges, Faces<T>& potentials) {
    for (std::size_t g = 0; g < pairs_.size(); ++g) {
      for_each_piece_by_worker(
          execution_, betas(), lines / 4, [&](std::size_t worker, std::size_t begin, std::size_t end) {
            take_charges(g, begin, end, charges[static_cast<std::size_t>(pairs_[g][0])], work_[worker]);
          });
    }
    for_each_piece(execution_, (along_e_ + 1) * 4, 1, [&](std::size_t k, std::size_t) {
      if (columns_ == width) {
        multiply<1>(k);
      } else {
        multiply<2>(k);
      }
    });
    for (std::size_t g = 0; g < pairs_.size(); ++g) {
      for_each_piece_by_worker(
          execution_, alphas(), lines / 4, [&](std::size_t worker, std::size_t begin, std::size_t end) {
            give_potentials(g, begin, end, potentials[static_cast<std::size_t>(pairs_[g][1])], work_[worker]);
          });
    }
  }

 private:
  using Work = std::array<AlignedVector<T>, 3>;

  static int edge(const Pair& pair) { return 3 - pair[0] - pair[1]; }
  static std::size_t size(const Index<3>& cells, int d) { return static_cast<std::size_t>(cells[d]); }
  /// beta = 0, ..., N_b / 2 and alpha = 0, ..., N_a / 2
  std::size_t betas() const { return along_b_ / 2 + 1; }
  std::size_t alphas() const { return along_a_ / 2 + 1; }

  /// The four combinations of M(alpha, beta), M(N_a - alpha, beta) and the same of N_b - beta, over all norms.
  void tabulate(const Index<3>& cells, const AlignedVector<double>& kernel) {
    const int a = pairs_[0][0], b = pairs_[0][1], e = edge(pairs_[0]);
    std::array<std::size_t, 3> pitch{1, size(cells, 0) + 1, (size(cells, 0) + 1) * (size(cells, 1) + 1)};
    const auto at = [&](std::size_t alpha, std::size_t beta) {
      return kernel.data() + alpha * pitch[static_cast<std::size_t>(a)] + beta * pitch[static_cast<std::size_t>(b)];
    };
    matrix_.resize((along_e_ + 1) * 4 * alphas() * betas());
    const LineTransform<double> even(Boundary::neumann, along_e_);
    using Row = LineTransform<double>;
    const std::size_t step = pitch[static_cast<std::size_t>(e)];
    for_each_piece(execution_, alphas(), 1, [&](std::size_t alpha, std::size_t) {
      AlignedVector<double> tile((along_e_ + 1) * Row::lines), first(even.work_size()), second(even.work_size());
      for (std::size_t from = 0; from < betas(); from += Row::lines / 4) {
        const std::size_t count = std::min(Row::lines / 4, betas() - from);
        for (std::size_t i = 0; i < count; ++i) {
          const std::size_t beta = from + i;
          const double* const m[4] = {at(alpha, beta), at(along_a_ - alpha, beta), at(alpha, along_b_ - beta),
                                      at(along_a_ - alpha, along_b_ - beta)};
          const double scale = (2 * beta == along_b_ ? 0.5 : 1.0) * 0.25 / static_cast<double>(along_e_);
          for (std::size_t k = 0; k <= along_e_; ++k) {
            const double v[4] = {m[0][k * step], m[1][k * step], m[2][k * step], m[3][k * step]};
            double* const row = tile.data() + k * Row::lines + 4 * i;
            row[0] = scale * ((v[0] + v[1]) + (v[2] + v[3]));
            row[1] = scale * ((v[0] - v[1]) + (v[2] - v[3]));
            row[2] = scale * ((v[0] + v[1]) - (v[2] + v[3]));
            row[3] = scale * ((v[0] - v[1]) - (v[2] - v[3]));
          }
        }
        even.run(tile.data(), Row::lines, tile.data(), Row::lines, first.data(), second.data());
        for (std::size_t k = 0; k <= along_e_; ++k) {
          for (std::size_t i = 0; i < 4 * count; ++i) {
            matrix_[((k * 4 + i % 4) * alphas() + alpha) * betas() + from + i / 4] =
                static_cast<T>(tile[k * Row::lines + i]);
          }
        }
      }
    });
  }

  /// First entry of the line along the edge axis at `place` along the other axis of a face, and its step.
  struct Walk {
    T* first;
    std::size_t step;
  };
  static Walk walk(Face<T>& face, int other, int e, std::size_t place) {
    return other < e ? Walk{face.at(place, 0), face.width} : Walk{face.at(0, place), 1};
  }

  /// Two lines make one complex line, so that what is in an unused line changes the last bits of a used one.
  void clear_rest(std::size_t count, T* tile) const {
    if (4 * count < lines) std::fill(tile, tile + line_.work_size(), T(0));
  }

  /// Waves of the four combinations of charges at beta and N_b - beta on both sides.
  void take_charges(std::size_t g, std::size_t begin, std::size_t end, std::array<Face<T>, 2>& face, Work& work) {
    const int b = pairs_[g][1], e = edge(pairs_[g]);
    T* const tile = work[2].data();
    clear_rest(end - begin, tile);
    for (std::size_t i = begin; i < end; ++i) {
      const Walk low = walk(face[0], b, e, i), high = walk(face[1], b, e, i);
      const Walk mirror_low = walk(face[0], b, e, along_b_ - i);
      const Walk mirror_high = walk(face[1], b, e, along_b_ - i);
      for (std::size_t k = 0; k <= along_e_; ++k) {
        const std::size_t at = k * low.step;
        const T sum = low.first[at] + high.first[at], difference = low.first[at] - high.first[at];
        const T mirror_sum = mirror_low.first[at] + mirror_high.first[at];
        const T mirror_difference = mirror_low.first[at] - mirror_high.first[at];
        T* const row = tile + k * lines + 4 * (i - begin);
        row[0] = sum + mirror_sum;
        row[1] = difference + mirror_difference;
        row[2] = sum - mirror_sum;
        row[3] = difference - mirror_difference;
      }
    }
    line_.run(tile, lines, along_e_ + 1, tile, lines, line_.size(), work[0].data(), work[1].data());
    for (std::size_t k = 0; k <= along_e_; ++k) {
      const T* const wave = tile + k * lines;
      const T* const mirror = tile + (k == 0 ? 0 : line_.size() - k) * lines;
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t parity = 0; parity < 4; ++parity) {
          T* const to = charge_.data() + ((k * 4 + parity) * betas() + i) * columns_ + 2 * g;
          to[0] = wave[4 * (i - begin) + parity];
          to[1] = mirror[4 * (i - begin) + parity];
        }
      }
    }
  }

  /// Product of matrix k (wave and parity) with the charges of all pairs: four rows at a time stay in registers.
  template <std::size_t Packs>
  void multiply(std::size_t k) {
    const T* const matrix = matrix_.data() + k * alphas() * betas();
    const T* const charge = charge_.data() + k * betas() * columns_;
    T* const potential = potential_.data() + k * alphas() * columns_;
    constexpr std::size_t rows = 4;
    for (std::size_t alpha = 0; alpha < alphas(); alpha += rows) {
      const T* row[rows];
      for (std::size_t r = 0; r < rows; ++r) row[r] = matrix + std::min(alpha + r, alphas() - 1) * betas();
      Lanes sum[rows][Packs];
      for (auto& one : sum) std::fill(one, one + Packs, Lanes(T(0)));
      for (std::size_t beta = 0; beta < betas(); ++beta) {
        Lanes q[Packs];
        for (std::size_t c = 0; c < Packs; ++c) q[c] = Lanes::load_aligned(charge + beta * columns_ + c * width);
        for (std::size_t r = 0; r < rows; ++r) {
          const Lanes factor(row[r][beta]);
          for (std::size_t c = 0; c < Packs; ++c) sum[r][c] = fma(factor, q[c], sum[r][c]);
        }
      }
      for (std::size_t r = 0; r < std::min(rows, alphas() - alpha); ++r) {
        for (std::size_t c = 0; c < Packs; ++c) {
          sum[r][c].store_aligned(potential + (alpha + r) * columns_ + c * width);
        }
      }
    }
  }

  void give_potentials(std::size_t g, std::size_t begin, std::size_t end, std::array<Face<T>, 2>& face, Work& work) {
    const int a = pairs_[g][0], e = edge(pairs_[g]);
    T* const tile = work[2].data();
    clear_rest(end - begin, tile);
    for (std::size_t k = 0; k <= along_e_; ++k) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t parity = 0; parity < 4; ++parity) {
          const T* const from = potential_.data() + ((k * 4 + parity) * alphas() + i) * columns_ + 2 * g;
          tile[k * lines + 4 * (i - begin) + parity] = from[0];
          if (k > 0 && k < along_e_) tile[(line_.size() - k) * lines + 4 * (i - begin) + parity] = from[1];
        }
      }
    }
    line_.run(tile, lines, line_.size(), tile, lines, along_e_ + 1, work[0].data(), work[1].data());
    for (std::size_t i = begin; i < end; ++i) {
      const Walk low = walk(face[0], a, e, i), high = walk(face[1], a, e, i);
      const Walk mirror_low = walk(face[0], a, e, along_a_ - i), mirror_high = walk(face[1], a, e, along_a_ - i);
      for (std::size_t k = 0; k <= along_e_; ++k) {
        const std::size_t at = k * low.step;
        const T* const row = tile + k * lines + 4 * (i - begin);
        low.first[at] += (row[0] + row[1]) + (row[2] + row[3]);
        high.first[at] += (row[0] + row[1]) - (row[2] + row[3]);
        if (2 * i == along_a_) continue;
        mirror_low.first[at] += (row[0] - row[1]) + (row[2] - row[3]);
        mirror_high.first[at] += (row[0] - row[1]) - (row[2] - row[3]);
      }
    }
  }

  std::vector<Pair> pairs_;
  std::size_t along_a_, along_b_, along_e_;
  Line line_;
  std::size_t columns_;
  E execution_;
  AlignedVector<T> matrix_;
  AlignedVector<T> charge_;
  AlignedVector<T> potential_;
  std::vector<Work> work_;
};

}  // namespace cambium::detail
