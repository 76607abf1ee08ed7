// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include <cambium/core/vec.hpp>

namespace tumour {

/// Where the tumour is at the beginning: negative inside.
template <int D>
using Shape = std::function<double(const cambium::Vec<D>&)>;

std::string shape_help();
/// Reads a shape: ellipsoid:e,r   sqrt((x (1 + e))^2 + y^2 + (z (1 - e))^2) = r, in the plane without y;
///                star:r0,a2,p2,a3,p3,...   r = r0 + sum of a_k cos(k theta - p_k), in the plane;
///                amorphous:inner,outer,seed   a smooth random lump between two radii;
///                pair:r,d   two balls of radius r, their centres d apart;
///                FILE.nrrd,label,scale   a label of an image, in space, see shape_from_image();
///                FILE.stl,scale   (or .ply, .obj) the body that a closed mesh bounds, in space, see shape_from_mesh().
/// \throws cambium::ValueError that says what is wrong with the text; as read_nrrd(), read_mesh()
template <int D>
Shape<D> shape_of(const std::string& text);
extern template Shape<2> shape_of<2>(const std::string&);
extern template Shape<3> shape_of<3>(const std::string&);

/// \throws as shape_of()
void require_shape(const std::string& text, int dim);

}  // namespace tumour
