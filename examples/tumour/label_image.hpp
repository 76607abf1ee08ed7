// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <cambium/core/vec.hpp>

#include "shape.hpp"

namespace tumour {

/// Labels of voxels, axis 0 fastest, and where they are: the middle of voxel k is origin + sum of k_a axis[a].
struct LabelImage {
  cambium::Index<3> size;
  std::array<cambium::Vec<3>, 3> axis;
  cambium::Vec<3> origin;
  std::vector<int> labels;
};

/// Reads a label image (NRRD, integers, encoding raw or gzip, with `space directions` and `space origin` or
/// `spacings`). \throws cambium::FileError that says which line, or how many bytes, are not as they should be
LabelImage read_nrrd(const std::filesystem::path& path);
/// Reads a label image (VTI; integers at its points or in its cells, the active scalars or the only array) with the VTK
/// library. \throws cambium::FileError that says what is not as it should be
LabelImage read_vti(const std::filesystem::path& path);
/// \throws cambium::FileError if its axes are not finite or lie in one plane, or it has less than two voxels along one
void require_place(const LabelImage& image, const std::filesystem::path& path);
/// One or the other, by the ending of the file's name.
LabelImage read_image(const std::filesystem::path& path);

/// Write one, of labels from 0 to 255. \throws cambium::FileError
void write_nrrd(const std::filesystem::path& path, const LabelImage& image);
void write_vti(const std::filesystem::path& path, const LabelImage& image);
void write_image(const std::filesystem::path& path, const LabelImage& image);

/// The label 1 where a shape is, in voxels of unequal edges and with axes that are not those of space.
LabelImage image_of(const Shape<3>& shape, double half_edge);

/// The region of a label as a smooth shape, its middle at 0 and its lengths times `scale`.
/// \throws cambium::ValueError that names the labels there are, if there is none such
Shape<3> shape_from_image(const LabelImage& image, int label, double scale);

}  // namespace tumour
