// SPDX-License-Identifier: GPL-2.0-or-later
#include "companions.h"

#include "fix_nve_cfpm.h"
#include "fix_wall_gran_cfpm.h"
#include "host_versions.h"
#include "pair_gran_cfpm.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace cfpm::lammps {

namespace {

using LAMMPS_NS::Fix;

bool starts_with(const std::string &text, const char *prefix) { return text.rfind(prefix, 0) == 0; }

std::string name_of(const Fix &fix) { return std::string("fix ") + fix.style + " (id " + fix.id + ")"; }

bool moves_by_means(const Fix &fix) { return dynamic_cast<const FixNveCfpm *>(&fix) != nullptr; }

/// Integrators that prescribe a motion and read no force may drive particles that nve/cfpm leaves alone.
bool ignores_forces(const Fix &fix) {
  return std::string(fix.style) == "move" || std::string(fix.style) == "nve/noforce";
}

[[noreturn]] void fail(LAMMPS_NS::LAMMPS &lmp, const std::string &what) {
  lmp.error->all(FLERR, what);
  std::abort(); // not reached
}

bool share_particles(LAMMPS_NS::LAMMPS &lmp, const Fix &a, const Fix &b) {
  int shared = 0;
  for (int i = 0; i < lmp.atom->nlocal; ++i)
    if (lmp.atom->mask[i] & a.groupbit && lmp.atom->mask[i] & b.groupbit) shared = 1;
  MPI_Allreduce(MPI_IN_PLACE, &shared, 1, MPI_INT, MPI_MAX, lmp.world);
  return shared != 0;
}

} // namespace

void require_spheres(LAMMPS_NS::LAMMPS &lmp, const std::string &command) {
  const LAMMPS_NS::Atom &atom = *lmp.atom;
  if (!atom.radius_flag || !atom.rmass_flag || !atom.omega_flag)
    fail(lmp, command + ": particles have no radius; expected 'atom_style sphere'");
}

void require_companions(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  const bool predicted = pair.predictor() != nullptr;
  const bool foresees = any_impulses(lmp, pair) && pair.arguments().impulse_options.onset;
  if (predicted && starts_with(lmp.update->integrate_style, "respa"))
    fail(lmp, "run_style respa: a predicted force is the mean over one whole step; expected 'run_style verlet' with "
              "pair_style gran/cfpm");
  if (predicted && lmp.force->ftm2v != 1.0)
    fail(lmp, std::string("units ") + lmp.update->unit_style +
                  ": forces over masses are no accelerations there; expected lj, si, cgs, micro or nano with "
                  "pair_style gran/cfpm");
  const std::vector<Fix *> all = fixes(*lmp.modify);
  for (const Fix *each : all) {
    const Fix &fix = *each;
    const bool ours = moves_by_means(fix);
    if (ours && !predicted)
      fail(lmp, name_of(fix) + ": needs predicted forces, but the pair style says 'predict none'; expected fix "
                               "nve/sphere");
    if (!predicted) continue;
    if (starts_with(fix.style, "dt/reset"))
      fail(lmp, name_of(fix) + ": changes the time step between a prediction and its use; it cannot be used with "
                               "pair_style gran/cfpm");
    if (foresees && (fix.box_change & ~Fix::BOX_CHANGE_DOMAIN) != Fix::NO_BOX_CHANGE)
      fail(lmp, name_of(fix) +
                    ": changes the box, where contacts that begin inside a step cannot be foreseen; expected "
                    "'onset off' in pair_style gran/cfpm");
    if (starts_with(fix.style, "wall/gran") && !dynamic_cast<const FixWallGranCfpm *>(&fix))
      fail(lmp, name_of(fix) + ": not predicted, beside pair_style gran/cfpm; expected fix wall/gran/cfpm with a "
                               "predictor");
    const bool integrates = fix.time_integrate || fix.rigid_flag;
    if (!integrates || ours) continue;
    if (!ignores_forces(fix))
      fail(lmp, name_of(fix) + ": would integrate step-mean forces as forces of one instant; expected fix nve/cfpm "
                               "beside pair_style gran/cfpm");
    for (const Fix *other : all)
      if (moves_by_means(*other) && share_particles(lmp, fix, *other))
        fail(lmp, name_of(fix) + ": integrates particles that " + name_of(*other) +
                      " integrates too; expected disjoint groups");
  }
  if (predicted && std::none_of(all.begin(), all.end(), [](const Fix *fix) { return moves_by_means(*fix); }))
    fail(lmp, "pair_style gran/cfpm: its step-mean forces need the matching integrator; expected 'fix ID group "
              "nve/cfpm'");
}

int inertia_dimension(LAMMPS_NS::LAMMPS &lmp) {
  int dimension = 0;
  for (const Fix *each : fixes(*lmp.modify))
    if (const auto *fix = dynamic_cast<const FixNveCfpm *>(each)) {
      if (dimension != 0 && fix->dimension() != dimension)
        fail(lmp, name_of(*fix) + ": some fixes nve/cfpm move discs and some spheres; expected disc for all or none");
      dimension = fix->dimension();
    }
  return dimension;
}

bool any_impulses(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  if (!pair.predictor()) return false;
  const std::vector<Fix *> all = fixes(*lmp.modify);
  return pair.predictor()->impulse || std::any_of(all.begin(), all.end(), [&pair](const Fix *fix) {
           const auto *wall = dynamic_cast<const FixWallGranCfpm *>(fix);
           return wall && wall->predictor_beside(pair) && wall->predictor_beside(pair)->impulse;
         });
}

const PairGranCfpm *find_pair(LAMMPS_NS::LAMMPS &lmp) {
  // a hybrid keeps the names as they are written in the deck, without "-suffix cfpm"
  for (const char *name :
       {"gran/cfpm", "gran/hooke/history/cfpm", "gran/hertz/history/cfpm", "gran/hooke/history", "gran/hertz/history"})
    if (auto *pair = dynamic_cast<PairGranCfpm *>(lmp.force->pair_match(name, 1))) return pair;
  return nullptr;
}

const PairGranCfpm &require_predicted_pair(LAMMPS_NS::LAMMPS &lmp, const std::string &command) {
  const PairGranCfpm *pair = find_pair(lmp);
  if (!pair)
    fail(lmp, command + ": needs 'pair_style gran/cfpm', found pair_style " +
                  (lmp.force->pair ? lmp.force->pair_style : "none"));
  if (!pair->predictor()) fail(lmp, command + ": needs predicted forces, but the pair style says 'predict none'");
  return *pair;
}

} // namespace cfpm::lammps
