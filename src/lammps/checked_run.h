// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::lammps {

/// Puts a look at the deck in front of the host's command "run": it warns, once until the command "clear", where
/// "-suffix cfpm" finds nothing to predict, of which no style of this plugin would come to know.
void check_at_runs(LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::lammps
