// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include <cambium/interface/cut_domain.hpp>

namespace cambium::detail {

/// Values of one line of the lattice next to an interface, in spacings from a node towards it, and the polynomial
/// through them.
struct LinePoints {
  static constexpr int most = 4;
  int count = 0;
  std::array<double, most> place{};
  std::array<double, most> value{};

  void add(double x, double y) {
    place[static_cast<std::size_t>(count)] = x;
    value[static_cast<std::size_t>(count)] = y;
    ++count;
  }
  /// To be called when all points are added, before at().
  void settle() {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      double product = 1.0;
      for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
        if (j != i) product *= place[i] - place[j];
      }
      value[i] /= product;
    }
  }
  double at(double x) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      double product = value[i];
      for (std::size_t j = 0; j < static_cast<std::size_t>(count); ++j) {
        if (j != i) product *= x - place[j];
      }
      sum += product;
    }
    return sum;
  }
};

/// Continues a field to the other side of the interface: along each line of the lattice that crosses it, the polynomial
/// of degree `Degree` through the value on the interface and those of nodes of the domain. A node that several lines
/// reach takes their mean, weighted by the inverse fourth power of the distance to the crossing; lines too short for
/// that degree count where there is no other. Nodes near the interface that no such line reaches, beside sharp tips,
/// take the quadratic (or linear) continuation of nodes that have values. Nodes that lines from opposite sides reach,
/// in gaps of a few spacings, have values that belong to neither: they are marked.
template <int D, int Degree = 3>
class Continuation {
 public:
  static_assert(Degree >= 1 && Degree < LinePoints::most);
  struct Value {
    std::size_t at;
    Index<D> node;
    double weight;
    double sum;
    bool whole;             ///< by polynomials of the full degree
    std::uint8_t legs = 0;  ///< along which near crossings are

    /// Polynomials of the full degree take the place of others.
    void add(double more_weight, double more, bool of_full_degree) {
      if (whole && !of_full_degree) return;
      if (of_full_degree && !whole) weight = sum = 0.0;
      whole = of_full_degree;
      weight += more_weight;
      sum += more;
    }
  };

  /// Writes the values into x, and marks their nodes as `continued` or `between`; forget() undoes that.
  /// \param x       values at the entries of the level
  /// \param data    values on the interface: those of node i of the domain's cut nodes at 2 D i + leg
  /// \param reach   nodes to go beyond the interface
  const std::vector<Value>& find(CutDomain<D>& domain, double* x, const std::vector<double>& data,
                                 std::ptrdiff_t reach) {
    values_.clear();
    number_.resize(domain.grid.size());
    for (std::size_t i = 0; i < domain.nodes.size(); ++i) {
      for (std::size_t k = 0; k < 2 * D; ++k) {
        if (domain.nodes[i].leg[k] >= 0.0) follow(domain, x, data, i, k, reach);
      }
    }
    write(domain, x, 0);
    find_missing(domain, reach);
    for (int round = 0; round < 2 * D && !missing_.empty(); ++round) {
      const std::size_t before = values_.size();
      std::erase_if(missing_, [&](const Index<D>& node) { return extrapolate(domain, x, node); });
      write(domain, x, before);
    }
    for (const Value& value : values_) {
      if (is_between(value)) domain.kind[value.at] = between;
    }
    return values_;
  }
  void forget(CutDomain<D>& domain, double* x) const {
    for (const Value& value : values_) {
      x[value.at] = 0.0;
      domain.kind[value.at] = beyond;
    }
  }

 private:
  /// Closer to the interface than this a node adds nothing but round-off to the polynomial.
  static constexpr double too_close = 0.25;

  /// Nodes from the crossing up to which values have a part in gradients.
  static constexpr std::ptrdiff_t near = 3;

  static bool is_between(const Value& value) {
    for (int d = 0; d < D; ++d) {
      if ((value.legs >> (2 * d) & 3) == 3) return true;
    }
    return false;
  }

  void follow(CutDomain<D>& domain, const double* x, const std::vector<double>& data, std::size_t i, std::size_t k,
              std::ptrdiff_t reach) {
    const CutNode<D>& start = domain.nodes[i];
    const double crossing = start.leg[k];
    const LinePoints line = points(domain, x, data, i, k);
    Index<D> node = start.node;
    for (std::ptrdiff_t m = 1; m <= reach; ++m) {
      const Index<D> next = domain.neighbour(node, k);
      const bool wall = !domain.grid.periodic[static_cast<int>(k / 2)] &&
                        next[static_cast<int>(k / 2)] - node[static_cast<int>(k / 2)] != (k % 2 == 0 ? -1 : 1);
      if (wall || is_original(domain, next)) return;
      node = next;
      const double distance = static_cast<double>(m) - crossing + 0.1;
      const double weight = 1.0 / (distance * distance * distance * distance);
      Value& value = value_at(domain, node);
      value.add(weight, weight * line.at(static_cast<double>(m)), line.count > Degree);
      if (m <= near) value.legs = static_cast<std::uint8_t>(value.legs | (1U << k));
    }
  }
  /// True for a node of the domain itself.
  static bool is_original(const CutDomain<D>& domain, const Index<D>& node) {
    const std::uint8_t kind = domain.kind[domain.grid.at(node)];
    return kind != beyond && kind != continued;
  }
  /// The value of a node that has one or gets it now.
  Value& value_at(CutDomain<D>& domain, const Index<D>& node) {
    const std::size_t at = domain.grid.at(node);
    if (domain.kind[at] != continued) {
      domain.kind[at] = continued;
      number_[at] = static_cast<std::uint32_t>(values_.size());
      values_.push_back({at, node, 0.0, 0.0, false, 0});
    }
    return values_[number_[at]];
  }
  LinePoints points(const CutDomain<D>& domain, const double* x, const std::vector<double>& data, std::size_t i,
                    std::size_t k) const {
    const std::size_t back = k ^ 1;
    const CutNode<D>& start = domain.nodes[i];
    LinePoints line;
    line.add(start.leg[k], data[2 * D * i + k]);
    Index<D> node = start.node;
    double place = 0.0;
    while (line.count <= Degree) {
      const std::size_t at = domain.grid.at(node);
      const bool close = line.place[0] - place < too_close;
      if (!close) line.add(place, x[at]);
      if (line.count > Degree || domain.kind[at] == given) break;
      const double leg = at == start.at ? start.leg[back] : domain.leg(node, back);
      if (leg >= 0.0) {
        const auto number = static_cast<std::size_t>(&domain.cut_node(at) - domain.nodes.data());
        const bool apart = line.place[static_cast<std::size_t>(line.count - 1)] - (place - leg) >= too_close;
        if (apart) line.add(place - leg, data[2 * D * number + back]);
        break;
      }
      node = domain.neighbour(node, back);
      place -= 1.0;
    }
    line.settle();
    return line;
  }

  void write(CutDomain<D>& domain, double* x, std::size_t from) const {
    for (std::size_t i = from; i < values_.size(); ++i) {
      x[values_[i].at] = values_[i].sum / values_[i].weight;
      domain.kind[values_[i].at] = continued;
    }
  }
  /// Nodes up to two indices away from cut nodes that have no value.
  void find_missing(const CutDomain<D>& domain, std::ptrdiff_t reach) {
    missing_.clear();
    listed_.resize(domain.grid.size());
    const std::ptrdiff_t r = std::min<std::ptrdiff_t>(reach, 2);
    const Index<D> around = Index<D>::constant(r);
    for (const auto& start : domain.nodes) {
      bool inner = true;
      for (int d = 0; d < D; ++d) inner = inner && start.node[d] >= r && start.node[d] + r < domain.grid.nodes[d];
      for_each_row<D>(start.node - around, start.node + around, [&](const Index<D>& row) {
        if (inner) {
          list_row(domain, row, 2 * r);
        } else {
          list_row_at_faces(domain, row, 2 * r);
        }
      });
    }
    for (const Index<D>& node : missing_) listed_[domain.grid.at(node)] = 0;
  }
  void list(const CutDomain<D>& domain, std::size_t at, const Index<D>& node) {
    if (domain.kind[at] != beyond || listed_[at] != 0) return;
    listed_[at] = 1;
    missing_.push_back(node);
  }
  void list_row(const CutDomain<D>& domain, Index<D> node, std::ptrdiff_t count) {
    const std::size_t first = domain.grid.at(node);
    for (std::ptrdiff_t i = 0; i <= count; ++i, ++node[0]) list(domain, first + static_cast<std::size_t>(i), node);
  }
  void list_row_at_faces(const CutDomain<D>& domain, const Index<D>& row, std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i <= count; ++i) {
      Index<D> node = row;
      node[0] += i;
      bool inside = true;
      for (int d = 0; d < D; ++d) {
        const std::ptrdiff_t n = domain.grid.nodes[d];
        if (domain.grid.periodic[d]) node[d] = (node[d] % n + n) % n;
        inside = inside && node[d] >= 0 && node[d] < n;
      }
      if (inside) list(domain, domain.grid.at(node), node);
    }
  }
  /// Mean over the lines with most values. \return false if there is none
  bool extrapolate(const CutDomain<D>& domain, const double* x, const Index<D>& node) {
    int most = 1;
    Value value{domain.grid.at(node), node, 0.0, 0.0, false, 0};
    for (std::size_t k = 0; k < 2 * D; ++k) {
      std::array<double, 3> v{};
      int count = 0;
      Index<D> next = domain.neighbour(node, k);
      while (count < 3 && domain.in_domain(next)) {
        v[static_cast<std::size_t>(count++)] = x[domain.grid.at(next)];
        next = domain.neighbour(next, k);
      }
      if (count < 2 || count < most) continue;
      if (count > most) value.weight = value.sum = 0.0;
      most = count;
      value.weight += 1.0;
      value.sum += count == 3 ? 3.0 * (v[0] - v[1]) + v[2] : 2.0 * v[0] - v[1];
    }
    if (value.weight > 0.0) values_.push_back(value);
    return value.weight > 0.0;
  }

  std::vector<Value> values_;
  std::vector<std::uint32_t> number_;  ///< of the value of a `continued` node
  std::vector<Index<D>> missing_;
  std::vector<std::uint8_t> listed_;  ///< 1 for nodes in missing_ while these are gathered
};

}  // namespace cambium::detail
