// SPDX-License-Identifier: GPL-2.0-or-later
#include "setup_facts.h"

#include "host.h"

#include "core/deck/facts.h"
#include "core/deck/time_step_report.h"

#include "fix_gravity.h"

#include <algorithm>
#include <string>

namespace cfpm::liggghts {

void tell_facts(LAMMPS_NS::LAMMPS &lmp, const TimeStepReport &report) {
  const char *const file = facts_file();
  if (!file) return;
  SetupFacts facts;
  facts.host = "liggghts";
  facts.units = lmp.update->unit_style;
  facts.particles = static_cast<double>(lmp.atom->natoms);
  facts.box = {lmp.domain->prd[0], lmp.domain->prd[1], lmp.domain->prd[2]};
  double largest = 0.0;
  for (int i = 0; i < lmp.atom->nlocal; ++i)
    largest = std::max(largest, norm(Vec3{lmp.atom->v[i][0], lmp.atom->v[i][1], lmp.atom->v[i][2]}));
  MPI_Allreduce(&largest, &facts.largest_speed, 1, MPI_DOUBLE, MPI_MAX, lmp.world);
  for (int f = 0; f < lmp.modify->nfix; ++f)
    if (auto *fix = dynamic_cast<LAMMPS_NS::FixGravity *>(lmp.modify->fix[f])) {
      double g[3];
      fix->get_gravity(g);
      facts.gravity = facts.gravity + Vec3{g[0], g[1], g[2]};
    }
  if (lmp.comm->me == 0 && !add_facts(file, facts, report.facts()))
    lmp.error->one(FLERR, ("CFPM_FACTS: cannot write to '" + std::string(file) + "'").c_str());
}

} // namespace cfpm::liggghts
