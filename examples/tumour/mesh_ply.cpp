// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "mesh_source.hpp"

namespace tumour {
namespace {

using cambium::TriangleMesh;
using cambium::Vec;

/// Numbers of a PLY file, as text or bytes, by the name of their type.
class PlyNumbers {
 public:
  PlyNumbers(const MeshSource& source, std::size_t at, bool text)
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
  const MeshSource& source_;
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
std::vector<PlyElement> read_ply_head(const MeshSource& source, std::string& format, std::size_t& begin) {
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

}  // namespace

TriangleMesh read_ply(const MeshSource& source) {
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

}  // namespace tumour
