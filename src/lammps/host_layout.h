// SPDX-License-Identifier: GPL-2.0-or-later
// Two classes of the host whose headers are not shipped, as far as they are read here. Both are checked
// before they are used: a member that must hold a known pointer does.
#pragma once

#include "host.h"

#include <string>

namespace cfpm::lammps {

constexpr int host_version = 20210929; // LAMMPS::num_ver that the layouts below belong to

/// A request for a neighbour list.
struct NeighborRequest : LAMMPS_NS::Pointers {
  int index;
  void *requestor;
};

/// fix NEIGH_HISTORY: flags and values of the contacts of a particle, in the order of its neighbours.
struct NeighborHistory : LAMMPS_NS::Fix {
  int local_count;
  int count;
  int uses_index_bit;
  int **flags;
  double **values;
  LAMMPS_NS::Pair *pair;
};

/// Makes all requests of one pair style those of another; returns how many there were.
inline int hand_over_requests(LAMMPS_NS::Neighbor &neighbor, const LAMMPS_NS::Pair *from, LAMMPS_NS::Pair *to) {
  int handed = 0;
  for (int k = 0; k < neighbor.nrequest; ++k) {
    auto *request = reinterpret_cast<NeighborRequest *>(neighbor.requests[k]);
    if (request->requestor != from) continue;
    request->requestor = to;
    ++handed;
  }
  return handed;
}

/// The history that belongs to a pair style, or nullptr.
inline NeighborHistory *find_history(LAMMPS_NS::Modify &modify, const LAMMPS_NS::Pair *pair) {
  for (int k = 0; k < modify.nfix; ++k)
    if (std::string(modify.fix[k]->style).rfind("NEIGH_HISTORY", 0) == 0) {
      auto *history = static_cast<NeighborHistory *>(modify.fix[k]);
      if (history->pair == pair) return history;
    }
  return nullptr;
}

} // namespace cfpm::lammps
