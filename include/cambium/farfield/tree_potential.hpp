// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <cambium/farfield/cluster_tree.hpp>
#include <cambium/farfield/direct_potential.hpp>
#include <cambium/farfield/expansion_reach.hpp>
#include <cambium/farfield/plane_expansion.hpp>
#include <cambium/farfield/space_expansion.hpp>

namespace cambium {

/// Potential of N point sources in free space at M targets, and its gradient, by a tree of clusters of sources:
/// clusters far away act by expansions about their centres, others by the plain sum (direct_potential()).
///
///     cambium::TreePotential<3> tree({.tolerance = 1e-6});
///     tree.set_sources(y, q);
///     tree.evaluate(x, potential);
///
/// The error at every target is at most `tolerance` times sum_j |q_j| / (4 pi |x - y_j|) in space, sum_j |q_j| / (2 pi)
/// in the plane; with gradients both this and, for the gradient, `tolerance` times sum_j |q_j| / (4 pi |x - y_j|^2)
/// (2 pi |x - y_j|). These are bounds, not estimates (see detail::ExpansionReach): every pair of a cluster and a batch
/// of targets takes the lowest order that has it. The cost is O((N + M) log N log^D(1 / tolerance)) or less. Buffers
/// are kept between calls; the same bits for any number of threads; not to be used by two threads at a time.
template <int D, Execution E = OpenMP>
class TreePotential {
 public:
  static constexpr int dimension = D;

  struct Params {
    /// 1e-13 to 0.5
    double tolerance = 1e-6;
  };
  /// What the last evaluation did, in pairs of a target and a source, or a target and an expansion.
  struct Work {
    std::size_t direct = 0;
    std::size_t expansions = 0;
    std::size_t terms = 0;  ///< of the expansions
  };

  /// \throws ValueError if the tolerance is out of its range
  TreePotential() : TreePotential(Params{}) {}
  explicit TreePotential(const Params& params, const E& execution = {})
      : params_(params), execution_(execution), work_(static_cast<std::size_t>(execution.count())) {
    if (!(params.tolerance >= 1e-13 && params.tolerance <= 0.5)) {
      throw ValueError(detail::message("tolerance of a tree is ", params.tolerance, ": it must be from 1e-13 to 0.5"));
    }
    // Clusters are best taken at about twice (plane 1.6 times) their radius.
    const double orders = -std::log(params.tolerance) * (D == 2 ? 1.6 : 1.0);
    most_ = std::min(Expansion::most_order, static_cast<std::size_t>(orders) + 2);
  }

  /// \throws SizeError if lengths differ \throws PositionError or ValueError if a number is not finite; the sources
  /// that
  ///         were set before stay then
  void set_sources(Columns<D, const double> y, std::span<const double> q) {
    detail::require_sources(y, q, execution_);
    const auto leaf = static_cast<std::size_t>(Expansion::template cost<false>(most_));
    sources_.build(y, std::max(leaf, 2 * lanes), lanes);
    strength_.resize(q.size());
    for (std::size_t i = 0; i < q.size(); ++i) strength_[i] = q[sources_.order()[i]];
    reach_known_ = {};
  }
  std::size_t size() const { return strength_.size(); }

  /// potential := that of the sources. \throws as direct_potential()
  void evaluate(Columns<D, const double> x, std::span<double> potential) {
    run<false>(x, potential, Columns<D, double>());
  }
  /// The same with the gradient.
  void evaluate(Columns<D, const double> x, std::span<double> potential, Columns<D, double> gradient) {
    run<true>(x, potential, gradient);
  }

  const Work& work() const { return counted_; }

 private:
  using Expansion = detail::Expansion<D>;
  using Lanes = detail::FarLanes;
  static constexpr std::size_t lanes = Lanes::lanes;
  static constexpr std::uint32_t near = 0xffffffff;
  static constexpr std::size_t batch_size = 64;  ///< targets that share a list of clusters, at most
  static constexpr std::size_t most_vectors = batch_size / lanes;
  static_assert(batch_size % lanes == 0);

  /// A cluster that acts on a batch with the expansion up to an order, or source by source.
  struct Entry {
    std::uint32_t cluster;
    std::uint32_t order;
  };
  struct Scratch {
    AlignedVector<double> numbers;
    AlignedVector<Lanes> sums;
    std::vector<std::uint32_t> stack;
  };

  template <bool Gradient>
  void run(Columns<D, const double> x, std::span<double> potential, Columns<D, double> gradient) {
    require_positions(Domain<D>::periodic_box(Box<D>::cube()), x, execution_);
    require_size(potential.size(), x.size(), "the array of potentials");
    if (Gradient) require_size(gradient.size(), x.size(), "the array of gradients");
    tabulate_reach(Gradient);
    // A batch much larger than the clusters next to it would take these source by source.
    targets_.build(x, batch_size, lanes, [this](const detail::Cluster<D>& batch) {
      return batch.radius <= sources_.local_radius(batch.box.centre());
    });
    const auto& batches = targets_.leaves();
    if (lists_.size() < batches.size()) lists_.resize(batches.size());
    for_each_piece_by_worker(execution_, batches.size(), 4,
                             [&](std::size_t worker, std::size_t begin, std::size_t end) {
                               for (std::size_t b = begin; b < end; ++b) list<Gradient>(b, work_[worker].stack);
                             });
    find_moments();
    for_each_piece_by_worker(execution_, batches.size(), 1, [&](std::size_t worker, std::size_t b, std::size_t) {
      add_batch<Gradient>(b, work_[worker].numbers, potential, gradient);
    });
  }

  /// The distance from which on each order serves, for each cluster.
  void tabulate_reach(bool gradient) {
    if (reach_known_[gradient ? 1 : 0]) return;
    reach_known_ = {};
    const auto& clusters = sources_.clusters();
    const detail::ExpansionReach<D> reach(params_.tolerance, gradient);
    reach_.resize(clusters.size() * (most_ + 1));
    for_each_piece_by_worker(execution_, clusters.size(), 1, [&](std::size_t worker, std::size_t c, std::size_t) {
      auto& powers = work_[worker].numbers;
      powers.resize(std::max(powers.size(), 2 * clusters[c].count()));
      double* const ratio = powers.data();
      double* const power = ratio + clusters[c].count();
      const double total = measure(clusters[c], ratio, power);
      for (std::size_t p = 0; p <= most_; ++p) {
        double moment = 0.0;
        for (std::size_t i = 0; i < clusters[c].count(); ++i) {
          power[i] *= ratio[i];
          moment += power[i];
        }
        const double a = clusters[c].radius;
        reach_[c * (most_ + 1) + p] = total > 0.0 ? a * reach(p, moment / total, 1.0) : a;
      }
    });
    reach_known_[gradient ? 1 : 0] = true;
  }
  /// ratio := |y| / a, power := |q|. \return their sum
  double measure(const detail::Cluster<D>& cluster, double* ratio, double* power) const {
    const Vec<D> centre = cluster.box.centre();
    const double scale = 1.0 / cluster.unit();
    double total = 0.0;
    for (std::size_t i = 0; i < cluster.count(); ++i) {
      double square = 0.0;
      for (int d = 0; d < D; ++d) {
        const double away = sources_.coordinate(d)[cluster.begin + i] - centre[d];
        square += away * away;
      }
      ratio[i] = scale * std::sqrt(square);
      power[i] = std::abs(strength_[cluster.begin + i]);
      total += power[i];
    }
    return total;
  }

  /// The clusters that together are all sources, and how each acts on a batch.
  template <bool Gradient>
  void list(std::size_t b, std::vector<std::uint32_t>& stack) {
    auto& entries = lists_[b];
    entries.clear();
    stack.clear();
    const auto& clusters = sources_.clusters();
    if (clusters[0].count() > 0) stack.push_back(0);
    const Box<D>& box = targets_.clusters()[targets_.leaves()[b]].box;
    while (!stack.empty()) {
      const std::uint32_t c = stack.back();
      stack.pop_back();
      const double distance = detail::distance(box, clusters[c].box.centre());
      const double* const reach = reach_.data() + c * (most_ + 1);
      std::uint32_t order = near;
      if (distance > reach[most_]) {
        order = 0;
        while (distance <= reach[order]) ++order;
      }
      const auto count = static_cast<double>(clusters[c].count());
      if (order != near && Expansion::template cost<Gradient>(order) < count) {
        entries.push_back({c, order});
      } else if (order != near || clusters[c].child == 0) {
        entries.push_back({c, near});
      } else {
        stack.push_back(static_cast<std::uint32_t>(clusters[c].child) + 1);
        stack.push_back(static_cast<std::uint32_t>(clusters[c].child));
      }
    }
  }

  /// Moments of the clusters that are on a list, up to the highest order that is asked for.
  void find_moments() {
    const auto& clusters = sources_.clusters();
    first_.assign(clusters.size() + 1, 0);
    counted_ = {};
    for (std::size_t b = 0; b < targets_.leaves().size(); ++b) {
      const std::size_t count = targets_.clusters()[targets_.leaves()[b]].count();
      for (const Entry& entry : lists_[b]) {
        if (entry.order == near) {
          counted_.direct += count * clusters[entry.cluster].count();
          continue;
        }
        counted_.expansions += count;
        counted_.terms += count * Expansion::moments(entry.order);
        first_[entry.cluster + 1] = std::max(first_[entry.cluster + 1], Expansion::moments(entry.order));
      }
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    moments_.resize(std::max(moments_.size(), first_.back()));
    for_each_piece_by_worker(execution_, clusters.size(), 1, [&](std::size_t worker, std::size_t c, std::size_t) {
      if (first_[c + 1] > first_[c]) find_moments(clusters[c], first_[c], first_[c + 1], work_[worker].sums);
    });
  }
  void find_moments(const detail::Cluster<D>& cluster, std::size_t begin, std::size_t end, AlignedVector<Lanes>& sums) {
    const std::size_t count = end - begin;
    std::size_t p = 0;
    while (Expansion::moments(p) < count) ++p;
    sums.assign(count, Lanes(0.0));
    const Vec<D> centre = cluster.box.centre();
    const Lanes scale(1.0 / cluster.unit());
    const auto y = coordinates(sources_);
    for (std::size_t i = cluster.begin; i < cluster.end; i += lanes) {
      auto at = detail::lanes_of<D>(y, i, cluster.end);
      for (std::size_t d = 0; d < D; ++d) at[d] = scale * (at[d] - Lanes(centre[static_cast<int>(d)]));
      alignas(64) std::array<double, lanes> q{};
      for (std::size_t l = 0; l < lanes && i + l < cluster.end; ++l) q[l] = strength_[i + l];
      Expansion::add(at, Lanes::load_aligned(q.data()), p, sums.data());
    }
    for (std::size_t k = 0; k < count; ++k) moments_[begin + k] = sum(sums[k]);
    Expansion::finish(p, moments_.data() + begin);
  }

  static std::array<const double*, D> coordinates(const detail::ClusterTree<D>& tree) {
    std::array<const double*, D> result;
    for (int d = 0; d < D; ++d) result[static_cast<std::size_t>(d)] = tree.coordinate(d).data();
    return result;
  }

  template <bool Gradient>
  void add_batch(std::size_t b, AlignedVector<double>& prepared, std::span<double> potential,
                 Columns<D, double> gradient) {
    const auto& batch = targets_.clusters()[targets_.leaves()[b]];
    const auto x = coordinates(targets_), y = coordinates(sources_);
    std::array<detail::FarSum<D>, most_vectors> sums;
    std::array<std::array<Lanes, D>, most_vectors> target;
    const std::size_t vectors = (batch.count() + lanes - 1) / lanes;
    for (std::size_t v = 0; v < vectors; ++v) target[v] = detail::lanes_of<D>(x, batch.begin + v * lanes, batch.end);
    for (const Entry& entry : lists_[b]) {
      const auto& cluster = sources_.clusters()[entry.cluster];
      if (entry.order != near) {
        prepared.resize(std::max(prepared.size(), Expansion::template prepared<Gradient>(entry.order)));
        Expansion::template prepare<Gradient>(moments_.data() + first_[entry.cluster], entry.order, prepared.data());
      }
      const Vec<D> centre = cluster.box.centre();
      const Lanes scale(1.0 / cluster.unit());
      for (std::size_t v = 0; v < vectors; ++v) {
        if (entry.order == near) {
          detail::add_sources<Gradient, D>(y, strength_.data(), cluster.begin, cluster.end, target[v], sums[v]);
        } else {
          std::array<Lanes, D> at;
          for (std::size_t d = 0; d < D; ++d) at[d] = scale * (target[v][d] - Lanes(centre[static_cast<int>(d)]));
          Expansion::template evaluate<Gradient>(prepared.data(), entry.order, at, cluster.unit(), sums[v]);
        }
      }
    }
    for (std::size_t v = 0; v < vectors; ++v) {
      const std::size_t begin = batch.begin + v * lanes;
      const std::span<const std::size_t> to(targets_.order().data() + begin, std::min(lanes, batch.end - begin));
      detail::put_lanes<D>(sums[v].potential, to, potential);
      for (int d = 0; d < (Gradient ? D : 0); ++d) {
        detail::put_lanes<D>(sums[v].gradient[static_cast<std::size_t>(d)], to, gradient.column(d));
      }
    }
  }

  Params params_;
  E execution_;
  std::size_t most_ = 0;  ///< order
  detail::ClusterTree<D> sources_;
  detail::ClusterTree<D> targets_;
  AlignedVector<double> strength_;         ///< in the order of the tree
  std::vector<double> reach_;              ///< for each cluster and order
  std::array<bool, 2> reach_known_{};      ///< for potentials, for gradients
  std::vector<std::vector<Entry>> lists_;  ///< for each batch
  std::vector<std::size_t> first_;         ///< place of each cluster's moments
  AlignedVector<double> moments_;
  std::vector<Scratch> work_;
  Work counted_;
};

}  // namespace cambium
