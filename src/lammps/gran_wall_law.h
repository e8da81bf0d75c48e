// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "wall_law.h"

#include <string>
#include <vector>

namespace cfpm::lammps {

/// Of a wall with the law of the host's hooke/history, hooke or hertz/history. words: from the contact model on, see
/// read_contact_arguments().
WallArguments read_gran_wall(LAMMPS_NS::LAMMPS &lmp, const std::string &command, const std::vector<std::string> &words);

} // namespace cfpm::lammps
