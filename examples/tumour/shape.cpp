// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include <cambium/core/error.hpp>
#include <cambium/levelset/shapes/amorphous.hpp>

#include "label_image.hpp"
#include "mesh_file.hpp"
#include "numbers.hpp"

namespace tumour {
namespace {

using cambium::ValueError;
using cambium::Vec;

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw ValueError("--shape " + text + ": " + why + "; " + shape_help());
}

template <int D>
Shape<D> ellipsoid(double e, double r) {
  return [e, r](const Vec<D>& x) {
    double square = 0.0;
    for (int d = 0; d < D; ++d) {
      const double scaled = x[d] * (d == 0 ? 1.0 + e : d == D - 1 ? 1.0 - e : 1.0);
      square += scaled * scaled;
    }
    return std::sqrt(square) - r;
  };
}

double least_radius(const std::vector<double>& v) {
  double least = v[0];
  for (std::size_t k = 1; k < v.size(); k += 2) least -= std::abs(v[k]);
  return least;
}

/// Inside of half the smallest radius the bumps fade to none, so that the function is continuous at 0.
Shape<2> star(const std::vector<double>& v) {
  return [v, least = least_radius(v)](const Vec<2>& x) {
    const double theta = std::atan2(x[1], x[0]), length = norm(x);
    double bumps = 0.0;
    for (std::size_t k = 1; k < v.size(); k += 2) {
      bumps += v[k] * std::cos(0.5 * static_cast<double>(k + 3) * theta - v[k + 1]);
    }
    return length - v[0] - std::min(1.0, 2.0 * length / least) * bumps;
  };
}
template <int D>
Shape<D> pair(double r, double distance) {
  return [r, distance](const Vec<D>& x) {
    const Vec<D> half = Vec<D>::unit(0, 0.5 * distance);
    return std::min(norm(x - half), norm(x + half)) - r;
  };
}

}  // namespace

std::string shape_help() {
  return "one of ellipsoid:e,r | star:r0,a2,p2,a3,p3,... (plane) | amorphous:inner,outer,seed | pair:r,distance | "
         "FILE.nrrd|vti[,label,scale] (label image; 1,1 where nothing is said) | FILE.stl|ply|obj[,scale] (closed "
         "mesh)";
}

namespace {

constexpr std::string_view endings[] = {".nrrd", ".vti", ".stl", ".ply", ".obj"};

/// Where the ending of a file's name ends, npos if there is no file's name.
std::size_t end_of_file_name(const std::string& text) {
  for (const std::string_view ending : endings) {
    const std::size_t at = text.rfind(ending);
    if (at == std::string::npos) continue;
    if (at + ending.size() == text.size() || text[at + ending.size()] == ',') return at + ending.size();
  }
  return std::string::npos;
}

/// FILE.nrrd or FILE.nrrd,label,scale, as VTI; FILE.stl or FILE.stl,scale
template <int D>
Shape<D> shape_from_file(const std::string& text, std::size_t end) {
  if constexpr (D == 2) {
    refuse(text, "images and meshes are shapes of space: --dim 3");
  } else {
    const std::string file = text.substr(0, end);
    const bool image = file.ends_with(endings[0]) || file.ends_with(endings[1]);
    std::vector<double> v(image ? 2 : 1, 1.0);
    if (end < text.size()) v = numbers("--shape", text.substr(end + 1));
    if (!image) {
      if (v.size() != 1 || !(v[0] > 0.0)) refuse(text, "after the name of a mesh a positive scale is read");
      return shape_from_mesh(read_mesh(file), v[0]);
    }
    if (v.size() != 2 || v[0] != std::floor(v[0]) || std::abs(v[0]) > 1e9 || !(v[1] > 0.0)) {
      refuse(text, "after the file's name a whole label and a positive scale are read");
    }
    return shape_from_image(read_image(file), static_cast<int>(v[0]), v[1]);
  }
}

}  // namespace

template <int D>
Shape<D> shape_of(const std::string& text) {
  const std::size_t end = end_of_file_name(text);
  if (end != std::string::npos) return shape_from_file<D>(text, end);
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon == std::string::npos) refuse(text, "a kind of shape and numbers are needed");
  const std::vector<double> v = numbers("--shape " + text, text.substr(colon + 1));
  if (kind == "ellipsoid") {
    if (v.size() != 2 || !(std::abs(v[0]) < 1.0) || !(v[1] > 0.0)) refuse(text, "e must be in (-1, 1), r positive");
    return ellipsoid<D>(v[0], v[1]);
  }
  if (kind == "star") {
    if constexpr (D == 2) {
      if (v.size() % 2 == 0) refuse(text, "every a_k needs its p_k");
      if (!(least_radius(v) > 0.0)) refuse(text, "r0 must be larger than the sum of all |a_k|");
      return star(v);
    } else {
      refuse(text, "stars are shapes of the plane: --dim 2");
    }
  }
  if (kind == "amorphous") {
    if (v.size() != 3 || !(v[2] >= 0.0) || v[2] > 1e15) refuse(text, "two radii and a seed are needed");
    return cambium::Amorphous<D>(Vec<D>{}, v[0], v[1], static_cast<std::uint64_t>(v[2]));
  }
  if (kind != "pair") refuse(text, "there is no kind '" + kind + "'");
  if (v.size() != 2 || !(v[0] > 0.0) || !(v[1] > 2.0 * v[0])) refuse(text, "the distance must be larger than 2 r");
  return pair<D>(v[0], v[1]);
}

template Shape<2> shape_of<2>(const std::string&);
template Shape<3> shape_of<3>(const std::string&);

void require_shape(const std::string& text, int dim) {
  if (dim == 2) {
    shape_of<2>(text);
  } else {
    shape_of<3>(text);
  }
}

}  // namespace tumour
