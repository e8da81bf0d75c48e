// SPDX-License-Identifier: GPL-2.0-or-later
#include "resist_rolling.h"

#include "core/contact/inertia.h"
#include "core/numbers/vec3.h"

#include <algorithm>
#include <utility>

namespace cfpm::liggghts {

namespace {

using Contact = LIGGGHTS::ContactModels::SurfacesIntersectData;
using Forces = LIGGGHTS::ContactModels::ForceData;

/// Of the spin of i against j, or of i alone at a wall [kg m^2].
double reduced_inertia(int dimension, const Contact &data) {
  const double i = data.mi * data.radi * data.radi;
  const double factor = inertia_factor(dimension);
  if (data.is_wall) return factor * i;
  const double j = data.mj * data.radj * data.radj;
  return factor * i * j / (i + j);
}

/// The host makes a spring against rolling, in epsd2, of the tangential stiffness kt and an effective radius, kt r^2,
/// and moves it explicitly: stable while kt r^2 dt^2 is below 4 times the inertia. A quarter of that leaves room for
/// the other contacts of a sphere; the torque that it reaches is not concerned [N/m].
double stiffest_spring(const Contact &data, double inertia, double dt) {
  const double r = data.is_wall ? data.radi : data.radi * data.radj / (data.radi + data.radj);
  return inertia / (r * r * dt * dt);
}

} // namespace

void resist_rolling(LAMMPS_NS::LAMMPS &lmp, LIGGGHTS::ContactModels::RollingModelBase &model, int id, Contact &data,
                    Forces &i_forces, Forces &j_forces) {
  double &dt = lmp.update->dt;
  const double inertia = reduced_inertia(lmp.domain->dimension, data);
  if (id == LIGGGHTS::ContactModels::ROLLING_CDT) {
    // A torque of given size against the rolling would turn it back and forth for ever: over the step it takes what
    // brings the spins to rest, and no more.
    Forces on_i;
    Forces on_j;
    model.surfacesIntersect(data, on_i, on_j);
    const Vec3 torque = vec3(on_i.delta_torque);
    const Vec3 spin = data.is_wall ? vec3(data.omega_i) : vec3(data.omega_i) - vec3(data.omega_j);
    const double size = dot(torque, torque);
    if (size == 0.0) return;
    const Vec3 taken = std::min(1.0, -dot(spin, torque) * inertia / (dt * size)) * torque;
    add(taken, i_forces.delta_torque);
    if (!data.is_wall) add(-taken, j_forces.delta_torque);
    return;
  }
  // A spring against rolling moves on by a step in every evaluation, and keeps that only where the state is a new one.
  // Where a state is evaluated again, as by "run 0", a step of no duration leaves it where it is. One that was at its
  // limit, without the dashpot, must not be taken to be below it: not by rounding, nor where nothing is left of the
  // limit. A contact that pulls has none: by a negative limit the host would turn the spring round.
  data.kt = std::min(data.kt, stiffest_spring(data, inertia, dt));
  data.Fn = std::max(0.0, data.Fn);
  if (data.shearupdate) return model.surfacesIntersect(data, i_forces, j_forces);
  if (data.Fn == 0.0) return;
  constexpr double rounding = 1e-12;
  data.Fn *= 1.0 - rounding;
  const double step = std::exchange(dt, 0.0);
  model.surfacesIntersect(data, i_forces, j_forces);
  dt = step;
}

} // namespace cfpm::liggghts
