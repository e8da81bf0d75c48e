// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "granular_coefficients.h"

#include "core/contact/history_places.h"

namespace cfpm::lammps {

/// What the host's own pair_style granular keeps of a contact, the same for all pairs of types, beginning with a
/// tangential spring.
struct GranularHistory {
  int size = 0; ///< numbers of a contact, 0: none are kept
  HistoryPlaces places;
};

/// What these ask for.
GranularHistory granular_history(const GranularPairs &pairs);

} // namespace cfpm::lammps
