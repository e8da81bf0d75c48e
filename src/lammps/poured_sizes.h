// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/time_step_report.h"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::lammps {

/// Makes the host note what each fix pour is given from now on: the fix keeps its sizes to itself, and a deck that
/// begins without particles has no others.
void note_poured_sizes(LAMMPS_NS::LAMMPS &lmp);

/// Of the spheres that the fixes pour in force add; not present() where there are none that were noted.
SizeRange poured_sizes(LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::lammps
