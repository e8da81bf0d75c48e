// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_loop.h"

#include "mean_friction.h"
#include "pair_gran_cfpm.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cfpm::liggghts {

namespace {

double reduced_mass(double mi, double mj, bool i_frozen, bool j_frozen) {
  if (j_frozen) return mi;
  return i_frozen ? mj : mi * mj / (mi + mj);
}

constexpr int in_contact = models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL;

void end_contact(int &flags, double *spring) {
  flags &= ~in_contact;
  if (spring) std::fill_n(spring, 3, 0.0);
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
  StoredSpring stored{nullptr, laws.spring_step(), pair.shearupdate() != 0};
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
        if (flags && flags[jj]) end_contact(flags[jj], spring);
        continue;
      }

      if (flags) flags[jj] |= in_contact;
      const double mass = reduced_mass(rmass[i], rmass[j], (mask[i] & frozen) != 0, (mask[j] & frozen) != 0);
      const ContactPartners partners{type[i], type[j], radius[i], radius[j], mass};
      if (!contact || !(partners == kind)) {
        kind = partners;
        contact = &laws.step(kind);
      }
      const ContactGeometry geometry = touching_spheres(separation, std::sqrt(squared), radius[i], radius[j], motion_i,
                                                        {vec3(v[j]), vec3(omega[j])});
      const NormalAction normal = predict_normal(*contact, geometry);
      stored.values = spring;
      const Vec3 friction = mean_friction<Tangential>(*contact, geometry, stored, normal.force, normal.predicted);
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

void end_separated_contacts(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp) {
  const LAMMPS_NS::NeighList *const histories = pair.listgranhistory;
  if (!histories) return;
  const LAMMPS_NS::NeighList &list = *pair.list;
  const LAMMPS_NS::Atom &atom = *lmp.atom;
  const int spring_offset = pair.law_source().spring_offset();
  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii];
    for (int jj = 0; jj < list.numneigh[i]; ++jj) {
      int &flags = histories->firstneigh[i][jj];
      if (!(flags & in_contact)) continue;
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      const Vec3 separation = vec3(atom.x[i]) - vec3(atom.x[j]);
      const double touching = atom.radius[i] + atom.radius[j];
      if (dot(separation, separation) < touching * touching) continue;
      double *const history = histories->firstdouble[i] + static_cast<std::ptrdiff_t>(jj) * pair.dnum();
      end_contact(flags, spring_offset < 0 ? nullptr : history + spring_offset);
    }
  }
}

} // namespace cfpm::liggghts
