// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/history_places.h"
#include "core/step/particles.h"

#include <algorithm>
#include <cstddef>

namespace cfpm {

class NearPairs;

/// A host's list of pairs that may touch, with a contact history beside it.
struct PairList {
  int count = 0;                       ///< of particles with a list
  const int *first = nullptr;          ///< their indices
  const int *neighbor_count = nullptr; ///< of a particle
  int *const *neighbors = nullptr;     ///< of a particle; an index is in the bits of index_mask
  int index_mask = 0;
  int **flags = nullptr;      ///< of a particle's contacts in the order of its neighbors; null: no history
  double **history = nullptr; ///< likewise, history_size values each
  int history_size = 0;
  int spring_offset = -1;     ///< of the tangential spring among them, < 0 without
  int spring_now_offset = -1; ///< likewise of StoredSpring::now
  HistoryPlaces places;       ///< likewise of what else a host keeps of contacts whose forces are of one instant
  int spring_values = 3;      ///< of the history, from the spring on, that end with the contact
  int touching = 0;           ///< the bits of a flag that say that a pair is in contact
  NearPairs *near = nullptr;  ///< kept beside the list; null: chosen for each evaluation anew
  bool remembers = false;     ///< whether a pair that has parted keeps flag and spring until pairs are listed anew

  /// Where the spring of neighbor jj of i is kept, null without one.
  double *spring(int i, int jj) const { return history_value(i, jj, spring_offset); }
  double *spring_now(int i, int jj) const { return history_value(i, jj, spring_now_offset); }
  double *history_value(int i, int jj, int offset) const {
    return flags && offset >= 0 ? history[i] + static_cast<std::ptrdiff_t>(jj) * history_size + offset : nullptr;
  }
  /// Keeps the mark of a pair, which hardly ever changes.
  [[gnu::always_inline]] void mark(bool touch, int &flag, int i, int jj) const {
    int wanted = -static_cast<int>(touch) & touching;
    __asm__("" : "+r"(wanted)); // a number: else the compiler makes a branch of it, see PackedPairs
    if (__builtin_expect(flag == wanted, 1)) return;
    if (touch)
      flag |= touching;
    else if (!remembers)
      end_contact(flag, i, jj);
  }
  /// For a pair that is apart.
  void end_contact(int &flag, int i, int jj) const {
    flag &= ~touching;
    if (double *const values = spring(i, jj)) std::fill_n(values, spring_values, 0.0);
    if (double *const values = spring_now(i, jj)) std::fill_n(values, 3, 0.0);
  }
};

/// That of a host whose lists have the names of LAMMPS, without history.
template <class NeighList> PairList pair_list_of(const NeighList &list, int index_mask) {
  PairList pairs;
  pairs.count = list.inum;
  pairs.first = list.ilist;
  pairs.neighbor_count = list.numneigh;
  pairs.neighbors = list.firstneigh;
  pairs.index_mask = index_mask;
  return pairs;
}

/// Ends the contacts of listed pairs that are apart, for a step whose forces another loop adds.
inline void end_separated_contacts(const Particles &particles, const PairList &pairs) {
  if (!pairs.flags) return;
  for (int ii = 0; ii < pairs.count; ++ii) {
    const int i = pairs.first[ii];
    for (int jj = 0; jj < pairs.neighbor_count[i]; ++jj) {
      int &flag = pairs.flags[i][jj];
      if (!(flag & pairs.touching)) continue;
      const int j = pairs.neighbors[i][jj] & pairs.index_mask;
      const Vec3 separation = vec3(particles.x[i]) - vec3(particles.x[j]);
      const double reach = particles.radius[i] + particles.radius[j];
      if (dot(separation, separation) >= reach * reach) pairs.end_contact(flag, i, jj);
    }
  }
}

} // namespace cfpm
