// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include <cambium/core/lattice.hpp>

namespace cambium::detail {

/// Objects of any type, found by their type and lattice; holds one of each type.
class PlanStore {
 public:
  PlanStore() = default;
  PlanStore(PlanStore&&) = default;
  PlanStore& operator=(PlanStore&&) = default;
  /// A copy has buffers of its own, made when they are asked for.
  PlanStore(const PlanStore&) {}
  PlanStore& operator=(const PlanStore&) { return *this; }

  /// The object of this type, made anew if its lattice was another.
  template <class Plan, int D>
  Plan& get(const Lattice<D>& lattice) {
    for (auto& entry : entries_) {
      if (entry.type != &tag<Plan>) continue;
      auto* plan = static_cast<Plan*>(entry.object.get());
      if (!(plan->engine.lattice() == lattice)) {
        entry.object = make<Plan>(lattice);
        plan = static_cast<Plan*>(entry.object.get());
      }
      return *plan;
    }
    entries_.push_back({&tag<Plan>, make<Plan>(lattice)});
    return *static_cast<Plan*>(entries_.back().object.get());
  }

 private:
  template <class>
  static constexpr char tag = 0;
  /// Owner of an object whose type only the deleter knows.
  using Object = std::unique_ptr<void, void (*)(void*)>;
  struct Entry {
    const char* type;
    Object object;
  };
  template <class Plan, int D>
  static Object make(const Lattice<D>& lattice) {
    return Object(new Plan(lattice), [](void* plan) { delete static_cast<Plan*>(plan); });
  }
  std::vector<Entry> entries_;
};

/// Holder of a lattice in the form that PlanStore asks for.
template <int D>
struct OnLattice {
  Lattice<D> on;
  const Lattice<D>& lattice() const { return on; }
};

}  // namespace cambium::detail
