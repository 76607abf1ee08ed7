// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "label_image.hpp"

#include <cmath>
#include <set>

#include <cambium/io/npy.hpp>
#include <cambium/levelset/shapes/image.hpp>

namespace tumour {
namespace {

using cambium::Index;
using cambium::Vec;

/// Rows of the matrix that takes a displacement to voxels: the dual basis.
std::array<Vec<3>, 3> dual(const std::array<Vec<3>, 3>& axis) {
  const double volume = dot(axis[0], cross(axis[1], axis[2]));
  return {cross(axis[1], axis[2]) / volume, cross(axis[2], axis[0]) / volume, cross(axis[0], axis[1]) / volume};
}

template <class F>
void for_each_voxel(const Index<3>& size, F&& f) {
  std::size_t i = 0;
  for (std::ptrdiff_t c = 0; c < size[2]; ++c) {
    for (std::ptrdiff_t b = 0; b < size[1]; ++b) {
      for (std::ptrdiff_t a = 0; a < size[0]; ++a) {
        f(i++, Vec<3>{static_cast<double>(a), static_cast<double>(b), static_cast<double>(c)});
      }
    }
  }
}

/// Mean position, in voxels, of those with a label, none of which may be at a face of the image.
Vec<3> middle_of(const LabelImage& image, int label) {
  Vec<3> sum;
  double count = 0.0;
  for_each_voxel(image.size, [&](std::size_t i, const Vec<3>& voxel) {
    if (image.labels[i] != label) return;
    for (int d = 0; d < 3; ++d) {
      if (voxel[d] > 0.0 && voxel[d] < static_cast<double>(image.size[d] - 1)) continue;
      throw cambium::ValueError("label " + std::to_string(label) + " reaches a face of the image across axis " +
                                std::to_string(d) + ": what is cut off there cannot grow; take a larger image");
    }
    sum = sum + voxel;
    count += 1.0;
  });
  if (count > 0.0) return sum / count;
  std::string labels;
  for (const int other : std::set<int>(image.labels.begin(), image.labels.end())) labels += ' ' + std::to_string(other);
  throw cambium::ValueError("the image has no voxel of label " + std::to_string(label) + "; it has:" + labels);
}

}  // namespace

void require_place(const LabelImage& image, const std::filesystem::path& path) {
  const auto& [a, b, c] = image.axis;
  const bool finite = std::isfinite(norm(image.origin)) && std::isfinite(norm(a) * norm(b) * norm(c));
  if (!finite || !(std::abs(dot(a, cross(b, c))) > 1e-9 * norm(a) * norm(b) * norm(c))) {
    throw cambium::FileError(path.string() + ": has axes in one plane, or that are not finite");
  }
  for (int d = 0; d < 3; ++d) {
    if (image.size[d] >= 2) continue;
    throw cambium::FileError(path.string() + ": has less than 2 voxels along axis " + std::to_string(d));
  }
}

LabelImage read_image(const std::filesystem::path& path) {
  return path.extension() == ".vti" ? read_vti(path) : read_nrrd(path);
}
void write_image(const std::filesystem::path& path, const LabelImage& image) {
  path.extension() == ".vti" ? write_vti(path, image) : write_nrrd(path, image);
}

LabelImage image_of(const Shape<3>& shape, double half_edge) {
  LabelImage image;
  const double c = std::cos(0.4), s = std::sin(0.4);
  image.axis = {Vec<3>{0.11 * c, 0.11 * s, 0.0}, Vec<3>{-0.11 * s, 0.11 * c, 0.0}, Vec<3>{0.0, 0.0, 0.17}};
  Vec<3> corner;
  for (int d = 0; d < 3; ++d) {
    const auto steps =
        static_cast<std::ptrdiff_t>(std::ceil(half_edge / norm(image.axis[static_cast<std::size_t>(d)])));
    image.size[d] = 2 * steps + 1;
    corner = corner + static_cast<double>(steps) * image.axis[static_cast<std::size_t>(d)];
  }
  image.origin = -1.0 * corner;
  image.labels.resize(static_cast<std::size_t>(product(image.size)));
  for_each_voxel(image.size, [&](std::size_t i, const Vec<3>& voxel) {
    const Vec<3> x = image.origin + voxel[0] * image.axis[0] + voxel[1] * image.axis[1] + voxel[2] * image.axis[2];
    image.labels[i] = shape(x) < 0.0 ? 1 : 0;
  });
  return image;
}

Shape<3> shape_from_image(const LabelImage& image, int label, double scale) {
  const Vec<3> middle = middle_of(image, label);
  Vec<3> last;
  // A lattice of spacing one whose nodes are the voxels; its box must have equal spacings, which it has.
  for (int d = 0; d < 3; ++d) last[d] = static_cast<double>(image.size[d] - 1);
  const auto lattice = cambium::Lattice<3>::bounded_box({Vec<3>{}, last}, image.size[0] - 1);
  const auto body = cambium::shape_from_labels(lattice, image.labels, label);
  // Values in voxels would slope less along long edges: times the shortest edge they are at most the distance.
  const auto rows = dual(image.axis);
  const double edge = scale * std::min({norm(image.axis[0]), norm(image.axis[1]), norm(image.axis[2])});
  return [body, rows, middle, scale, edge](const Vec<3>& x) {
    const Vec<3> y = x / scale;
    return edge * static_cast<double>(body(middle + Vec<3>{dot(rows[0], y), dot(rows[1], y), dot(rows[2], y)}));
  };
}

}  // namespace tumour
