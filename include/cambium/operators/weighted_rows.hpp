// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <cambium/core/aligned.hpp>
#include <cambium/operators/columns_of.hpp>
#include <cambium/particles/validation.hpp>

namespace cambium {

/// One row of weights: `Count` weights for each neighbour, neighbour by neighbour.
template <int Count>
struct WeightedRow {
  std::vector<std::uint32_t> neighbour;
  std::vector<double> weight;
};

/// `Count` linear operators with common neighbours, stored and applied as out_p = sum_q w_pq (f_q - f_p).
///
/// Constants give exactly zero. Made by DCPSE; used as often as the particles stand still.
template <int Count, Execution E = OpenMP>
class WeightedRows {
 public:
  WeightedRows(const std::vector<WeightedRow<Count>>& rows, const E& execution) : execution_(execution) {
    first_.reserve(rows.size() + 1);
    first_.push_back(0);
    for (const auto& row : rows) first_.push_back(first_.back() + row.neighbour.size());
    neighbour_.reserve(first_.back());
    weight_.reserve(first_.back() * Count);
    for (const auto& row : rows) {
      neighbour_.insert(neighbour_.end(), row.neighbour.begin(), row.neighbour.end());
      weight_.insert(weight_.end(), row.weight.begin(), row.weight.end());
    }
  }

  /// Number of particles.
  std::size_t size() const { return first_.size() - 1; }
  /// Number of neighbours of particle p.
  std::size_t neighbours(std::size_t p) const { return first_[p + 1] - first_[p]; }

  /// Component c * Count + k of `out` is operator k applied to component c of `in`, both arrays of values.
  /// \throws SizeError if an array has not one entry per particle
  /// \throws ValueError if `in` is not finite or is also `out`; `out` is unchanged then
  template <class In, class Out>
  void apply(const In& in, Out&& out) const {
    const auto f = detail::const_columns_of(in);
    constexpr int count = decltype(f)::count;
    run<count * Count>(f, detail::columns_of(out), [&](std::size_t p, std::size_t q, const double* w, auto& sum) {
      for (int c = 0; c < count; ++c) {
        const double difference = static_cast<double>(f.column(c)[q]) - static_cast<double>(f.column(c)[p]);
        for (int k = 0; k < Count; ++k) sum[c * Count + k] += w[k] * difference;
      }
    });
  }

  /// Sum over k of operator k applied to component k: the divergence, if the operators are a gradient.
  /// Errors as apply().
  template <class In, class Out>
  void divergence(const In& in, Out&& out) const {
    const auto f = detail::const_columns_of(in);
    static_assert(decltype(f)::count == Count, "cambium: the divergence needs as many components as dimensions");
    run<1>(f, detail::columns_of(out), [&](std::size_t p, std::size_t q, const double* w, auto& sum) {
      for (int k = 0; k < Count; ++k) {
        sum[0] += w[k] * (static_cast<double>(f.column(k)[q]) - static_cast<double>(f.column(k)[p]));
      }
    });
  }

 private:
  template <int Results, int C, class S, class T, class F>
  void run(const Columns<C, S>& in, const Columns<Results, T>& out, F&& add) const {
    require_size(in.size(), size(), "the argument of an operator on particles");
    require_size(out.size(), size(), "the result of an operator on particles");
    detail::require_distinct(in, out);
    require_finite(Columns<C, S>(in), "argument of an operator", execution_);
    for_each(execution_, size(), [&](std::size_t p) {
      Vec<Results> sum;
      for (std::size_t k = first_[p]; k < first_[p + 1]; ++k) add(p, neighbour_[k], &weight_[k * Count], sum);
      for (int c = 0; c < Results; ++c) out.column(c)[p] = static_cast<T>(sum[c]);
    });
  }

  std::vector<std::size_t> first_;
  AlignedVector<std::uint32_t> neighbour_;
  AlignedVector<double> weight_;
  E execution_;
};

}  // namespace cambium
