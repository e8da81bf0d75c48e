// SPDX-License-Identifier: GPL-2.0-or-later
// Whether and when two bodies touch within a step: at its beginning or, where contacts begin inside a step, later.
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/numbers/vec3.h"

#include <optional>

namespace cfpm {

/// Two spheres where the contact of a step begins.
struct Meeting {
  Vec3 separation; ///< xi - xj [m]
  double squared;  ///< of its length [m^2]
  double span;     ///< to the end of the step [s]
};

/// Moves spheres that are apart on to where they touch, if they do within the span. velocity: vi - vj [m/s]; reach: ri
/// + rj [m].
inline bool move_to_touch(Meeting &spheres, const Vec3 &velocity, double reach) {
  const double wait = time_to_touch(spheres.separation, velocity, reach, spheres.span);
  if (!(wait < spheres.span)) return false;
  spheres = {spheres.separation + wait * velocity, reach * reach, spheres.span - wait};
  return true;
}

/// The beginning of a contact.
struct Touch {
  ContactGeometry geometry;
  double span; ///< to the end of the step [s]
};

/// How far a sphere of radius 1 is from an edge of a wall when it comes to touch the plane through the nearest point of
/// the wall and has gone aside by a tenth of its radius: sqrt(1 + 0.1^2) - 1. As far as that a wall is taken as flat;
/// what is farther from it by then passes by.
constexpr double gap_of_flat_walls = 0.005;

/// A sphere and a wall, which is flat as far as a step goes. normal: unit vector from the wall to the sphere; distance:
/// of its centre [m]; wall_velocity: where they touch [m/s]; dt: of the step [s].
inline std::optional<Touch> touch_wall(const Vec3 &normal, double distance, double radius, const Motion &sphere,
                                       const Vec3 &wall_velocity, double dt) {
  double span = dt;
  if (distance > radius) {
    const double wait = time_to_touch_plane(normal, sphere.velocity - wall_velocity, distance - radius);
    if (!(wait < dt)) return std::nullopt;
    distance = radius;
    span = dt - wait;
  }
  return Touch{touching_wall(normal, distance, radius, sphere, wall_velocity), span};
}

} // namespace cfpm
