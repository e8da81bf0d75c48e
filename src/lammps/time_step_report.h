// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/time_step_report.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::lammps {

class PairGranCfpm;

/// Of the pair style and of the walls, with the particles that are there. Collective.
TimeStepReport report_time_step(LAMMPS_NS::LAMMPS &lmp, const PairGranCfpm &pair);

} // namespace cfpm::lammps
