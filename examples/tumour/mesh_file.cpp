// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_file.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <cambium/io/npy.hpp>

#include "files.hpp"

namespace tumour {
namespace {

using cambium::FileError;
using cambium::TriangleMesh;
using cambium::Vec;

/// The bytes of a file, and what is wrong with them.
class Source {
 public:
  explicit Source(const std::filesystem::path& path) : path_(path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) refuse("cannot be read: check that it is there");
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::string& bytes() const { return bytes_; }
  [[noreturn]] void refuse(const std::string& why) const { throw FileError(path_.string() + ": " + why); }
  template <class V>
  V take(std::size_t& at) const {
    if (at + sizeof(V) > bytes_.size()) refuse("ends before all that it announces: is it cut off?");
    V value;
    std::memcpy(&value, bytes_.data() + at, sizeof(V));
    at += sizeof(V);
    return value;
  }
  /// \param polygon  numbers of vertices, cut into triangles that share the first
  void add_polygon(const std::vector<std::ptrdiff_t>& polygon, TriangleMesh& mesh) const {
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

constexpr std::size_t stl_head = 84, stl_facet = 50;

TriangleMesh read_stl(const Source& source) {
  std::vector<Triangle> triangles;
  const std::string& bytes = source.bytes();
  std::size_t at = 80;
  // Binary files may begin with `solid`, too; their length tells.
  if (bytes.size() >= stl_head && bytes.size() == stl_head + stl_facet * source.take<std::uint32_t>(at)) {
    for (at = stl_head; at < bytes.size(); at += 2) {
      at += 12;  // normal
      Triangle corners;
      for (Vec<3>& x : corners) {
        for (int d = 0; d < 3; ++d) x[d] = static_cast<double>(source.take<float>(at));
      }
      triangles.push_back(corners);
    }
    return join(triangles);
  }
  if (bytes.rfind("solid", 0) != 0) source.refuse("is no STL file: its length is not that of its triangles");
  std::istringstream in(bytes);
  std::vector<Vec<3>> loop;
  bool ended = false;
  for (std::string word; in >> word;) {
    if (word == "vertex") {
      Vec<3> x;
      if (!(in >> x[0] >> x[1] >> x[2])) source.refuse("has a vertex without three numbers");
      loop.push_back(x);
    } else if (word == "endloop") {
      if (loop.size() != 3) source.refuse("has a loop of " + std::to_string(loop.size()) + " vertices, not 3");
      triangles.push_back({loop[0], loop[1], loop[2]});
      loop.clear();
    }
    ended = word == "endsolid" || (ended && word != "facet");
  }
  if (!ended) source.refuse("has no endsolid: is it cut off?");
  return join(triangles);
}

TriangleMesh read_obj(const Source& source) {
  TriangleMesh mesh;
  std::istringstream in(source.bytes());
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "v") {
      Vec<3> x;
      if (!(words >> x[0] >> x[1] >> x[2])) source.refuse("line '" + line + "' has not three numbers");
      mesh.vertices.push_back(x);
    } else if (word == "f") {
      std::vector<std::ptrdiff_t> polygon;
      while (words >> word) {
        const long k = std::strtol(word.c_str(), nullptr, 10);  // up to a slash
        if (k == 0) source.refuse("line '" + line + "': vertices are counted from 1, or from the last by -1");
        polygon.push_back(k > 0 ? k - 1 : k + static_cast<std::ptrdiff_t>(mesh.vertices.size()));
      }
      source.add_polygon(polygon, mesh);
    }
  }
  return mesh;
}

/// Numbers of a PLY file, as text or bytes, by the name of their type.
class PlyNumbers {
 public:
  PlyNumbers(const Source& source, std::size_t at, bool text)
      : source_(source), text_(text), at_(at), in_(text ? source.bytes().substr(at) : std::string()) {}

  double next(const std::string& type) {
    if (text_) {
      double value = 0.0;
      if (!(in_ >> value)) source_.refuse("ends before all that it announces: is it cut off?");
      return value;
    }
    if (type == "char" || type == "int8") return source_.take<std::int8_t>(at_);
    if (type == "uchar" || type == "uint8") return source_.take<std::uint8_t>(at_);
    if (type == "short" || type == "int16") return source_.take<std::int16_t>(at_);
    if (type == "ushort" || type == "uint16") return source_.take<std::uint16_t>(at_);
    if (type == "int" || type == "int32") return source_.take<std::int32_t>(at_);
    if (type == "uint" || type == "uint32") return source_.take<std::uint32_t>(at_);
    if (type == "float" || type == "float32") return static_cast<double>(source_.take<float>(at_));
    if (type == "double" || type == "float64") return source_.take<double>(at_);
    source_.refuse("has values of the unknown type '" + type + "'");
  }

 private:
  const Source& source_;
  bool text_;
  std::size_t at_;
  std::istringstream in_;
};

struct PlyProperty {
  std::string name, type, count_type;  ///< the last is empty but for lists
};
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

/// \param format  of what follows \return elements, and where they begin
std::vector<PlyElement> read_ply_head(const Source& source, std::string& format, std::size_t& begin) {
  std::istringstream in(source.bytes());
  std::vector<PlyElement> elements;
  std::string line;
  if (!std::getline(in, line) || line.rfind("ply", 0) != 0) source.refuse("is no PLY file: it does not begin with ply");
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "format") words >> format;
    if (word == "element") words >> elements.emplace_back().name >> elements.back().count;
    if (word == "property" && !elements.empty()) {
      PlyProperty property;
      words >> property.type;
      if (property.type == "list") words >> property.count_type >> property.type;
      words >> property.name;
      elements.back().properties.push_back(property);
    }
    if (words.fail()) source.refuse("line '" + line + "' has not all that it should have");
    if (word != "end_header") continue;
    if (format != "ascii" && format != "binary_little_endian") {
      source.refuse("has format '" + format + "': save it as ascii or binary_little_endian");
    }
    if (in.eof()) source.refuse("ends with its header: is it cut off?");
    begin = static_cast<std::size_t>(in.tellg());
    return elements;
  }
  source.refuse("has no end_header: is it cut off?");
}

TriangleMesh read_ply(const Source& source) {
  std::string format;
  std::size_t begin = 0;
  const auto elements = read_ply_head(source, format, begin);
  PlyNumbers numbers(source, begin, format == "ascii");
  TriangleMesh mesh;
  for (const PlyElement& element : elements) {
    // What takes no bytes would have no end.
    if (element.properties.empty() && element.count > 0) source.refuse("has elements without properties");
    for (std::size_t k = 0; k < element.count; ++k) {
      Vec<3> x = Vec<3>::constant(std::nan(""));
      std::vector<std::ptrdiff_t> polygon;
      for (const PlyProperty& property : element.properties) {
        const double count = property.count_type.empty() ? 1.0 : numbers.next(property.count_type);
        for (double i = 0.0; i < count; ++i) {
          const double value = numbers.next(property.type);
          const std::size_t axis = std::string("xyz").find(property.name);
          if (property.name.size() == 1 && axis < 3) x[static_cast<int>(axis)] = value;
          if (property.name.rfind("vertex_ind", 0) != 0) continue;
          if (!(value >= 0.0 && value < 1e15)) source.refuse("has a face with a vertex that is no number of one");
          polygon.push_back(static_cast<std::ptrdiff_t>(value));
        }
      }
      if (element.name == "vertex") mesh.vertices.push_back(x);
      if (element.name == "face") source.add_polygon(polygon, mesh);
    }
  }
  return mesh;
}

template <class V>
void put(std::string& bytes, V value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
std::string stl_of(const TriangleMesh& mesh) {
  std::string bytes(stl_head - 4, ' ');
  put(bytes, static_cast<std::uint32_t>(mesh.facets.size()));
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const Vec<3> normal = facet_normal(mesh, f);
    for (int d = 0; d < 3; ++d) put(bytes, static_cast<float>(normal[d] / norm(normal)));
    for (const auto v : mesh.facets[f]) {
      for (int d = 0; d < 3; ++d) put(bytes, static_cast<float>(mesh.vertices[v][d]));
    }
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}
std::string obj_of(const TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(17);
  for (const auto& x : mesh.vertices) out << "v " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
  for (const auto& f : mesh.facets) out << "f " << f[0] + 1 << ' ' << f[1] + 1 << ' ' << f[2] + 1 << '\n';
  return out.str();
}
std::string ply_of(const TriangleMesh& mesh) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(mesh.facets.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& x : mesh.vertices) {
    for (int d = 0; d < 3; ++d) put(bytes, x[d]);
  }
  for (const auto& f : mesh.facets) {
    put(bytes, std::uint8_t{3});
    for (const auto v : f) put(bytes, static_cast<std::int32_t>(v));
  }
  return bytes;
}

}  // namespace

TriangleMesh join(const std::vector<Triangle>& triangles) {
  TriangleMesh mesh;
  std::map<std::array<double, 3>, std::size_t> numbers;
  for (const Triangle& triangle : triangles) {
    TriangleMesh::Facet facet;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec<3>& x = triangle[k];
      const auto [at, is_new] = numbers.try_emplace({x[0], x[1], x[2]}, mesh.vertices.size());
      if (is_new) mesh.vertices.push_back(x);
      facet[k] = at->second;
    }
    if (facet[0] != facet[1] && facet[1] != facet[2] && facet[2] != facet[0]) mesh.facets.push_back(facet);
  }
  return mesh;
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  const Source source(path);
  const auto ending = path.extension();
  TriangleMesh mesh = ending == ".stl" ? read_stl(source) : ending == ".obj" ? read_obj(source) : read_ply(source);
  for (const auto& x : mesh.vertices) {
    for (int d = 0; d < 3; ++d) {
      if (!std::isfinite(x[d])) source.refuse("has a vertex without a finite place");
    }
  }
  if (mesh.facets.empty()) source.refuse("has no triangle");
  return mesh;
}

bool is_mesh(const std::filesystem::path& path) {
  const auto ending = path.extension();
  return ending == ".stl" || ending == ".obj" || ending == ".ply";
}

void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh) {
  if (!is_mesh(path)) throw FileError(path.string() + ": meshes are written as .stl, .obj or .ply");
  const auto ending = path.extension();
  write_whole(path, ending == ".stl" ? stl_of(mesh) : ending == ".obj" ? obj_of(mesh) : ply_of(mesh));
}

}  // namespace tumour
