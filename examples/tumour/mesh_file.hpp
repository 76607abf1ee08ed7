// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include <cambium/levelset/shapes/surface_mesh.hpp>

#include "shape.hpp"

namespace tumour {

using Triangle = std::array<cambium::Vec<3>, 3>;

/// Corners at the same place, to the last bit, become one vertex; triangles without area by that are left out.
cambium::TriangleMesh join(const std::vector<Triangle>& triangles);

/// Reads a triangle mesh by the ending of its name: .stl (text or binary, see join()), .obj (polygons are cut into
/// triangles) or .ply (text or binary of little endian). \throws cambium::FileError that says what is not as it should
/// be
cambium::TriangleMesh read_mesh(const std::filesystem::path& path);
/// Whether a name ends as those of meshes do.
bool is_mesh(const std::filesystem::path& path);
/// Writes one, of the kind that the ending says; STL and PLY are binary. \throws cambium::FileError
void write_mesh(const std::filesystem::path& path, const cambium::TriangleMesh& mesh);

/// Surface of a shape in a box around 0, with so many cells along a side.
cambium::TriangleMesh mesh_of(const Shape<3>& shape, double box, int cells);

/// The body that a mesh bounds, the middle of its volume at 0 and its lengths times `scale`.
/// \throws cambium::MeshError if it is not closed, see MeshShape
Shape<3> shape_from_mesh(const cambium::TriangleMesh& mesh, double scale);

}  // namespace tumour
