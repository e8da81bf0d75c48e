// SPDX-License-Identifier: GPL-2.0-or-later
#include "setup_facts.h"

#include "host_versions.h"

#include "core/deck/facts.h"
#include "core/deck/time_step_report.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace cfpm::lammps {

namespace {

/// The header of fix gravity is in no package, so it is asked for the force that it adds to the first particle of its
/// group that has a mass. Forces stay as they are. False where it has no particle. Collective.
bool add_gravity(LAMMPS_NS::LAMMPS &lmp, LAMMPS_NS::Fix &fix, Vec3 &gravity) {
  const LAMMPS_NS::Atom &atom = *lmp.atom;
  std::vector<std::array<double, 3>> kept;
  for (int i = 0; i < atom.nlocal; ++i) {
    kept.push_back({atom.f[i][0], atom.f[i][1], atom.f[i][2]});
    std::fill_n(atom.f[i], 3, 0.0);
  }
  fix.post_force(0);
  constexpr double never = -std::numeric_limits<double>::infinity();
  double found[3] = {never, never, never};
  bool mine = false;
  for (int i = 0; i < atom.nlocal; ++i) {
    if (!mine && (atom.mask[i] & fix.groupbit) && atom.rmass[i] > 0.0) {
      mine = true;
      for (int k = 0; k < 3; ++k) found[k] = atom.f[i][k] / atom.rmass[i];
    }
    std::copy(kept[static_cast<std::size_t>(i)].begin(), kept[static_cast<std::size_t>(i)].end(), atom.f[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, found, 3, MPI_DOUBLE, MPI_MAX, lmp.world);
  if (found[0] == never) return false;
  gravity = gravity + Vec3{found[0], found[1], found[2]};
  return true;
}

} // namespace

void tell_facts(LAMMPS_NS::LAMMPS &lmp, const TimeStepReport &report) {
  const char *const file = facts_file();
  if (!file) return;
  SetupFacts facts;
  facts.host = "lammps";
  facts.units = lmp.update->unit_style;
  facts.particles = static_cast<double>(lmp.atom->natoms);
  facts.box = {lmp.domain->prd[0], lmp.domain->prd[1], lmp.domain->prd[2]};
  double largest = 0.0;
  for (int i = 0; i < lmp.atom->nlocal; ++i)
    largest = std::max(largest, norm(Vec3{lmp.atom->v[i][0], lmp.atom->v[i][1], lmp.atom->v[i][2]}));
  MPI_Allreduce(&largest, &facts.largest_speed, 1, MPI_DOUBLE, MPI_MAX, lmp.world);
  for (LAMMPS_NS::Fix *fix : fixes(*lmp.modify))
    if (std::string(fix->style).rfind("gravity", 0) == 0 && !add_gravity(lmp, *fix, facts.gravity))
      facts.gravity_known = false;
  if (lmp.comm->me == 0 && !add_facts(file, facts, report.facts()))
    lmp.error->one(FLERR, "CFPM_FACTS: cannot write to '" + std::string(file) + "'");
}

} // namespace cfpm::lammps
