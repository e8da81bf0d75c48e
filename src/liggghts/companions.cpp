// SPDX-License-Identifier: GPL-2.0-or-later
#include "companions.h"

#include "fix_heat_gran_cfpm.h"
#include "fix_nve_cfpm.h"
#include "fix_wall_gran_cfpm.h"
#include "pair_gran_cfpm.h"

#include "core/deck/companions.h"

#include "fix_insert.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace cfpm::liggghts {

namespace {

bool starts_with(const char *text, const char *prefix) { return std::strncmp(text, prefix, std::strlen(prefix)) == 0; }

std::string name_of(const LAMMPS_NS::Fix &fix) { return std::string("fix ") + fix.style + " (id " + fix.id + ")"; }

/// Integrators that prescribe a motion and read no force may drive particles that nve/cfpm leaves alone.
bool ignores_forces(const LAMMPS_NS::Fix &fix) {
  return std::strcmp(fix.style, "move") == 0 || std::strcmp(fix.style, "nve/noforce") == 0;
}

bool moves_rigid_bodies(const LAMMPS_NS::Fix &fix) {
  return starts_with(fix.style, "rigid") || starts_with(fix.style, "multisphere");
}

/// Also of particles that are yet to be inserted: they join the group of their insertion.
bool share_particles(LAMMPS_NS::LAMMPS &lmp, const LAMMPS_NS::Fix &a, const LAMMPS_NS::Fix &b) {
  constexpr int group_all = 1;
  int shared = 0;
  for (int i = 0; i < lmp.atom->nlocal; ++i)
    if (lmp.atom->mask[i] & a.groupbit && lmp.atom->mask[i] & b.groupbit) shared = 1;
  for (int i = 0; i < lmp.modify->nfix; ++i)
    if (const auto *insertion = dynamic_cast<const LAMMPS_NS::FixInsert *>(lmp.modify->fix[i])) {
      const int mask = group_all | insertion->groupbit;
      if (mask & a.groupbit && mask & b.groupbit) shared = 1;
    }
  int anywhere = 0;
  MPI_Allreduce(&shared, &anywhere, 1, MPI_INT, MPI_MAX, lmp.world);
  return anywhere != 0;
}

[[noreturn]] void fail(LAMMPS_NS::LAMMPS &lmp, const std::string &what) {
  lmp.error->all(FLERR, what.c_str());
  std::abort(); // not reached: error->all ends the process
}

Companion::Role role_of(const LAMMPS_NS::Fix &fix) {
  using Role = Companion::Role;
  if (dynamic_cast<const FixNveCfpm *>(&fix)) return Role::integrator;
  if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(&fix))
    return wall->method().predicted ? Role::predicted_wall : Role::conventional_wall;
  if (dynamic_cast<const LAMMPS_NS::FixWallGran *>(&fix)) return Role::foreign_wall;
  if (starts_with(fix.style, "dt/reset")) return Role::changes_time_step;
  if (moves_rigid_bodies(fix)) return Role::rigid_bodies;
  if (!fix.time_integrate) return Role::other;
  return ignores_forces(fix) ? Role::prescribed_motion : Role::foreign_integrator;
}

/// Whether something holds for the method of the pairs or of a wall.
template <class Holds> bool any_method(LAMMPS_NS::LAMMPS &lmp, const Holds &holds) {
  return holds(static_cast<const PairGranCfpm *>(lmp.force->pair)->method()) ||
         std::any_of(lmp.modify->fix, lmp.modify->fix + lmp.modify->nfix, [&holds](const LAMMPS_NS::Fix *fix) {
           const auto *wall = dynamic_cast<const FixWallGranCfpm *>(fix);
           return wall && holds(wall->method());
         });
}

std::vector<Companion> companions(const LAMMPS_NS::LAMMPS &lmp) {
  const LAMMPS_NS::Modify &modify = *lmp.modify;
  std::vector<Companion> fixes;
  fixes.reserve(static_cast<std::size_t>(modify.nfix));
  for (int k = 0; k < modify.nfix; ++k) fixes.push_back({name_of(*modify.fix[k]), role_of(*modify.fix[k])});
  return fixes;
}

} // namespace

std::string sole_mover(const LAMMPS_NS::LAMMPS &lmp) { return cfpm::sole_mover(companions(lmp)); }

void require_companions(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  if (lmp.force->pair != &pair)
    fail(lmp, "pair_style gran/cfpm: cannot be a sub-style of pair_style " + std::string(lmp.force->pair_style) +
                  "; expected 'pair_style gran/cfpm' alone");
  if (std::strstr(lmp.update->integrate_style, "verlet") == nullptr)
    fail(lmp, std::string("run_style ") + lmp.update->integrate_style +
                  ": a predicted force is the mean over one whole step; expected 'run_style verlet' "
                  "with pair_style gran/cfpm");
  const LAMMPS_NS::Modify &modify = *lmp.modify;
  const std::string wrong =
      wrong_companion(companions(lmp), pair.method().predicted, [&](std::size_t k, std::size_t l) {
        return share_particles(lmp, *modify.fix[k], *modify.fix[l]);
      });
  if (!wrong.empty()) fail(lmp, wrong);
  if (pair.method().predicted && lmp.comm->me == 0)
    for (int k = 0; k < modify.nfix; ++k)
      if (dynamic_cast<const LAMMPS_NS::FixHeatGranCond *>(modify.fix[k]) &&
          !dynamic_cast<const FixHeatGranCfpm *>(modify.fix[k]))
        lmp.error->warning(FLERR,
                           (name_of(*modify.fix[k]) +
                            ": takes contact areas from overlaps that predicted forces enlarge at rest: at 6 steps "
                            "per contact time by up to a third, at 3 by more than half; expected fix " +
                            modify.fix[k]->style + "/cfpm")
                               .c_str());
}

void require_cfpm_pair(LAMMPS_NS::LAMMPS &lmp, const char *command) {
  if (!dynamic_cast<PairGranCfpm *>(lmp.force->pair))
    fail(lmp, std::string(command) + ": needs 'pair_style gran/cfpm', found pair_style " +
                  (lmp.force->pair ? lmp.force->pair_style : "none"));
}

bool any_impulses(LAMMPS_NS::LAMMPS &lmp) {
  return any_method(lmp, [](const Method &method) { return method.wants_crowd; });
}

bool any_onset(LAMMPS_NS::LAMMPS &lmp) {
  const auto &pair = static_cast<const PairGranCfpm &>(*lmp.force->pair);
  return any_method(lmp, [&pair](const Method &method) { return pair.onset_of(method); });
}

} // namespace cfpm::liggghts
