// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <cambium/io/npy.hpp>
#include <cambium/levelset/shapes/surface_mesh.hpp>

namespace tumour {

/// The bytes of a file, and what is wrong with them.
class MeshSource {
 public:
  explicit MeshSource(const std::filesystem::path& path) : path_(path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) refuse("cannot be read: check that it is there");
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string& bytes() const { return bytes_; }
  [[noreturn]] void refuse(const std::string& why) const { throw cambium::FileError(path_.string() + ": " + why); }
  template <class V>
  V take(std::size_t& at) const {
    if (at + sizeof(V) > bytes_.size()) refuse("ends before all that it announces: is it cut off?");
    V value;
    std::memcpy(&value, bytes_.data() + at, sizeof(V));
    at += sizeof(V);
    return value;
  }
  /// \param polygon  numbers of vertices, cut into triangles that share the first
  void add_polygon(const std::vector<std::ptrdiff_t>& polygon, cambium::TriangleMesh& mesh) const {
    if (polygon.size() < 3) refuse("has a face of less than three vertices");
    for (const std::ptrdiff_t k : polygon) {
      if (k < 0 || static_cast<std::size_t>(k) >= mesh.vertices.size()) {
        refuse("has a face with vertex " + std::to_string(k) + " of " + std::to_string(mesh.vertices.size()));
      }
    }
    const auto number = [&](std::size_t k) { return static_cast<std::size_t>(polygon[k]); };
    for (std::size_t k = 2; k < polygon.size(); ++k) mesh.facets.push_back({number(0), number(k - 1), number(k)});
  }

 private:
  std::filesystem::path path_;
  std::string bytes_;
};

/// Appends the bytes of a value.
template <class V>
void put(std::string& bytes, V value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// \throws cambium::FileError that says what is not as it should be
cambium::TriangleMesh read_ply(const MeshSource& source);
/// The bytes of a PLY file, binary of little endian.
std::string ply_of(const cambium::TriangleMesh& mesh);

}  // namespace tumour
