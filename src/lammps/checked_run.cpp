// SPDX-License-Identifier: GPL-2.0-or-later
#include "checked_run.h"

#include "companions.h"
#include "fix_nve_cfpm.h"
#include "host_versions.h"

#include "core/deck/facts.h"
#include "core/deck/suffix.h"

#include "input.h"

#include <algorithm>
#include <string>
#include <vector>

namespace cfpm::lammps {

namespace {

using CreateCommand = LAMMPS_NS::Input::CommandCreator;

CreateCommand host_run = nullptr;
bool told = false;

/// The integrator without the pair style ends the run itself.
bool predicts_nothing(LAMMPS_NS::LAMMPS &lmp) {
  const std::vector<LAMMPS_NS::Fix *> all = fixes(*lmp.modify);
  return lmp.force->pair && !find_pair(lmp) && std::none_of(all.begin(), all.end(), [](const LAMMPS_NS::Fix *fix) {
           return dynamic_cast<const FixNveCfpm *>(fix);
         });
}

/// Why there is nothing to predict; "" where there is something.
std::string unpredicted(LAMMPS_NS::LAMMPS &lmp) {
  if (predicts_nothing(lmp)) return nothing_to_predict(name_of_pairs(lmp), predictable_pairs);
  const PairGranCfpm *pair = find_pair(lmp);
  const std::string mover = pair ? sole_mover(lmp, *pair) : "";
  return mover.empty() ? "" : nothing_to_move(mover);
}

/// Makes of the run that the host is about to read its setup; of one without particles the first step before, which may
/// pour some. The header of commands is in no package, so it is the command's words that change.
void cut_to_setup(LAMMPS_NS::LAMMPS &lmp) {
  static bool cutting = false;
  static char no_steps[] = "0";
  LAMMPS_NS::Input &input = *lmp.input;
  if (cutting || input.narg == 0) return;
  cutting = true;
  if (lmp.atom->natoms == 0 && std::string(input.arg[0]) != no_steps) input.one("run 1");
  cutting = false;
  input.narg = 1;
  input.arg[0] = no_steps;
}

LAMMPS_NS::Command *create_checked_run(LAMMPS_NS::LAMMPS *lmp) {
  const bool suffixed = lmp->suffix_enable && lmp->suffix && std::string(lmp->suffix) == suffix;
  const std::string reason = suffixed && !told ? unpredicted(*lmp) : "";
  if (!reason.empty()) {
    told = true;
    if (lmp->comm->me == 0) lmp->error->warning(FLERR, reason);
  }
  if (facts_file()) cut_to_setup(*lmp);
  return host_run(lmp);
}

} // namespace

void check_at_runs(LAMMPS_NS::LAMMPS &lmp) {
  told = false;
  CreateCommand &run = lmp.input->command_map->at("run");
  if (run == create_checked_run) return; // of a deck that has said "clear"
  host_run = run;
  run = create_checked_run;
}

} // namespace cfpm::lammps
