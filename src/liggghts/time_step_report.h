// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/time_step_report.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

/// Of every pair of types that is present, or will be inserted, and of the walls. Collective; the pair style
/// must be gran/cfpm, and both it and the walls initialised.
TimeStepReport report_time_step(LAMMPS_NS::LAMMPS &lmp);

/// The shortest time of all these contacts [s], infinite without particles, before the walls are initialised: they are
/// taken to have the law of the pairs.
double shortest_contact(LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::liggghts
