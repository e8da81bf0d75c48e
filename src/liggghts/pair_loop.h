// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

class PairGranCfpm;

/// Adds the predicted forces of all listed pairs to f and torque, without what the host's own loop
/// carries along for output and for further contact models. Both loops give the same forces to the
/// last bit, so that it does not matter which one a step takes.
void add_predicted_pair_forces(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp);

/// Ends the contacts of listed pairs that are apart. The host's own loop does not see them before the
/// next neighbour build, and a pair that meets again by then would find its old spring.
void end_separated_contacts(PairGranCfpm &pair, LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::liggghts
