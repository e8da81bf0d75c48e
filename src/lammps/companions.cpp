// SPDX-License-Identifier: GPL-2.0-or-later
#include "companions.h"

#include "fix_nve_cfpm.h"
#include "fix_wall_gran_cfpm.h"
#include "host_versions.h"
#include "pair_gran_cfpm.h"

#include "core/deck/companions.h"
#include "core/deck/suffix.h"

#include <algorithm>
#include <cstdlib>
#include <string>
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

Companion::Role role_of(const Fix &fix, const PairGranCfpm &pair) {
  using Role = Companion::Role;
  if (moves_by_means(fix)) return Role::integrator;
  if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(&fix))
    return wall->is_predicted_beside(pair) ? Role::predicted_wall : Role::conventional_wall;
  if (starts_with(fix.style, "wall/gran")) return Role::foreign_wall;
  if (starts_with(fix.style, "dt/reset")) return Role::changes_time_step;
  if (fix.rigid_flag) return Role::rigid_bodies;
  if (!fix.time_integrate) return Role::other;
  return ignores_forces(fix) ? Role::prescribed_motion : Role::foreign_integrator;
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

bool is_hybrid(LAMMPS_NS::LAMMPS &lmp) { return lmp.force->pair && starts_with(lmp.force->pair_style, "hybrid"); }

/// A pair style of the deck by its name there, alone or as part of a hybrid.
struct NamedPair {
  std::string name;
  LAMMPS_NS::Pair *style;
};

/// All of them, sorted by name. The header of the hybrid is not shipped, but a hybrid can be asked for the n-th style
/// of a name, and the host has a table of all names.
std::vector<NamedPair> named_pairs(LAMMPS_NS::LAMMPS &lmp) {
  if (!lmp.force->pair) return {};
  if (!is_hybrid(lmp)) return {{lmp.force->pair_style, lmp.force->pair}};
  std::vector<NamedPair> found;
  for (const auto &[name, creator] : *lmp.force->pair_map) {
    if (starts_with(name, "hybrid")) continue;
    for (int n = 1;; ++n) {
      LAMMPS_NS::Pair *const style = lmp.force->pair_match(name, 1, n);
      // where a name stands once, that one is also given for the second
      if (!style || (!found.empty() && found.back().style == style)) break;
      found.push_back({name, style});
    }
  }
  return found;
}

std::string listed(const std::vector<NamedPair> &pairs) {
  std::string names;
  for (const NamedPair &pair : pairs) names += (names.empty() ? "" : ", ") + pair.name;
  return names;
}

/// Tells that fix nve/cfpm takes a force that changes with the positions for constant over the step: v' = v + dt f/m,
/// x' = x + dt v + dt^2 f/(2m). Of an undamped spring of frequency w that raises the energy by a factor of about
/// 1 + (w dt)^2/2 in every step, where velocity Verlet keeps it.
void warn_of_instant_force(LAMMPS_NS::LAMMPS &lmp, const std::string &what) {
  if (lmp.comm->me == 0)
    lmp.error->warning(FLERR, what +
                                  ": its force at the start of a step is integrated as if it acted unchanged over the "
                                  "step, which is of first order in the time step and adds energy; expected a force "
                                  "that hardly changes in a step of pair_style gran/cfpm");
}

/// Stops the run where there is another pair style of ours and one of them may predict.
void require_it_once(LAMMPS_NS::LAMMPS &lmp) {
  std::vector<NamedPair> ours;
  bool may_predict = false;
  for (const NamedPair &pair : named_pairs(lmp))
    if (const auto *cfpm = dynamic_cast<const PairGranCfpm *>(pair.style)) {
      ours.push_back(pair);
      may_predict = may_predict || cfpm->may_predict();
    }
  if (may_predict && ours.size() > 1)
    fail(lmp, "pair_style gran/cfpm: found " + std::to_string(ours.size()) + " times in pair_style " +
                  lmp.force->pair_style + " (" + listed(ours) +
                  "); expected it once, with one contact law for all of its pairs, or 'predict verlet' in all of "
                  "them, in an unmodified deck by '-predict verlet -suffix cfpm'");
}

/// What acts beside predicted pairs must be no granular contact, and is told of if it is another force.
void check_other_forces(LAMMPS_NS::LAMMPS &lmp) {
  const std::vector<NamedPair> pairs = named_pairs(lmp);
  const std::string whole = std::string("pair_style ") + lmp.force->pair_style;
  if (starts_with(lmp.force->pair_style, "hybrid/scaled"))
    fail(lmp, whole + ": scales forces that were predicted unscaled; expected pair_style hybrid or hybrid/overlay with "
                      "gran/cfpm");
  for (const NamedPair &pair : pairs) {
    if (dynamic_cast<const PairGranCfpm *>(pair.style) || starts_with(pair.name, "zero")) continue;
    if (starts_with(pair.name, "gran")) // gran/hooke and the like, granular
      fail(lmp, "pair_style " + pair.name + ": not predicted, beside pair_style gran/cfpm in " + whole +
                    "; expected gran/cfpm for all granular contacts");
    warn_of_instant_force(lmp, "pair_style " + pair.name);
  }
  const LAMMPS_NS::Force &force = *lmp.force;
  const struct {
    const char *command;
    bool there;
    const char *style;
  } others[] = {{"bond_style ", force.bond != nullptr, force.bond_style},
                {"angle_style ", force.angle != nullptr, force.angle_style},
                {"dihedral_style ", force.dihedral != nullptr, force.dihedral_style},
                {"improper_style ", force.improper != nullptr, force.improper_style},
                {"kspace_style ", force.kspace != nullptr, force.kspace_style}};
  for (const auto &other : others)
    if (other.there && !starts_with(other.style, "zero"))
      warn_of_instant_force(lmp, other.command + std::string(other.style));
  for (const Fix *fix : fixes(*lmp.modify))
    for (const char *name :
         {"spring", "indent", "wall/lj", "wall/harmonic", "wall/morse", "wall/colloid", "wall/ees", "wall/region"})
      if (starts_with(fix->style, name)) warn_of_instant_force(lmp, name_of(*fix));
}

/// Whether something holds for the method of predicted pairs or of a wall beside them.
template <class Holds> bool any_method(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair, const Holds &holds) {
  if (!pair.method().predicted) return false;
  const std::vector<Fix *> all = fixes(*lmp.modify);
  return holds(pair.method()) || std::any_of(all.begin(), all.end(), [&](const Fix *fix) {
           const auto *wall = dynamic_cast<const FixWallGranCfpm *>(fix);
           return wall && holds(wall->method_beside(pair));
         });
}

std::vector<Companion> companions(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  std::vector<Companion> found;
  for (const Fix *fix : fixes(*lmp.modify)) found.push_back({name_of(*fix), role_of(*fix, pair)});
  return found;
}

/// Why the contacts of a fix have no budget of energy, or "".
std::string reason_at_wall(const Fix &fix, const PairGranCfpm &pair) {
  if (const auto *wall = dynamic_cast<const FixWallGranCfpm *>(&fix)) return wall->reason_against_energy(pair);
  if (!starts_with(fix.style, "wall/gran")) return "";
  return "its contacts are the host's; expected fix wall/gran/cfpm without 'predict'";
}

} // namespace

std::string sole_mover(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  return cfpm::sole_mover(companions(lmp, pair));
}

void require_spheres(LAMMPS_NS::LAMMPS &lmp, const std::string &command) {
  const LAMMPS_NS::Atom &atom = *lmp.atom;
  if (!atom.radius_flag || !atom.rmass_flag || !atom.omega_flag)
    fail(lmp, command + ": particles have no radius; expected 'atom_style sphere'");
}

void require_companions(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  const bool predicted = pair.method().predicted;
  const bool foresees = any_onset(lmp, pair);
  if (predicted && starts_with(lmp.update->integrate_style, "respa"))
    fail(lmp, "run_style respa: a predicted force is the mean over one whole step; expected 'run_style verlet' with "
              "pair_style gran/cfpm");
  if (predicted && lmp.force->ftm2v != 1.0)
    fail(lmp, std::string("units ") + lmp.update->unit_style +
                  ": forces over masses are no accelerations there; expected lj, si, cgs, micro or nano with "
                  "pair_style gran/cfpm");
  require_it_once(lmp);
  if (predicted) check_other_forces(lmp);
  const std::vector<Fix *> all = fixes(*lmp.modify);
  for (const Fix *fix : all)
    if (foresees && (fix->box_change & ~Fix::BOX_CHANGE_DOMAIN) != Fix::NO_BOX_CHANGE)
      fail(lmp, name_of(*fix) +
                    ": changes the box, where contacts that begin inside a step cannot be foreseen; expected "
                    "'onset off' in pair_style gran/cfpm");
  const std::string wrong = wrong_companion(companions(lmp, pair), predicted, [&](std::size_t k, std::size_t l) {
    return share_particles(lmp, *all[k], *all[l]);
  });
  if (!wrong.empty()) fail(lmp, wrong);
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

std::string reason_for_host_style(LAMMPS_NS::LAMMPS &lmp) {
  for (const Fix *fix : fixes(*lmp.modify))
    if (fix->rigid_flag) return name_of(*fix) + " gives its particles the masses of their bodies";
  // newer hosts weaken or leave out the contacts of bonded particles
  return lmp.atom->molecular != 0 ? "particles may be bonded" : "";
}

std::shared_ptr<EnergyBudget> find_budget(LAMMPS_NS::LAMMPS &lmp) {
  for (const Fix *each : fixes(*lmp.modify))
    if (const auto *fix = dynamic_cast<const FixNveCfpm *>(each))
      if (fix->budget()) return fix->budget();
  return nullptr;
}

std::string reason_against_energy(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  if (lmp.force->ftm2v != 1.0)
    return std::string("units ") + lmp.update->unit_style +
           ": forces over masses are no accelerations there; expected lj, si, cgs, micro or nano";
  int integrators = 0;
  for (const Fix *each : fixes(*lmp.modify)) {
    if (moves_by_means(*each) && ++integrators > 1)
      return name_of(*each) + ": the budget is of the particles of one fix nve/cfpm; expected one for all of them";
    const std::string wrong = reason_at_wall(*each, pair);
    if (!wrong.empty()) return name_of(*each) + ": " + wrong;
  }
  return "";
}

bool any_impulses(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  return any_method(lmp, pair, [](const Method &method) { return method.wants_crowd; });
}

bool any_onset(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair) {
  return any_method(lmp, pair, [&pair](const Method &method) { return pair.onset_of(method); });
}

PairGranCfpm *find_pair(LAMMPS_NS::LAMMPS &lmp) {
  // a hybrid keeps the names as they are written in the deck, without "-suffix cfpm"
  for (const char *name :
       {"gran/cfpm", "granular/cfpm", "gran/hooke/history/cfpm", "gran/hooke/cfpm", "gran/hertz/history/cfpm",
        "gran/hooke/history", "gran/hooke", "gran/hertz/history", "granular"})
    if (auto *pair = dynamic_cast<PairGranCfpm *>(lmp.force->pair_match(name, 1, 1))) return pair;
  return nullptr;
}

std::string name_of_pairs(LAMMPS_NS::LAMMPS &lmp) {
  const std::string name = lmp.force->pair ? lmp.force->pair_style : "none";
  return is_hybrid(lmp) ? name + " of " + listed(named_pairs(lmp)) : name;
}

PairGranCfpm &require_pair(LAMMPS_NS::LAMMPS &lmp, const std::string &command) {
  PairGranCfpm *pair = find_pair(lmp);
  if (!pair) {
    std::string expected = "it";
    if (is_hybrid(lmp)) {
      const std::string kind = lmp.force->pair_style;
      expected =
          "gran/cfpm among these, as in 'pair_style " + kind + " gran/cfpm hooke ...' with 'pair_coeff * * gran/cfpm'";
    }
    fail(lmp, command + ": needs 'pair_style gran/cfpm', found pair_style " + name_of_pairs(lmp) + "; expected " +
                  expected + ", or with -suffix " + suffix + " " + predictable_pairs);
  }
  return *pair;
}

} // namespace cfpm::lammps
