// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm::lammps {

/// Where a rigid wall has come from where it was defined.
class WallPlacement {
public:
  /// It has turned by an angle [rad] about an axis of length 1 through a point, and then been shifted [m].
  WallPlacement(const Vec3 &point, const Vec3 &axis, double angle, const Vec3 &shift)
      : at_rest_(false), point_(point), centre_(point + shift) {
    // the rows of the matrix that turns back are the axes turned, by Rodrigues' formula
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const auto turned = [&](const Vec3 &e) { return c * e + s * cross(axis, e) + (1.0 - c) * dot(axis, e) * axis; };
    rows_[0] = turned({1.0, 0.0, 0.0});
    rows_[1] = turned({0.0, 1.0, 0.0});
    rows_[2] = turned({0.0, 0.0, 1.0});
  }
  explicit WallPlacement(const Vec3 &shift) : WallPlacement({}, {0.0, 0.0, 1.0}, 0.0, shift) {}
  WallPlacement() = default;

  /// The place of the wall as it was defined that is at x now [m].
  Vec3 seen(const Vec3 &x) const {
    if (at_rest_) return x;
    const Vec3 from_centre = x - centre_;
    return point_ + Vec3{dot(rows_[0], from_centre), dot(rows_[1], from_centre), dot(rows_[2], from_centre)};
  }

private:
  bool at_rest_ = true;
  Vec3 point_{}, centre_{};
  Vec3 rows_[3];
};

} // namespace cfpm::lammps
