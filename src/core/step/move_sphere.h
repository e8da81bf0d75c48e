// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace cfpm {

/// Moves a sphere over a step dt by the mean force f [N] and torque [N m] of the step (Eqs. 20, 27):
/// v' = v + dt f/m, x' = x + dt (v + v')/2, and the spin omega likewise. Vectors are three numbers in a row.
/// shift: see MeanForce [kg m], null without.
inline void move_sphere(double dt, double mass, double radius, double inertia_factor, const double *f,
                        const double *torque, const double *shift, double *x, double *v, double *omega) {
  const double per_mass = dt / mass;
  const double spin = per_mass / (inertia_factor * radius * radius);
  for (int k = 0; k < 3; ++k) {
    const double dv = per_mass * f[k];
    x[k] += dt * (v[k] + 0.5 * dv);
    v[k] += dv;
    omega[k] += spin * torque[k];
  }
  if (shift)
    for (int k = 0; k < 3; ++k) x[k] += shift[k] / mass;
}

} // namespace cfpm
