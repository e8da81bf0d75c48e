// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

struct ModelNeeds {
  bool stiffness_given;         ///< by the .../stiffness models; the others derive it from Young's modulus
  bool characteristic_velocity; ///< by hooke, to derive it
  bool absolute_damping;        ///< hooke/stiffness with damping per contact instead of per mass
  bool friction;
};

/// Stops the run with the missing "fix property/global" line where a material property is not defined.
void require_properties(LAMMPS_NS::LAMMPS &lmp, const std::string &command, const ModelNeeds &needs);

} // namespace cfpm::liggghts
