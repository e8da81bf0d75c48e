// SPDX-License-Identifier: GPL-2.0-or-later
// The plugin is compiled against the headers of one host and must not touch another: class layouts
// would differ silently.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

/// Sizes that a compiled function hands to operator new: the constants it loads as first argument
/// before a call, in order. Empty on machines other than x86-64.
std::vector<std::size_t> allocation_sizes(const unsigned char *code, std::size_t length);

/// Why this host cannot take the plugin, or "" if it can.
std::string reason_to_refuse(const LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::liggghts
