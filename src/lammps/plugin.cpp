// SPDX-License-Identifier: GPL-2.0-or-later
// The functions that the plugin exports: cfpm_register adds its styles to a host without package PLUGIN;
// lammpsplugin_init is the entry of the host's command "plugin load", which keeps a list of what it has loaded.

#include "checked_run.h"
#include "fix_contact_counts.h"
#include "fix_nve_cfpm.h"
#include "fix_wall_gran_cfpm.h"
#include "gran_pair_law.h"
#include "granular_pair_law.h"
#include "host_versions.h"
#include "pair_gran_cfpm.h"
#include "poured_sizes.h"

#include "core/numbers/instruction_set.h"

#include <memory>
#include <string>

namespace {

using namespace cfpm::lammps;
using CreatePair = LAMMPS_NS::Pair *(*)(LAMMPS_NS::LAMMPS *);
using CreateFix = LAMMPS_NS::Fix *(*)(LAMMPS_NS::LAMMPS *, int, char **);

LAMMPS_NS::Pair *create_pair(LAMMPS_NS::LAMMPS *lmp) { return new PairGranCfpm(lmp, std::make_unique<GranPairLaw>()); }
LAMMPS_NS::Pair *create_hooke(LAMMPS_NS::LAMMPS *lmp) {
  return new PairGranCfpm(lmp, std::make_unique<GranPairLaw>(), "hooke");
}
LAMMPS_NS::Pair *create_hooke_without_history(LAMMPS_NS::LAMMPS *lmp) {
  return new PairGranCfpm(lmp, std::make_unique<GranPairLaw>(), "hooke/nohistory");
}
LAMMPS_NS::Pair *create_hertz(LAMMPS_NS::LAMMPS *lmp) {
  return new PairGranCfpm(lmp, std::make_unique<GranPairLaw>(), "hertz");
}

LAMMPS_NS::Pair *create_granular(LAMMPS_NS::LAMMPS *lmp) {
  return new PairGranCfpm(lmp, std::make_unique<GranularPairLaw>());
}

LAMMPS_NS::Fix *create_integrator(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  return new FixNveCfpm(lmp, narg, arg);
}

LAMMPS_NS::Fix *create_contact_counts(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  return new FixContactCounts(lmp, narg, arg);
}

const struct {
  const char *name;
  CreatePair create;
} pair_styles[] = {{"gran/cfpm", &create_pair},
                   {"granular/cfpm", &create_granular}, // also what "-suffix cfpm" makes of pair_style granular
                   // what "-suffix cfpm" makes of pair_style gran/hooke/history, and so on
                   {"gran/hooke/history/cfpm", &create_hooke},
                   {"gran/hooke/cfpm", &create_hooke_without_history},
                   {"gran/hertz/history/cfpm", &create_hertz}};

const struct {
  const char *name;
  CreateFix create;
} fix_styles[] = {{"nve/cfpm", &create_integrator},
                  {"nve/sphere/cfpm", &create_integrator},
                  {"wall/gran/cfpm", &create_wall},
                  {"wall/gran/region/cfpm", &create_wall},
                  {FixContactCounts::name, &create_contact_counts}};

/// The host's lammpsplugin_t, which its documentation gives to writers of plugins; not every package ships its header.
struct PluginStyle {
  const char *version;
  const char *category; ///< "pair" or "fix"
  const char *name;
  const char *info; ///< shown when it is loaded
  const char *author;
  void (*create)(); ///< of the type that the category has
  void *handle;
};
using RegisterStyle = void (*)(PluginStyle *, void *);

LAMMPS_NS::LAMMPS &accepted_host(void *lammps) {
  auto &lmp = *static_cast<LAMMPS_NS::LAMMPS *>(lammps);
  std::string refusal = reason_to_refuse(lmp);
  if (refusal.empty()) refusal = cfpm::reason_against_instruction_set();
  if (!refusal.empty()) lmp.error->all(FLERR, "the cfpm plugin cannot be loaded: " + refusal);
  return lmp;
}

} // namespace

/// lammps: of a host that has just created its own styles, so also after the command "clear".
extern "C" void cfpm_register(void *lammps) {
  LAMMPS_NS::LAMMPS &lmp = accepted_host(lammps);
  for (const auto &style : pair_styles) (*lmp.force->pair_map)[style.name] = style.create;
  for (const auto &style : fix_styles) (*lmp.modify->fix_map)[style.name] = style.create;
  check_at_runs(lmp);
  note_poured_sizes(lmp);
}

/// Leaves the command "run" and fix pour alone: the host could not take back what stands in front of them when it
/// unloads this file.
/// handle: of this file, to be closed when its last style is unloaded; register_style: the host's RegisterStyle.
extern "C" void lammpsplugin_init(void *lammps, void *handle, void *register_style) {
  const LAMMPS_NS::LAMMPS &lmp = accepted_host(lammps);
  const auto add = [&](const char *category, const char *name, auto create) {
    PluginStyle style{lmp.version, category, name, name, "cfpm", reinterpret_cast<void (*)()>(create), handle};
    reinterpret_cast<RegisterStyle>(register_style)(&style, lammps);
  };
  for (const auto &style : pair_styles) add("pair", style.name, style.create);
  for (const auto &style : fix_styles) add("fix", style.name, style.create);
}
