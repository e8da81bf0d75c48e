// SPDX-License-Identifier: GPL-2.0-or-later
// Which fixes may act beside predicted contacts. A mean force over the coming step and a force at one
// instant cannot be told apart by their receiver, so a wrong combination would run and be wrong.
#pragma once

#include "core/step/energy_budget.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::lammps {

class PairGranCfpm;

/// Stops the run unless particles have a radius, a mass and a spin each.
void require_spheres(LAMMPS_NS::LAMMPS &lmp, const std::string &command);

/// Stops the run where an integrator, wall or run style does not fit the pair style.
void require_companions(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair);

/// The fix that moves the particles, where no fix nve/cfpm does: its name, else "".
std::string sole_mover(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair);

/// Of the inertia of the particles that fix nve/cfpm moves: 2 for discs, else 3. Stops the run where two disagree.
int inertia_dimension(LAMMPS_NS::LAMMPS &lmp);

/// Why forces of one instant are left to the host's pair style, as text behind "as", or "" if they are not.
std::string reason_for_host_style(LAMMPS_NS::LAMMPS &lmp);

/// That a fix nve/cfpm of the deck has asked for, or null.
std::shared_ptr<EnergyBudget> find_budget(LAMMPS_NS::LAMMPS &lmp);

/// What has no budget of energy beside the pair style, and what is expected, or "".
std::string reason_against_energy(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair);

/// Whether pairs or a wall give impulses.
bool any_impulses(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair);
/// Likewise whether contacts begin inside a step.
bool any_onset(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair);

/// The pair style gran/cfpm of the deck, also as part of a hybrid, or nullptr.
PairGranCfpm *find_pair(LAMMPS_NS::LAMMPS &lmp);

/// As the deck has it, for messages: "granular", "hybrid of gran/hooke, lj/cut".
std::string name_of_pairs(LAMMPS_NS::LAMMPS &lmp);

/// Pair styles of the host that "-suffix cfpm" takes, for messages.
constexpr const char *predictable_pairs = "gran/hooke, gran/hooke/history, gran/hertz/history or granular";

/// That pair style; stops the run without one.
PairGranCfpm &require_pair(LAMMPS_NS::LAMMPS &lmp, const std::string &command);

} // namespace cfpm::lammps
