// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_loop.h"

namespace cfpm::liggghts {

void end_separated_contacts(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp) {
  const LAMMPS_NS::NeighList *const histories = pair.listgranhistory;
  if (!histories) return;
  const LAMMPS_NS::NeighList &list = *pair.list;
  const LAMMPS_NS::Atom &atom = *lmp.atom;
  const int spring_offset = pair.contacts().spring_offset();
  for (int ii = 0; ii < list.inum; ++ii) {
    const int i = list.ilist[ii];
    for (int jj = 0; jj < list.numneigh[i]; ++jj) {
      int &flags = histories->firstneigh[i][jj];
      if (!(flags & (models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL))) continue;
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
