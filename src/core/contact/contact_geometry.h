// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/vec3.h"

#include <cmath>
#include <limits>

namespace cfpm {

/// How two bodies touch, as the contact law sees it. The normal points from the second to the first. R: double, or a
/// Pack of several contacts' numbers.
template <class R> struct BasicContactGeometry {
  BasicVec3<R> normal;        ///< unit vector
  R overlap;                  ///< d [m]
  R closing_speed;            ///< dd/dt [m/s]
  BasicVec3<R> slip_velocity; ///< of the first against the second at the contact point, in the tangent plane [m/s]
  R lever_i;                  ///< centre of the first to the contact point, the middle of the overlap [m]
  R lever_j;                  ///< the same of the second; 0 at a wall [m]
  BasicVec3<R> normal_rate{}; ///< dn/dt as the centres move on, tangential; left out at a wall, which is flat [1/s]
};

template <class R> struct BasicMotion {
  BasicVec3<R> velocity; ///< [m/s]
  BasicVec3<R> spin;     ///< angular velocity [rad/s]
};

/// Two spheres that touch, as they are found.
template <class R> struct BasicSpherePair {
  BasicVec3<R> separation; ///< xi - xj [m]
  R squared;               ///< of its length, > 0 [m^2]
  R radius_i;              ///< [m]
  R radius_j;              ///< [m]
  BasicMotion<R> i;
  BasicMotion<R> j;
};

using ContactGeometry = BasicContactGeometry<double>;
using Motion = BasicMotion<double>;

/// Two overlapping spheres (Eqs. 3-5, 8, 9). separation = xi - xj [m], distance its length [m], > 0.
/// Inlined by order, as mean_friction().
template <class R> [[gnu::always_inline]] inline BasicContactGeometry<R>
touching_spheres(const BasicVec3<R> &separation, const R &distance, const R &radius_i, const R &radius_j,
                 const BasicMotion<R> &i, const BasicMotion<R> &j) {
  BasicContactGeometry<R> g;
  g.normal = (1.0 / distance) * separation;
  g.overlap = radius_i + radius_j - distance;
  g.lever_i = radius_i - 0.5 * g.overlap;
  g.lever_j = radius_j - 0.5 * g.overlap;
  const BasicVec3<R> relative = i.velocity - j.velocity;
  const R normal_speed = dot(relative, g.normal);
  g.closing_speed = -normal_speed;
  const BasicVec3<R> passing = relative - normal_speed * g.normal;
  g.slip_velocity = passing + cross(g.normal, g.lever_i * i.spin + g.lever_j * j.spin);
  g.normal_rate = (1.0 / distance) * passing;
  return g;
}

template <class R> [[gnu::always_inline]] inline BasicContactGeometry<R> touching_spheres(const BasicSpherePair<R> &p) {
  using std::sqrt;
  return touching_spheres<R>(p.separation, sqrt(p.squared), p.radius_i, p.radius_j, p.i, p.j);
}

/// Whether two spheres may come together within a time that are apart, unless they pass by each other: of most pairs
/// this is known without a root. approach: minus the product of separation and velocity [m^2/s]; gap: the square of
/// their distance less that of their reach [m^2]; within: [s]. R: double, or a Pack of several pairs' numbers.
template <class R>
[[gnu::always_inline]] inline auto may_come_together(const R &approach, const R &gap, double within) {
  return gap < 2.0 * within * approach;
}

/// When two spheres that are apart touch if they keep their velocities; infinite if they do not within that time [s].
/// separation = xi - xj [m], velocity = vi - vj [m/s], reach = ri + rj [m].
inline double time_to_touch(const Vec3 &separation, const Vec3 &velocity, double reach, double within) {
  const double approach = -dot(separation, velocity);
  const double gap = dot(separation, separation) - reach * reach;
  if (!may_come_together(approach, gap, within)) return std::numeric_limits<double>::infinity();
  const double discriminant = approach * approach - dot(velocity, velocity) * gap;
  return discriminant < 0.0 ? std::numeric_limits<double>::infinity() : gap / (approach + std::sqrt(discriminant));
}

/// When a sphere that is apart from a plane by the gap [m] touches it, in the same way. normal: from the plane to it.
inline double time_to_touch_plane(const Vec3 &normal, const Vec3 &velocity, double gap) {
  const double closing_speed = -dot(normal, velocity);
  return closing_speed > 0.0 ? gap / closing_speed : std::numeric_limits<double>::infinity();
}

/// A sphere at a wall. normal: unit vector from the wall to the sphere; distance: of the centre to the
/// wall [m]; wall_velocity: of the wall where they touch [m/s].
inline ContactGeometry touching_wall(const Vec3 &normal, double distance, double radius, const Motion &sphere,
                                     const Vec3 &wall_velocity) {
  ContactGeometry g;
  g.normal = normal;
  g.overlap = radius - distance;
  g.lever_i = radius - 0.5 * g.overlap;
  g.lever_j = 0.0;
  const Vec3 relative = sphere.velocity - wall_velocity;
  const double normal_speed = dot(relative, normal);
  g.closing_speed = -normal_speed;
  g.slip_velocity = relative - normal_speed * normal + cross(normal, g.lever_i * sphere.spin);
  return g;
}

} // namespace cfpm
