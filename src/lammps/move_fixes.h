// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"

#include <algorithm>

namespace cfpm::lammps {

/// Puts the fixes from the place `first` on, in the order in which fixes act, to the place `before`, as if they had
/// been made there. To be called where the host still looks at them before it runs.
inline void move_fixes(LAMMPS_NS::Modify &modify, LAMMPS_NS::Atom &atom, int first, int before) {
  std::rotate(modify.fix + before, modify.fix + first, modify.fix + modify.nfix);
  std::rotate(modify.fmask + before, modify.fmask + first, modify.fmask + modify.nfix);
  // by their places atoms know the fixes that keep numbers of theirs
  const int moved = modify.nfix - first;
  const auto renumber = [&](int *places, int count) {
    std::for_each(places, places + count, [&](int &place) {
      if (place >= first)
        place -= first - before;
      else if (place >= before)
        place += moved;
    });
  };
  renumber(atom.extra_grow, atom.nextra_grow);
  renumber(atom.extra_restart, atom.nextra_restart);
  renumber(atom.extra_border, atom.nextra_border);
}

} // namespace cfpm::lammps
