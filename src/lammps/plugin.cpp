// SPDX-License-Identifier: GPL-2.0-or-later
// The functions that the plugin exports: cfpm_register adds its styles to a host; lammpsplugin_init is the
// entry of the host's own command "plugin load" and does the same.

#include "contact_counts.h"
#include "fix_nve_cfpm.h"
#include "fix_wall_gran_cfpm.h"
#include "host_versions.h"
#include "pair_gran_cfpm.h"

#include <string>

namespace {

using namespace cfpm::lammps;

LAMMPS_NS::Pair *create_pair(LAMMPS_NS::LAMMPS *lmp) { return new PairGranCfpm(lmp); }
LAMMPS_NS::Pair *create_hooke(LAMMPS_NS::LAMMPS *lmp) { return new PairGranCfpm(lmp, "hooke"); }
LAMMPS_NS::Pair *create_hertz(LAMMPS_NS::LAMMPS *lmp) { return new PairGranCfpm(lmp, "hertz"); }

LAMMPS_NS::Fix *create_integrator(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  return new FixNveCfpm(lmp, narg, arg);
}

LAMMPS_NS::Fix *create_contact_counts(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  return new ContactCounts(lmp, narg, arg);
}

} // namespace

/// lammps: of a host that has just created its own styles, so also after the command "clear".
extern "C" void cfpm_register(void *lammps) {
  auto &lmp = *static_cast<LAMMPS_NS::LAMMPS *>(lammps);
  const std::string refusal = reason_to_refuse(lmp);
  if (!refusal.empty()) lmp.error->all(FLERR, "the cfpm plugin cannot be loaded: " + refusal);
  auto &pairs = *lmp.force->pair_map;
  auto &fixes = *lmp.modify->fix_map;
  pairs["gran/cfpm"] = &create_pair;
  fixes["nve/cfpm"] = &create_integrator;
  fixes["wall/gran/cfpm"] = &create_wall; // also what "-suffix cfpm" makes of fix wall/gran, and so on:
  pairs["gran/hooke/history/cfpm"] = &create_hooke;
  pairs["gran/hertz/history/cfpm"] = &create_hertz;
  fixes["nve/sphere/cfpm"] = &create_integrator;
  fixes["wall/gran/region/cfpm"] = &create_wall;
  fixes[ContactCounts::name] = &create_contact_counts;
}

/// lmp: the host; handle, regfunc: for a host that keeps a list of its plugins, which this one does not need.
extern "C" void lammpsplugin_init(void *lmp, void *, void *) { cfpm_register(lmp); }
