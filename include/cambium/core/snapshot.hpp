// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include <cambium/core/field.hpp>
#include <cambium/core/sparse.hpp>

namespace cambium {

/// A state that was saved cannot be taken up again: an entry is missing, of another size, or of another lattice.
class SnapshotError : public Error {
 public:
  using Error::Error;
};

/// State of something between two steps: arrays of numbers by their names, as files keep them.
struct Snapshot {
  std::map<std::string, std::vector<double>> reals;        ///< arrays of real numbers
  std::map<std::string, std::vector<std::int64_t>> whole;  ///< arrays of whole numbers

  friend bool operator==(const Snapshot&, const Snapshot&) = default;
};

/// Puts what it is called with into a snapshot, to the last bit. Classes with a state name their members once, in a
/// static visit(self, archive), which saves with a SnapshotWriter and restores with a SnapshotReader.
class SnapshotWriter {
 public:
  explicit SnapshotWriter(Snapshot& snapshot) : snapshot_(snapshot) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const std::string& name, T value) { array<T>(name).assign(1, value); }
  template <class T, class A>
  void operator()(const std::string& name, const std::vector<T, A>& values, std::size_t) {
    array<T>(name).assign(values.begin(), values.end());
  }
  template <class T, int D>
  void operator()(const std::string& name, const Field<T, D, Dense>& field) {
    array<T>(name).assign(field.data(), field.data() + field.size());
  }
  template <class T, int D>
  void operator()(const std::string& name, const Field<T, D, Sparse>& field) {
    auto& values = array<T>(name);
    auto& blocks = snapshot_.whole[name + ".blocks"];
    values.clear();
    blocks.clear();
    for (std::size_t b = 0; b < field.blocks(); ++b) {
      for (int d = 0; d < D; ++d) blocks.push_back(field.block_index(b)[d]);
      values.insert(values.end(), field.block(b).begin(), field.block(b).end());
    }
  }
  template <int D>
  void operator()(const std::string& name, const Lattice<D>& lattice) {
    snapshot_.reals[name] = numbers_of(lattice);
  }
  /// Origin, spacing, nodes and periodic axes, as numbers.
  template <int D>
  static std::vector<double> numbers_of(const Lattice<D>& lattice) {
    std::vector<double> values{static_cast<double>(D), lattice.spacing()};
    for (int d = 0; d < D; ++d) {
      values.insert(values.end(),
                    {lattice.box().lo[d], static_cast<double>(lattice.nodes()[d]), lattice.periodic(d) ? 1.0 : 0.0});
    }
    return values;
  }

 private:
  template <class T>
  auto& array(const std::string& name) {
    if constexpr (std::is_floating_point_v<T>) {
      return snapshot_.reals[name];
    } else {
      return snapshot_.whole[name];
    }
  }

  Snapshot& snapshot_;
};

/// Gives what it is called with the values that a snapshot has. \throws SnapshotError for what does not fit; what was
/// restored before stays so: for objects that are being made
class SnapshotReader {
 public:
  explicit SnapshotReader(const Snapshot& snapshot) : snapshot_(snapshot) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const std::string& name, T& value) { value = static_cast<T>(array<T>(name, 1)[0]); }
  /// \param count  of the values there must be
  template <class T, class A>
  void operator()(const std::string& name, std::vector<T, A>& values, std::size_t count) {
    const auto& saved = array<T>(name, count);
    values.resize(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<T>(saved[i]);
  }
  template <class T, int D>
  void operator()(const std::string& name, Field<T, D, Dense>& field) {
    const auto& saved = array<T>(name, field.size());
    for (std::size_t i = 0; i < field.size(); ++i) field[i] = static_cast<T>(saved[i]);
  }
  template <class T, int D>
  void operator()(const std::string& name, Field<T, D, Sparse>& field) {
    constexpr std::size_t volume = BlockShape<D>::volume;
    const auto& blocks = entry(snapshot_.whole, name + ".blocks");
    const std::size_t count = blocks.size() / D;
    const auto& saved = array<T>(name, count * volume);
    field.clear();
    field.reserve(count);
    for (std::size_t b = 0; b < count; ++b) {
      Index<D> block;
      for (int d = 0; d < D; ++d) {
        block[d] = static_cast<std::ptrdiff_t>(blocks[b * D + static_cast<std::size_t>(d)]);
        if (block[d] < 0 || block[d] >= field.block_grid()[d]) refuse(name, "has a block beyond the lattice");
      }
      if (field.activate(block) != b) refuse(name, "has a block twice");
      for (std::size_t i = 0; i < volume; ++i) field.block(b)[i] = static_cast<T>(saved[b * volume + i]);
    }
  }
  /// \throws SnapshotError unless the lattice saved is this one
  template <int D>
  void operator()(const std::string& name, const Lattice<D>& lattice) {
    if (entry(snapshot_.reals, name) == SnapshotWriter::numbers_of(lattice)) return;
    refuse(name, "is another than the one that it is to go on with: make that of the same box and number of cells");
  }

 private:
  [[noreturn]] static void refuse(const std::string& name, const std::string& why) {
    throw SnapshotError(detail::message("the saved state's '", name, "' ", why));
  }
  template <class Map>
  static const typename Map::mapped_type& entry(const Map& map, const std::string& name) {
    const auto found = map.find(name);
    if (found == map.end()) {
      refuse(name, "is missing: it is that of other policies or parameters, which have to be the same");
    }
    return found->second;
  }
  template <class T>
  const std::vector<std::conditional_t<std::is_floating_point_v<T>, double, std::int64_t>>& array(
      const std::string& name, std::size_t count) {
    const auto& map = [&]() -> const auto& {
      if constexpr (std::is_floating_point_v<T>) {
        return snapshot_.reals;
      } else {
        return snapshot_.whole;
      }
    }
    ();
    const auto& found = entry(map, name);
    if (found.size() != count) {
      refuse(name, detail::message("has ", found.size(), " values where ", count, " are needed: it is not of this"));
    }
    return found;
  }

  const Snapshot& snapshot_;
};

}  // namespace cambium
