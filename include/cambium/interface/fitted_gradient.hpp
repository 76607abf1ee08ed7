// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <vector>

#include <cambium/interface/cut_domain.hpp>

namespace cambium::detail {

/// Gradient at a point of the interface where the lattice does not resolve the domain or what is beside it: of the
/// polynomial that fits, by weighted least squares, the values at nodes around the point and those on the interface
/// where the lines of the lattice through these nodes cross it. Nodes count that lines of the lattice within the domain
/// connect with the point, and that are not ahead of it: another front, or the other wall of a gap, has no part in it.
/// Order 2 with quadratic polynomials where there are enough nodes, 1 with linear ones; a part of a single node still
/// has one.
template <int D>
class FittedGradient {
 public:
  /// \param place    the point, in spacings from the first node of the lattice
  /// \param outward  unit normal there, out of the domain
  /// \param x        values at the entries of the domain; \param data  on the interface, at 2 D i + leg of cut node i
  /// \return times the spacing
  Vec<D> operator()(const Vec<D>& place, const Vec<D>& outward, const CutDomain<D>& domain, const double* x,
                    const std::vector<double>& data, bool quadratic) {
    gather(place, outward, domain, x, data);
    Vec<D> gradient;
    if (quadratic && samples_.size() >= 2 * terms(2) && fit(2, gradient)) return gradient;
    fit(1, gradient);
    return gradient;
  }

 private:
  static constexpr std::ptrdiff_t reach = 2;             ///< nodes around the one that is nearest to the point
  static constexpr std::ptrdiff_t edge = 2 * reach + 1;  ///< of the box of these
  static constexpr double ahead = 0.5;                   ///< spacings beyond the tangential plane that nodes may be
  static constexpr double width = 1.2;                   ///< of the Gaussian that weights, in spacings
  static constexpr std::size_t most = (D + 1) * (D + 2) / 2;
  static constexpr std::size_t terms(int degree) { return degree == 1 ? D + 1 : most; }
  using Row = std::array<double, most>;

  struct Sample {
    Vec<D> from;  ///< the point
    double value;
  };

  void gather(const Vec<D>& place, const Vec<D>& outward, const CutDomain<D>& domain, const double* x,
              const std::vector<double>& data) {
    samples_.clear();
    Index<D> start, middle;  // in the lattice, and where it is seen from the point: across periodic faces
    if (!find_start(place, outward, domain, start, middle)) return;
    reached_.fill(false);
    queue_.assign(1, {start, Index<D>{}});
    reached_[entry(Index<D>{})] = true;
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const auto [node, shift] = queue_[next];
      Vec<D> from;
      for (int d = 0; d < D; ++d) from[d] = static_cast<double>(middle[d] + shift[d]) - place[d];
      if (dot(from, outward) > ahead) continue;
      const std::size_t at = domain.grid.at(node);
      samples_.push_back({from, x[at]});
      for (std::size_t k = 0; k < 2 * D; ++k) {
        const double way = k % 2 == 0 ? -1.0 : 1.0;
        if (const double leg = domain.leg(node, k); leg >= 0.0) {
          const auto number = static_cast<std::size_t>(&domain.cut_node(at) - domain.nodes.data());
          const Vec<D> crossing = from + Vec<D>::unit(static_cast<int>(k / 2), way * leg);
          if (dot(crossing, outward) <= ahead) samples_.push_back({crossing, data[2 * D * number + k]});
        } else {
          follow(domain, node, shift, k);
        }
      }
    }
  }
  /// The node of the domain that is nearest to the point a little below the interface.
  static bool find_start(const Vec<D>& place, const Vec<D>& outward, const CutDomain<D>& domain, Index<D>& start,
                         Index<D>& seen) {
    const Vec<D> below = place - 0.7 * outward;
    Index<D> low;
    for (int d = 0; d < D; ++d) low[d] = static_cast<std::ptrdiff_t>(std::floor(below[d])) - 1;
    double nearest = 1e300;
    for_each_row<D>(low, low + Index<D>::constant(3), [&](const Index<D>& row) {
      for (std::ptrdiff_t i = 0; i < 4; ++i) {
        const Index<D> node = row + Index<D>::unit(0, i);
        Vec<D> off;
        for (int d = 0; d < D; ++d) off[d] = static_cast<double>(node[d]) - below[d];
        Index<D> in_lattice = node;
        if (dot(off, off) >= nearest || !wrap(domain, in_lattice) || !is_original(domain, in_lattice)) continue;
        nearest = dot(off, off);
        start = in_lattice;
        seen = node;
      }
    });
    return nearest < 1e300;
  }
  std::size_t entry(const Index<D>& shift) const {
    std::size_t at = 0;
    for (int d = D - 1; d >= 0; --d) at = at * edge + static_cast<std::size_t>(shift[d] + reach);
    return at;
  }
  void follow(const CutDomain<D>& domain, const Index<D>& node, const Index<D>& shift, std::size_t k) {
    const int d = static_cast<int>(k / 2);
    const std::ptrdiff_t way = k % 2 == 0 ? -1 : 1;
    const Index<D> moved = shift + Index<D>::unit(d, way);
    if (std::abs(moved[d]) > reach || reached_[entry(moved)]) return;
    Index<D> next = node + Index<D>::unit(d, way);
    if (!wrap(domain, next) || !is_original(domain, next)) return;
    reached_[entry(moved)] = true;
    queue_.push_back({next, moved});
  }
  /// \return false for nodes beyond a wall
  static bool wrap(const CutDomain<D>& domain, Index<D>& node) {
    for (int d = 0; d < D; ++d) {
      const std::ptrdiff_t n = domain.grid.nodes[d];
      if (domain.grid.periodic[d]) node[d] = (node[d] % n + n) % n;
      if (node[d] < 0 || node[d] >= n) return false;
    }
    return true;
  }
  static bool is_original(const CutDomain<D>& domain, const Index<D>& node) {
    const std::uint8_t kind = domain.kind[domain.grid.at(node)];
    return kind == plain || kind == cut || kind == given;
  }

  static Row monomials(const Vec<D>& y) {
    Row row{1.0};
    std::size_t next = 1;
    for (int d = 0; d < D; ++d) row[next++] = y[d];
    for (int d = 0; d < D; ++d) {
      for (int e = 0; e <= d; ++e) row[next++] = y[d] * y[e];
    }
    return row;
  }
  /// Normal equations by Cholesky. \return false if they are near to singular; linear ones have what makes the slope
  /// along directions without samples zero
  bool fit(int degree, Vec<D>& gradient) const {
    const std::size_t n = terms(degree);
    std::array<Row, most> matrix{};
    Row right{};
    for (const Sample& sample : samples_) {
      const double weight = std::exp(-dot(sample.from, sample.from) / (width * width));
      const Row row = monomials(sample.from);
      for (std::size_t i = 0; i < n; ++i) {
        right[i] += weight * row[i] * sample.value;
        for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += weight * row[i] * row[j];
      }
    }
    const double scale = matrix[0][0];
    for (std::size_t i = 1; degree == 1 && i < n; ++i) matrix[i][i] += 1e-6 * scale;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = matrix[i][j];
        for (std::size_t k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
        if (i > j) matrix[i][j] = sum / matrix[j][j];
        if (i == j && !(sum > (degree == 1 ? 0.0 : 1e-3) * matrix[i][i])) return false;
        if (i == j) matrix[i][i] = std::sqrt(sum);
      }
      for (std::size_t k = 0; k < i; ++k) right[i] -= matrix[i][k] * right[k];
      right[i] /= matrix[i][i];
    }
    for (std::size_t i = n; i-- > 1;) {
      for (std::size_t k = i + 1; k < n; ++k) right[i] -= matrix[k][i] * right[k];
      right[i] /= matrix[i][i];
    }
    for (int d = 0; d < D; ++d) gradient[d] = right[static_cast<std::size_t>(d) + 1];
    return true;
  }

  std::vector<Sample> samples_;
  std::vector<std::pair<Index<D>, Index<D>>> queue_;  ///< nodes, and where they are from the start
  std::array<bool, static_cast<std::size_t>(D == 2 ? edge * edge : edge * edge * edge)> reached_{};
};

}  // namespace cambium::detail
