// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/time_step_report.h"

#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

/// Per type (index 0 unused): the particles of all ranks and those that insertion templates will make,
/// with a template's mean density. Collective.
std::vector<SizeRange> particle_sizes(LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::liggghts
