// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "mean_friction.h"
#include "pair_gran_cfpm.h"
#include "prediction.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cfpm::liggghts {

/// Ends the contacts of listed pairs that are apart. The host's own loop does not see them before the
/// next neighbour build, and a pair that meets again by then would find its old spring.
void end_separated_contacts(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp);

inline double reduced_mass(double mi, double mj, bool i_frozen, bool j_frozen) {
  if (j_frozen) return mi;
  return i_frozen ? mj : mi * mj / (mi + mj);
}

/// For the flags and the tangential spring (null without one) in the history of a pair that is apart.
inline void end_contact(int &flags, double *spring) {
  flags &= ~(models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL);
  if (spring) std::fill_n(spring, 3, 0.0);
}

/// Adds the predicted forces of all listed pairs to f and torque, without what the host's own loop
/// carries along for output and for further contact models. Both loops give the same forces to the
/// last bit, so that it does not matter which one a step takes.
/// Tangential: the host's id; kind_of(partners): a reference to the kind of contact, valid until the
/// next call; step_of(kind, overlap, closing speed): its ContactStep.
template <int Tangential, class KindOf, class StepOf> void
add_predicted_pair_forces(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp, const KindOf &kind_of, const StepOf &step_of) {
  constexpr bool has_spring = Tangential == models::TANGENTIAL_HISTORY;
  constexpr int in_contact = models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL;
  LAMMPS_NS::Atom &atom = *lmp.atom;
  double **const x = atom.x;
  double **const v = atom.v;
  double **const omega = atom.omega;
  double **const f = atom.f;
  double **const torque = atom.torque;
  const double *const radius = atom.radius;
  const double *const rmass = atom.rmass;
  const int *const type = atom.type;
  const int *const mask = atom.mask;
  const int frozen = pair.freeze_group_bit();
  const int receiving = lmp.force->newton_pair ? atom.nlocal + atom.nghost : atom.nlocal;
  StoredSpring stored{nullptr, pair.contacts().spring_step(), pair.shearupdate() != 0};
  const LAMMPS_NS::NeighList &list = *pair.list;
  const LAMMPS_NS::NeighList *const histories = pair.listgranhistory;
  const int history_size = pair.dnum();
  const int spring_offset = pair.contacts().spring_offset();

  // most contacts are of the kind of the one before
  ContactPartners last{};
  decltype(&kind_of(last)) kind = nullptr;

  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii];
    const Vec3 xi = vec3(x[i]);
    const Motion motion_i{vec3(v[i]), vec3(omega[i])};
    const int *const neighbors = list.firstneigh[i];
    int *const flags = histories ? histories->firstneigh[i] : nullptr;
    double *const springs = has_spring && histories ? histories->firstdouble[i] + spring_offset : nullptr;

    for (int jj = 0; jj < list.numneigh[i]; ++jj) {
      const int j = neighbors[jj] & NEIGHMASK;
      const Vec3 separation = xi - vec3(x[j]);
      const double squared = dot(separation, separation);
      const double touching = radius[i] + radius[j];
      double *const spring = has_spring ? springs + static_cast<std::ptrdiff_t>(jj) * history_size : nullptr;
      if (squared >= touching * touching) {
        if (flags && flags[jj]) end_contact(flags[jj], spring);
        continue;
      }

      if (flags) flags[jj] |= in_contact;
      const double mass = reduced_mass(rmass[i], rmass[j], (mask[i] & frozen) != 0, (mask[j] & frozen) != 0);
      const ContactPartners partners{type[i], type[j], radius[i], radius[j], mass};
      if (!kind || !(partners == last)) {
        last = partners;
        kind = &kind_of(partners);
      }
      const ContactGeometry geometry = touching_spheres(separation, std::sqrt(squared), radius[i], radius[j], motion_i,
                                                        {vec3(v[j]), vec3(omega[j])});
      const ContactStep contact = step_of(*kind, geometry.overlap, geometry.closing_speed);
      const NormalAction normal = predict_normal(contact, geometry);
      stored.values = spring;
      const Vec3 friction = mean_friction<Tangential>(contact, geometry, stored, normal.force, normal.predicted);
      const Vec3 force = normal.mean() * geometry.normal + friction;
      const Vec3 moment = cross(geometry.normal, friction);
      add(force, f[i]);
      add(-geometry.lever_i * moment, torque[i]);
      if (j >= receiving) continue;
      add(-force, f[j]);
      add(-geometry.lever_j * moment, torque[j]);
    }
  }
}

} // namespace cfpm::liggghts
