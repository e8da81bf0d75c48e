// SPDX-License-Identifier: GPL-2.0-or-later
// All that depends on the version of the host: as of 29 Sep 2021, or as renewed by the stable release of
// 23 Jun 2022 and still so on 4 Feb 2025. Three classes whose headers are not shipped are laid out here as far
// as they are read, and checked before they are used: a member that must hold a known pointer or number does.
#pragma once

#include "contact_arguments.h"
#include "host.h"

#include "library.h"
#include "region.h"

#include <string>

namespace cfpm::lammps {

constexpr int host_version = CFPM_LAMMPS_VERSION; // of the headers, as LAMMPS::num_ver

/// A request for a neighbour list.
struct NeighborRequest : LAMMPS_NS::Pointers {
#if CFPM_LAMMPS_VERSION < 20220623
  int index;
#endif
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

/// pair_style gran/hooke/history.
struct GranHookeHistory : LAMMPS_NS::Pair {
  double kn, kt, gamma_n, gamma_t, xmu;
  int dampflag;
  double dt;
  int freeze_group_bit;
  int history;
  int limit_damping;
  int previous_neighbor;
  double *largest_radii[4];
  int history_size;
};

/// Makes the contact history of a style gran/hooke/history that has been given these arguments hold that many values
/// in place of 3, before the first init_style(); false if something is not where it is expected.
inline bool set_history_size(LAMMPS_NS::Pair &style, const ContactArguments &given, int size) {
  auto &host = reinterpret_cast<GranHookeHistory &>(style);
  if (host.kn != given.kn || host.kt != given.kt || host.gamma_n != given.gamma_n || host.gamma_t != given.gamma_t ||
      host.xmu != given.xmu || host.history != 1 || host.history_size != 3)
    return false;
  host.history_size = size;
  return true;
}

inline void forward(LAMMPS_NS::Comm &comm, LAMMPS_NS::Pair *pair) {
#if CFPM_LAMMPS_VERSION < 20220623
  comm.forward_comm_pair(pair);
#else
  comm.forward_comm(pair);
#endif
}

inline void reverse(LAMMPS_NS::Comm &comm, LAMMPS_NS::Pair *pair) {
#if CFPM_LAMMPS_VERSION < 20220623
  comm.reverse_comm_pair(pair);
#else
  comm.reverse_comm(pair);
#endif
}

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

/// The region of that name, or nullptr.
inline LAMMPS_NS::Region *find_region(LAMMPS_NS::Domain &domain, const std::string &id) {
#if CFPM_LAMMPS_VERSION < 20220623
  const int found = domain.find_region(id);
  return found < 0 ? nullptr : domain.regions[found];
#else
  return domain.get_region_by_id(id);
#endif
}

/// Why this host cannot take the plugin, or "" if it can: another version, or one built with other integers.
inline std::string reason_to_refuse(LAMMPS_NS::LAMMPS &lmp) {
  if (lmp.num_ver != host_version)
    return "built for LAMMPS " + std::to_string(host_version) + ", this host is " + std::to_string(lmp.num_ver) + " (" +
           lmp.version + ")";
  const struct {
    const char *name;
    int size;
  } integers[] = {{"tagint", sizeof(LAMMPS_NS::tagint)},
                  {"imageint", sizeof(LAMMPS_NS::imageint)},
                  {"bigint", sizeof(LAMMPS_NS::bigint)}};
  for (const auto &integer : integers) {
    const int size = lammps_extract_setting(&lmp, integer.name);
    if (size != integer.size)
      return std::string("built for a ") + integer.name + " of " + std::to_string(integer.size) +
             " bytes, of this host it has " + std::to_string(size);
  }
  return "";
}

} // namespace cfpm::lammps
