// SPDX-License-Identifier: GPL-2.0-or-later
// The one function that the plugin exports: adds its styles to a host that has just created its own.

#include "checked_run.h"
#include "contact_styles.h"
#include "fix_check_timestep_gran_cfpm.h"
#include "fix_heat_gran_cfpm.h"
#include "fix_nve_cfpm.h"
#include "fix_wall_gran_cfpm.h"
#include "host_check.h"
#include "pair_gran_cfpm.h"

#include "core/numbers/instruction_set.h"

#include <map>
#include <string>

namespace cfpm::liggghts {

namespace {

using FixCreator = LAMMPS_NS::Fix *(*)(LAMMPS_NS::LAMMPS *, int, char **);
using FixMap = std::map<std::string, FixCreator>;

// Modify::fix_map is private and the host has no function that adds a style. An explicit
// instantiation may name a private member, so it can hand out the pointer to it.
FixMap *LAMMPS_NS::Modify::*fix_map_member();
template <FixMap *LAMMPS_NS::Modify::*Member> struct Expose {
  friend FixMap *LAMMPS_NS::Modify::*fix_map_member() { return Member; }
};
template struct Expose<&LAMMPS_NS::Modify::fix_map>;

template <class T> LAMMPS_NS::Fix *create_fix(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  return new T(lmp, narg, arg);
}

LAMMPS_NS::Pair *create_pair(LAMMPS_NS::LAMMPS *lmp) { return new PairGranCfpm(lmp); }

void add_styles(LAMMPS_NS::LAMMPS &lmp) {
  (*lmp.force->pair_map)["gran/cfpm"] = &create_pair;
  FixMap &fixes = *(lmp.modify->*fix_map_member());
  fixes["nve/cfpm"] = &create_fix<FixNveCfpm>;
  fixes["nve/sphere/cfpm"] = &create_fix<FixNveCfpm>; // what "-suffix cfpm" makes of fix nve/sphere
  fixes["check/timestep/gran/cfpm"] = &create_fix<FixCheckTimestepGranCfpm>;
  // what the host conducts heat with, under both of its names
  fixes["heat/gran/cfpm"] = &create_fix<FixHeatGranCfpm>;
  fixes["heat/gran/conduction/cfpm"] = &create_fix<FixHeatGranCfpm>;
  fixes["wall/gran/cfpm"] = &create_fix<FixWallGranCfpm>;
}

} // namespace

} // namespace cfpm::liggghts

/// Called after every LAMMPS::create(), so also after the command "clear".
extern "C" void cfpm_register(void *lammps) {
  using namespace cfpm::liggghts;
  auto &lmp = *static_cast<LAMMPS_NS::LAMMPS *>(lammps);
  std::string reason = reason_to_refuse(lmp);
  if (reason.empty()) reason = cfpm::reason_against_instruction_set();
  if (!reason.empty()) lmp.error->all(FLERR, ("the cfpm plugin cannot be loaded: " + reason).c_str());
  static const bool once = (register_contact_styles(), true);
  static_cast<void>(once);
  add_styles(lmp);
  check_at_runs(lmp);
}
