// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_file.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <cambium/io/npy.hpp>

#include "files.hpp"
#include "mesh_source.hpp"

namespace tumour {
namespace {

using cambium::FileError;
using cambium::TriangleMesh;
using cambium::Vec;

constexpr std::size_t stl_head = 84, stl_facet = 50;

TriangleMesh read_stl(const MeshSource& source) {
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
  if (!loop.empty()) source.refuse("has a loop of vertices without endloop");
  return join(triangles);
}

TriangleMesh read_obj(const MeshSource& source) {
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
  const MeshSource source(path);
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
