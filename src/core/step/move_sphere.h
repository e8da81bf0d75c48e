// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/vec3.h"

namespace cfpm {

/// Moves a sphere over a step dt by the mean force f [N] and torque [N m] of the step (Eqs. 20, 27):
/// v' = v + dt f/m, x' = x + dt (v + v')/2, and the spin omega likewise. Vectors are three numbers in a row.
/// shift: see MeanForce [kg m], null without.
inline void move_sphere(double dt, double mass, double radius, double inertia_factor, const double *f,
                        const double *torque, const double *shift, double *x, double *v, double *omega) {
  const double per_mass = dt / mass;
  const double spin = per_mass / (inertia_factor * radius * radius);
  // all is read before anything is written, which could else be what is read next
  const Vec3 velocity = vec3(v);
  const Vec3 gained = per_mass * vec3(f);
  const Vec3 turning = vec3(omega) + spin * vec3(torque);
  const Vec3 position = vec3(x) + dt * (velocity + 0.5 * gained);
  set(position, x);
  set(velocity + gained, v);
  set(turning, omega);
  if (shift)
    for (int k = 0; k < 3; ++k) x[k] += shift[k] / mass;
}

} // namespace cfpm
