// SPDX-License-Identifier: GPL-2.0-or-later
#include "checked_run.h"

#include "companions.h"
#include "fix_nve_cfpm.h"
#include "pair_gran_cfpm.h"

#include "core/deck/facts.h"
#include "core/deck/suffix.h"

#include "input.h"

#include <algorithm>
#include <string>

namespace cfpm::liggghts {

namespace {

/// The table of commands is protected, and the host has no function that adds one. A class that inherits it may name
/// it.
struct Commands : LAMMPS_NS::Input {
  using Run = CommandCreator;
  static Run &run(LAMMPS_NS::Input &input) { return (input.*&Commands::command_map)->at("run"); }
};

Commands::Run host_run = nullptr;
bool told = false;

/// The integrator without the pair style ends the run itself.
bool predicts_nothing(const LAMMPS_NS::LAMMPS &lmp) {
  const LAMMPS_NS::Modify &modify = *lmp.modify;
  return lmp.force->pair && !dynamic_cast<const PairGranCfpm *>(lmp.force->pair) &&
         std::none_of(modify.fix, modify.fix + modify.nfix,
                      [](const LAMMPS_NS::Fix *fix) { return dynamic_cast<const FixNveCfpm *>(fix); });
}

/// Why there is nothing to predict; "" where there is something.
std::string unpredicted(const LAMMPS_NS::LAMMPS &lmp) {
  if (predicts_nothing(lmp)) return nothing_to_predict(lmp.force->pair_style, "gran");
  const std::string mover = dynamic_cast<const PairGranCfpm *>(lmp.force->pair) ? sole_mover(lmp) : "";
  return mover.empty() ? "" : nothing_to_move(mover);
}

void checked_run(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  const bool suffixed = lmp->suffix_enable && lmp->suffix && std::string(lmp->suffix) == suffix;
  const std::string reason = suffixed && !told ? unpredicted(*lmp) : "";
  if (!reason.empty()) {
    told = true;
    if (lmp->comm->me == 0) lmp->error->warning(FLERR, reason.c_str());
  }
  if (!facts_file()) return host_run(lmp, narg, arg);
  char no_steps[] = "0"; // particles that come later are known by their templates
  char *words[] = {no_steps};
  host_run(lmp, 1, words);
}

} // namespace

void check_at_runs(LAMMPS_NS::LAMMPS &lmp) {
  told = false;
  Commands::Run &run = Commands::run(*lmp.input);
  if (run == checked_run) return; // of a deck that has said "clear"
  host_run = run;
  run = checked_run;
}

} // namespace cfpm::liggghts
