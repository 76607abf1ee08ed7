// SPDX-FileCopyrightText: The Cambium authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include <cambium/levelset/shapes/shape.hpp>

namespace cambium {

/// A disk with a slot from below (Zalesak 1979): the exact signed distance.
class ZalesakDisk {
 public:
  static constexpr int dimension = 2;
  static constexpr double lipschitz = 1.0;

  /// \param width   of the slot
  /// \param length  of the slot, from the lowest point of the full disk to the end of the slot
  /// \throws ValueError unless the slot ends inside the disk and above the corners of its mouth
  ZalesakDisk(const Vec<2>& centre, double radius, double width, double length)
      : centre_(detail::finite(centre, "centre of the disk")),
        radius_(detail::positive_length(radius, "radius of the disk")),
        half_(0.5 * detail::positive_length(width, "width of the slot")),
        top_(detail::positive_length(length, "length of the slot") - radius),
        mouth_(-std::sqrt(std::fmax(radius * radius - half_ * half_, 0.0))) {
    if (!(half_ < radius && top_ > mouth_ && half_ * half_ + top_ * top_ < radius * radius)) {
      throw ValueError(detail::message("a slot of width ", width, " and length ", length,
                                       " does not end inside a disk of radius ", radius));
    }
  }

  /// The right half of the disk: the arc, a side of the slot and half of its end.
  double operator()(const Vec<2>& x) const {
    const double right = std::abs(x[0] - centre_[0]);
    const double up = x[1] - centre_[1];
    const double from_centre = std::hypot(right, up);
    double distance = std::hypot(right - half_, up - std::clamp(up, mouth_, top_));
    distance = std::min(distance, std::hypot(right - std::min(right, half_), up - top_));
    const bool faces_arc = right * mouth_ <= up * half_;
    if (faces_arc) distance = std::min(distance, std::abs(from_centre - radius_));
    const bool inside = from_centre < radius_ && !(right < half_ && up < top_);
    return inside ? -distance : distance;
  }
  Box<2> bounds() const { return detail::box_around(centre_, Vec<2>::constant(radius_)); }

 private:
  Vec<2> centre_;
  double radius_;
  double half_;
  double top_;
  double mouth_;
};

}  // namespace cambium
