// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include <cambium/core/aligned.hpp>
#include <cambium/core/columns.hpp>
#include <cambium/core/error.hpp>

namespace cambium {

/// Handle of a particle attribute of value type V (float, double, or a Vec of them); made by Particles::add().
template <class V>
struct Attribute {
  std::size_t id = 0;
};

/// Particles in D dimensions as a structure of arrays: D position arrays of type T and any number of named attributes.
///
///     cambium::Particles<2> particles(1000);
///     auto mass = particles.add<double>("mass", 1.0);
///     auto velocity = particles.add<cambium::Vec<2>>("velocity");
///     particles[mass][7] = 2.0;                       // std::span<double>
///     particles[velocity].set(7, {1.0, 0.0});         // Columns<2, double>
///     particles.positions().add(7, particles[velocity][7] * dt);
template <int D, class T = double>
class Particles {
 public:
  using Scalar = T;
  static constexpr int dimension = D;

  /// What `particles[attribute]` is: a span for scalars, Columns for vectors.
  template <class V>
  using View = std::conditional_t<is_vec<V>, Columns<Components<V>::count, ScalarOf<V>>, std::span<V>>;
  template <class V>
  using ConstView = std::conditional_t<is_vec<V>, Columns<Components<V>::count, const ScalarOf<V>>, std::span<const V>>;

  Particles() = default;
  /// `count` particles at the origin.
  explicit Particles(std::size_t count) { resize(count); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// Changes the number of particles; new ones are at the origin and carry each attribute's initial value.
  void resize(std::size_t count) {
    for (auto& axis : position_) axis.resize(count, T(0));
    for (auto& entry : entries_) {
      for (std::size_t c = 0; c < entry.column.size(); ++c) {
        std::visit([&](auto& array) { array.resize(count, entry.initial_value(c, array)); }, entry.column[c]);
      }
    }
    size_ = count;
  }

  /// Adds an attribute with the given initial value for present and future particles.
  /// \throws AttributeError if the name is taken
  template <class V>
  Attribute<V> add(std::string_view name, const V& initial = V{}) {
    static_assert(std::is_floating_point_v<ScalarOf<V>>,
                  "cambium::Particles: an attribute is a float, a double, or a Vec of them");
    if (has(name)) {
      throw AttributeError(detail::message("particles have an attribute \"", name, "\" already: choose another name"));
    }
    Entry entry{std::string(name), {}, {}};
    for (int c = 0; c < Components<V>::count; ++c) {
      entry.initial.push_back(static_cast<double>(component(initial, c)));
      entry.column.emplace_back(AlignedVector<ScalarOf<V>>(size_, component(initial, c)));
    }
    entries_.push_back(std::move(entry));
    return {entries_.size() - 1};
  }

  /// Adds `count` particles after the present ones, as resize() does. \return the number of the first of them
  std::size_t append(std::size_t count) {
    const std::size_t first = size_;
    resize(size_ + count);
    return first;
  }

  /// Adds copies of the particles of `other` after the present ones, positions and every attribute.
  /// \throws AttributeError unless both have attributes of the same names and types; the order may differ
  void append(const Particles& other) {
    const std::vector<std::size_t> source = match(other);
    const std::size_t first = append(other.size());
    const std::size_t count = size_ - first;  // that of `other` before, which may be this very object
    const auto copy = [&](const auto& from, auto& to) { std::copy_n(from.begin(), count, to.begin() + first); };
    for (int d = 0; d < D; ++d) copy(other.position_[d], position_[d]);
    for (std::size_t id = 0; id < entries_.size(); ++id) {
      for (std::size_t c = 0; c < entries_[id].column.size(); ++c) {
        const Column& from = other.entries_[source[id]].column[c];
        std::visit([&](auto& to) { copy(std::get<std::remove_reference_t<decltype(to)>>(from), to); },
                   entries_[id].column[c]);
      }
    }
  }

  /// Keeps the particles p for which predicate(p) is true, in their order, and removes the others. The predicate is
  /// asked for every particle before anything is moved, so it may read the particles; if it throws, they are unchanged.
  /// \return the number of particles removed
  template <class Predicate>
  std::size_t keep_if(Predicate&& predicate) {
    std::vector<std::size_t> kept;
    kept.reserve(size_);
    for (std::size_t p = 0; p < size_; ++p) {
      if (predicate(p)) kept.push_back(p);
    }
    const std::size_t removed = size_ - kept.size();
    if (removed == 0) return 0;
    for_each_array([&](auto& array) {
      for (std::size_t k = 0; k < kept.size(); ++k) array[k] = array[kept[k]];
      array.resize(kept.size());
    });
    size_ = kept.size();
    return removed;
  }

  bool has(std::string_view name) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.name == name; });
  }

  /// Handle of the attribute called `name`. \throws AttributeError if there is none, or none of type V
  template <class V>
  Attribute<V> attribute(std::string_view name) const {
    for (std::size_t id = 0; id < entries_.size(); ++id) {
      if (entries_[id].name != name) continue;
      if (!holds<V>(entries_[id])) {
        throw AttributeError(detail::message("attribute \"", name, "\" has ", entries_[id].column.size(),
                                             " component(s) of another type than asked for"));
      }
      return {id};
    }
    throw AttributeError(detail::message("particles have no attribute \"", name, "\": add<V>(name) makes one"));
  }

  /// Names of all attributes in the order of their making.
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : entries_) result.push_back(entry.name);
    return result;
  }

  Columns<D, T> positions() {
    std::array<T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = position_[d].data();
    return {first, size_};
  }
  Columns<D, const T> positions() const {
    std::array<const T*, D> first;
    for (int d = 0; d < D; ++d) first[d] = position_[d].data();
    return {first, size_};
  }

  template <class V>
  View<V> operator[](Attribute<V> attribute) {
    return view<View<V>, V>(*this, attribute);
  }
  template <class V>
  ConstView<V> operator[](Attribute<V> attribute) const {
    return view<ConstView<V>, V>(*this, attribute);
  }

  /// Calls f(array) for every array of the particles: D positions, then each component of each attribute. The arrays
  /// are AlignedVector<float> or AlignedVector<double> of length size().
  template <class F>
  void for_each_array(F&& f) {
    for (auto& axis : position_) f(axis);
    for (auto& entry : entries_) {
      for (auto& column : entry.column) std::visit(f, column);
    }
  }

 private:
  using Column = std::variant<AlignedVector<float>, AlignedVector<double>>;
  struct Entry {
    std::string name;
    std::vector<double> initial;
    std::vector<Column> column;

    template <class Array>
    typename Array::value_type initial_value(std::size_t c, const Array&) const {
      return static_cast<typename Array::value_type>(initial[c]);
    }
  };

  /// For each attribute the number of the one of `other` with the same name, type and number of components.
  std::vector<std::size_t> match(const Particles& other) const {
    std::vector<std::size_t> result;
    for (const Entry& entry : entries_) {
      const auto found = std::find_if(other.entries_.begin(), other.entries_.end(), [&](const Entry& e) {
        return e.name == entry.name && e.column.size() == entry.column.size() &&
               e.column[0].index() == entry.column[0].index();
      });
      if (found == other.entries_.end()) {
        throw AttributeError(detail::message("particles to append have no attribute \"", entry.name, "\" of ",
                                             entry.column.size(), " component(s) of the same type: add it to them"));
      }
      result.push_back(static_cast<std::size_t>(found - other.entries_.begin()));
    }
    for (const Entry& entry : other.entries_) {
      if (!has(entry.name)) {
        throw AttributeError(detail::message("particles to append have an attribute \"", entry.name,
                                             "\" that these have not: add it to these first"));
      }
    }
    return result;
  }

  template <class V>
  static bool holds(const Entry& entry) {
    return entry.column.size() == static_cast<std::size_t>(Components<V>::count) &&
           std::holds_alternative<AlignedVector<ScalarOf<V>>>(entry.column[0]);
  }

  template <class Result, class V, class Self>
  static Result view(Self& self, Attribute<V> attribute) {
    if (attribute.id >= self.entries_.size() || !holds<V>(self.entries_[attribute.id])) {
      throw AttributeError("attribute handle belongs to other particles: use the one that add() or attribute() gave");
    }
    auto& column = self.entries_[attribute.id].column;
    auto data = [&](int c) { return std::get<AlignedVector<ScalarOf<V>>>(column[static_cast<std::size_t>(c)]).data(); };
    if constexpr (is_vec<V>) {
      std::array<decltype(data(0)), Components<V>::count> first;
      for (int c = 0; c < Components<V>::count; ++c) first[c] = data(c);
      return {first, self.size_};
    } else {
      return {data(0), self.size_};
    }
  }

  std::size_t size_ = 0;
  std::array<AlignedVector<T>, D> position_;
  std::vector<Entry> entries_;
};

}  // namespace cambium
