// SPDX-License-Identifier: GPL-2.0-or-later
// The host's citeme.h names a header that is not shipped with it. Nothing here looks at its file: as much as the
// declaration of the class needs.
#pragma once

#include <cstdio>

namespace LAMMPS_NS {
class SafeFilePtr {
  FILE *file_;
};
} // namespace LAMMPS_NS
