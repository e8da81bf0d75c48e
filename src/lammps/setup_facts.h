// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm {
class TimeStepReport;
}

namespace cfpm::lammps {

/// Adds what is known of a setup to facts_file(), if there is one. Collective; stops the run where it cannot be
/// written.
void tell_facts(LAMMPS_NS::LAMMPS &lmp, const TimeStepReport &report);

} // namespace cfpm::lammps
