// SPDX-License-Identifier: GPL-2.0-or-later
// Two spheres that touch, for the forces of one instant, and the spring that their contact keeps.
#pragma once

#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm::testing {

/// Of one contact, as StoredSprings are of a pack.
struct OneSpring {
  Vec3 *stored;
  Vec3 load() const { return *stored; }
  void store(const Vec3 &spring) const { *stored = spring; }
};

constexpr double dt = 1e-5;       // [s]
constexpr double overlap = 1e-4;  // [m]
constexpr double closing = 0.25;  // [m/s]
constexpr double radius_i = 0.01; // [m]
constexpr double radius_j = 0.006;
constexpr double distance = radius_i + radius_j - overlap;
constexpr double reduced_radius = radius_i * radius_j / (radius_i + radius_j);
inline const double area_radius = std::sqrt(overlap * reduced_radius);

// A force is the result of some twenty operations, each with a rounding of half an eps, on terms of its size. The
// overlap is a difference of lengths that are 160 times as large.
constexpr double eps = 2.3e-16;
constexpr double rounding = 200.0 * eps;

} // namespace cfpm::testing
