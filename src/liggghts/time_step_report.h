// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

struct TimeStepReport {
  std::string text;
  bool too_large; ///< for the predictor's limit on one undamped contact
};

/// Contact time tc and steps per contact nt = tc/dt of every pair of types that is present, or will be
/// inserted, with the limit of the predictor. Collective; the pair style must be a predicted gran/cfpm
/// and initialised.
TimeStepReport report_time_step(LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::liggghts
