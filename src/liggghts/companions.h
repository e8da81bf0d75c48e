// SPDX-License-Identifier: GPL-2.0-or-later
// Which fixes may act beside predicted contacts. A mean force over the coming step and a force at
// one instant cannot be told apart by their receiver, so a wrong combination would run and be wrong.
#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

class PairGranCfpm;

/// Stops the run where an integrator, wall, run style or hybrid does not fit the pair style.
void require_companions(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair);

/// The fix that moves the particles, where no fix nve/cfpm does: its name, else "".
std::string sole_mover(const LAMMPS_NS::LAMMPS &lmp);

/// Stops the run unless the pair style is gran/cfpm.
void require_cfpm_pair(LAMMPS_NS::LAMMPS &lmp, const char *command);

/// Whether pairs or a wall give impulses. The pair style must be gran/cfpm.
bool any_impulses(LAMMPS_NS::LAMMPS &lmp);
/// Likewise whether contacts begin inside a step.
bool any_onset(LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::liggghts
