// SPDX-License-Identifier: GPL-2.0-or-later
#include "companions.h"

#include "fix_nve_cfpm.h"
#include "fix_wall_gran_cfpm.h"
#include "pair_gran_cfpm.h"

#include "fix_insert.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace cfpm::liggghts {

namespace {

bool starts_with(const char *text, const char *prefix) { return std::strncmp(text, prefix, std::strlen(prefix)) == 0; }

std::string name_of(const LAMMPS_NS::Fix &fix) { return std::string("fix ") + fix.style + " (id " + fix.id + ")"; }

/// Integrators that prescribe a motion and read no force may drive particles that nve/cfpm leaves alone.
bool ignores_forces(const LAMMPS_NS::Fix &fix) {
  return std::strcmp(fix.style, "move") == 0 || std::strcmp(fix.style, "nve/noforce") == 0;
}

bool integrates(const LAMMPS_NS::Fix &fix) {
  return fix.time_integrate || starts_with(fix.style, "rigid") || starts_with(fix.style, "multisphere");
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

void require_predicted_companions(LAMMPS_NS::LAMMPS &lmp) {
  const LAMMPS_NS::Modify &modify = *lmp.modify;
  if (std::none_of(modify.fix, modify.fix + modify.nfix,
                   [](LAMMPS_NS::Fix *fix) { return dynamic_cast<FixNveCfpm *>(fix) != nullptr; }))
    fail(lmp, "pair_style gran/cfpm: its step-mean forces need the matching integrator; "
              "expected 'fix ID group nve/cfpm' in place of fix nve/sphere");
  for (int i = 0; i < modify.nfix; ++i) {
    const LAMMPS_NS::Fix &fix = *modify.fix[i];
    if (starts_with(fix.style, "dt/reset"))
      fail(lmp, name_of(fix) + ": changes the time step between a prediction and its use; "
                               "it cannot be used with pair_style gran/cfpm");
    if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(&fix)) {
      if (!wall->predictor())
        fail(lmp, name_of(fix) + ": 'predict none' at a wall beside predicted pairs; use the same for both");
    } else if (dynamic_cast<const LAMMPS_NS::FixWallGran *>(&fix)) {
      fail(lmp, name_of(fix) + ": not predicted, beside pair_style gran/cfpm; expected fix wall/gran/cfpm");
    }
    if (!integrates(fix)) continue;
    if (!dynamic_cast<const FixNveCfpm *>(&fix) && !ignores_forces(fix))
      fail(lmp, name_of(fix) + ": would integrate step-mean forces as forces of one instant; "
                               "expected fix nve/cfpm beside pair_style gran/cfpm");
    for (int j = 0; j < i; ++j)
      if (integrates(*modify.fix[j]) && share_particles(lmp, fix, *modify.fix[j]))
        fail(lmp, name_of(fix) + ": integrates particles that " + name_of(*modify.fix[j]) +
                      " integrates too; expected disjoint groups");
  }
}

void require_unpredicted_companions(LAMMPS_NS::LAMMPS &lmp) {
  const LAMMPS_NS::Modify &modify = *lmp.modify;
  for (int i = 0; i < modify.nfix; ++i) {
    const LAMMPS_NS::Fix &fix = *modify.fix[i];
    if (dynamic_cast<const FixNveCfpm *>(&fix))
      fail(lmp, name_of(fix) + ": needs predicted forces, but the pair style says 'predict none'; "
                               "expected fix nve/sphere");
    const auto *wall = dynamic_cast<const FixWallGranCfpm *>(&fix);
    if (wall && wall->predictor())
      fail(lmp, name_of(fix) + ": predicted beside a pair style with 'predict none'; use the same for both");
  }
}

} // namespace

void require_companions(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  if (lmp.force->pair != &pair)
    fail(lmp, "pair_style gran/cfpm: cannot be a sub-style of pair_style " + std::string(lmp.force->pair_style) +
                  "; expected 'pair_style gran/cfpm' alone");
  if (std::strstr(lmp.update->integrate_style, "verlet") == nullptr)
    fail(lmp, std::string("run_style ") + lmp.update->integrate_style +
                  ": a predicted force is the mean over one whole step; expected 'run_style verlet' "
                  "with pair_style gran/cfpm");
  if (pair.predictor())
    require_predicted_companions(lmp);
  else
    require_unpredicted_companions(lmp);
}

void require_cfpm_pair(LAMMPS_NS::LAMMPS &lmp, const char *command) {
  if (!dynamic_cast<PairGranCfpm *>(lmp.force->pair))
    fail(lmp, std::string(command) + ": needs 'pair_style gran/cfpm', found pair_style " +
                  (lmp.force->pair ? lmp.force->pair_style : "none"));
}

void require_predicted_pair(LAMMPS_NS::LAMMPS &lmp, const char *command) {
  require_cfpm_pair(lmp, command);
  if (!static_cast<PairGranCfpm *>(lmp.force->pair)->predictor())
    fail(lmp, std::string(command) + ": needs predicted forces, but the pair style says 'predict none'");
}

bool any_impulses(LAMMPS_NS::LAMMPS &lmp) {
  const auto gives = [](const Predictor *predictor) { return predictor && predictor->impulse; };
  return gives(static_cast<const PairGranCfpm *>(lmp.force->pair)->predictor()) ||
         std::any_of(lmp.modify->fix, lmp.modify->fix + lmp.modify->nfix, [&](const LAMMPS_NS::Fix *fix) {
           const auto *wall = dynamic_cast<const FixWallGranCfpm *>(fix);
           return wall && gives(wall->predictor());
         });
}

} // namespace cfpm::liggghts
