// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "wall_law.h"

#include <string>
#include <vector>

namespace cfpm::lammps {

/// Of a wall with the sub-models of the host's fix wall/gran granular, some of which can be predicted. words:
/// "granular", the sub-models, the shape, and "predict X" anywhere.
WallArguments read_granular_wall(LAMMPS_NS::LAMMPS &lmp, const std::string &command, std::vector<std::string> words);

} // namespace cfpm::lammps
