// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_loop.h"

#include "mean_friction.h"
#include "pair_gran_cfpm.h"

#include <cmath>
#include <cstddef>

namespace cfpm::liggghts {

namespace {

double reduced_mass(double mi, double mj, bool i_frozen, bool j_frozen) {
  if (j_frozen) return mi;
  return i_frozen ? mj : mi * mj / (mi + mj);
}

template <int Tangential> void add_forces(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp) {
  constexpr bool has_spring = Tangential == models::TANGENTIAL_HISTORY;
  LawSource &laws = pair.law_source();
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
  const bool advance = pair.shearupdate() != 0;
  const LAMMPS_NS::NeighList &list = *pair.list;
  const LAMMPS_NS::NeighList *const histories = pair.listgranhistory;
  const int history_size = pair.dnum();
  const int spring_offset = laws.spring_offset();

  // most contacts are of the kind of the one before
  ContactPartners kind{};
  const ContactStep *contact = nullptr;

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
        if (flags && flags[jj]) {
          flags[jj] = 0;
          if constexpr (has_spring) spring[0] = spring[1] = spring[2] = 0.0;
        }
        continue;
      }

      if (flags) flags[jj] |= models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL;
      const double mass = reduced_mass(rmass[i], rmass[j], (mask[i] & frozen) != 0, (mask[j] & frozen) != 0);
      const ContactPartners partners{type[i], type[j], radius[i], radius[j], mass};
      if (!contact || !(partners == kind)) {
        kind = partners;
        contact = &laws.step(kind);
      }
      const ContactGeometry geometry = touching_spheres(separation, std::sqrt(squared), radius[i], radius[j], motion_i,
                                                        {vec3(v[j]), vec3(omega[j])});
      const NormalAction normal = predict_normal(*contact, geometry);
      const Vec3 friction =
          mean_friction<Tangential>(*contact, geometry, spring, advance, normal.force, normal.predicted);
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

} // namespace

void add_predicted_pair_forces(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp) {
  switch (pair.law_source().tangential_model()) {
  case models::TANGENTIAL_HISTORY:
    return add_forces<models::TANGENTIAL_HISTORY>(pair, lmp);
  case models::TANGENTIAL_NO_HISTORY:
    return add_forces<models::TANGENTIAL_NO_HISTORY>(pair, lmp);
  default:
    return add_forces<models::TANGENTIAL_OFF>(pair, lmp);
  }
}

} // namespace cfpm::liggghts
