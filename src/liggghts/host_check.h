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

/// The machine code of a function of the host.
struct Code {
  const unsigned char *bytes = nullptr; ///< null if the host lacks the function
  std::size_t length = 0;               ///< as the symbol table of its file says
};

/// Finds a function by its mangled name in the file, be it library or program, that the host's styles come from.
Code host_code(const char *function);

/// What a function may hand to operator new: every number that it loads as a first argument and that can be the size
/// of a class. It holds all sizes that are allocated there, and may hold more: bytes inside another instruction can
/// look like such a load. So a size that is missing is surely not allocated, and one that is there is so by accident
/// with the chance of four equal bytes. Empty on machines other than x86-64.
std::vector<std::size_t> possible_allocations(const Code &code);

/// Why this host cannot take the plugin, or "" if it can.
std::string reason_to_refuse(const LAMMPS_NS::LAMMPS &lmp);

} // namespace cfpm::liggghts
