// SPDX-License-Identifier: GPL-2.0-or-later
// All that depends on the version of the host, 29 Sep 2021 to 4 Jul 2026. What a host can do is read off its headers,
// not off its number: where it has the newer way that is taken, so that the older one may go. Three classes whose
// headers are not shipped are laid out here as far as they are read, and checked before they are used: a member that
// must hold a known pointer or number does.
#pragma once

#include "contact_arguments.h"
#include "host.h"

#include "core/method/conventional/granular_order.h"

#include "library.h"
#include "region.h"

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace cfpm::lammps {

constexpr int host_version = CFPM_LAMMPS_VERSION; // of the headers, as LAMMPS::num_ver

/// Whether fix wall/gran granular has moduli of its own for hertz/material, which no header shows.
constexpr bool walls_mix_by_themselves = host_version < 20221222;
/// Whether fix wall/gran may have a temperature, likewise.
constexpr bool walls_conduct_heat = host_version >= 20221222;

/// Whether the expression of the class Host is known there, as in has<AskFixList, Modify>.
template <template <class> class Expression, class Host, class = void> inline constexpr bool has = false;
template <template <class> class Expression, class Host>
inline constexpr bool has<Expression, Host, std::void_t<Expression<Host>>> = true;

template <class Modify> using AskFixList = decltype(std::declval<Modify &>().get_fix_list());
template <class Domain> using AskRegion = decltype(std::declval<Domain &>().get_region_by_id(std::string()));
template <class Region> using AskParts = decltype(std::declval<Region &>().reglist);
template <class Neighbor> using AskRequests = decltype(std::declval<Neighbor &>().get_pair_requests());
template <class Comm> using AskForward =
    decltype(std::declval<Comm &>().forward_comm(std::declval<LAMMPS_NS::Pair *>()));
template <class Pair> using AskSizeCutoff = decltype(std::declval<Pair &>().atom2cut(0));

/// The order of operations of pair_style granular, with which turned_spring.h gives its contacts to the last bit. No
/// header tells it; tests have found it of the versions with knows_granular_order.
constexpr GranularOrder granular_order = host_version < 20221222   ? GranularOrder::of_2021
                                         : host_version < 20260704 ? GranularOrder::of_2025
                                                                   : GranularOrder::of_2026;
constexpr bool knows_granular_order = host_version == 20210929 || host_version == 20250204 || host_version == 20260704;

/// Whether it limits friction of dmt by a number that it has not set.
constexpr bool limits_dmt_at_random = granular_order == GranularOrder::of_2021;

/// A request for a neighbour list.
struct NeighborRequest : LAMMPS_NS::Pointers {
  void *requestor;
};
/// The same of a host without Neighbor::get_pair_requests().
struct OlderNeighborRequest : LAMMPS_NS::Pointers {
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

/// A pair style around another one of the host's. It answers for that one where the host asks pair styles for cutoffs
/// by size.
template <class Pair, bool asked> class PairAround : public Pair {
protected:
  explicit PairAround(LAMMPS_NS::LAMMPS *lmp) : Pair(lmp) {}
  std::unique_ptr<Pair> host_style_;
};
template <class Pair> class PairAround<Pair, true> : public Pair {
public:
  double atom2cut(int i) override { return host_style_->atom2cut(i); }
  double radii2cut(double ri, double rj) override { return host_style_->radii2cut(ri, rj); }

protected:
  explicit PairAround(LAMMPS_NS::LAMMPS *lmp) : Pair(lmp) {}
  std::unique_ptr<Pair> host_style_;
};
using PairAroundHostStyle = PairAround<LAMMPS_NS::Pair, has<AskSizeCutoff, LAMMPS_NS::Pair>>;

template <class Comm> void forward(Comm &comm, LAMMPS_NS::Pair *pair) {
  if constexpr (has<AskForward, Comm>)
    comm.forward_comm(pair);
  else
    comm.forward_comm_pair(pair);
}

template <class Comm> void reverse(Comm &comm, LAMMPS_NS::Pair *pair) {
  if constexpr (has<AskForward, Comm>)
    comm.reverse_comm(pair);
  else
    comm.reverse_comm_pair(pair);
}

/// All fixes, in their order.
template <class Modify> std::vector<LAMMPS_NS::Fix *> fixes(Modify &modify) {
  if constexpr (has<AskFixList, Modify>)
    return modify.get_fix_list();
  else
    return {modify.fix, modify.fix + modify.nfix};
}

/// Makes all requests of one pair style those of another; returns how many there were.
template <class Neighbor> int hand_over_requests(Neighbor &neighbor, const LAMMPS_NS::Pair *from, LAMMPS_NS::Pair *to) {
  int handed = 0;
  const auto hand_over = [&](auto *request) {
    if (request->requestor != from) return;
    request->requestor = to;
    ++handed;
  };
  if constexpr (has<AskRequests, Neighbor>)
    for (auto *request : neighbor.get_pair_requests()) hand_over(reinterpret_cast<NeighborRequest *>(request));
  else
    for (int k = 0; k < neighbor.nrequest; ++k)
      hand_over(reinterpret_cast<OlderNeighborRequest *>(neighbor.requests[k]));
  return handed;
}

/// The history that belongs to a pair style, or nullptr.
inline NeighborHistory *find_history(LAMMPS_NS::Modify &modify, const LAMMPS_NS::Pair *pair) {
  for (LAMMPS_NS::Fix *fix : fixes(modify))
    if (std::string(fix->style).rfind("NEIGH_HISTORY", 0) == 0) {
      auto *history = static_cast<NeighborHistory *>(fix);
      if (history->pair == pair) return history;
    }
  return nullptr;
}

/// The region of that name, or nullptr.
template <class Domain> LAMMPS_NS::Region *find_region(Domain &domain, const std::string &id) {
  if constexpr (has<AskRegion, Domain>) {
    return domain.get_region_by_id(id);
  } else {
    const int found = domain.find_region(id);
    return found < 0 ? nullptr : domain.regions[found];
  }
}

/// The regions that a union or an intersection is made of.
template <class Region, class Domain> std::vector<Region *> parts_of(const Region &region, const Domain &domain) {
  std::vector<Region *> parts;
  for (int k = 0; k < region.nregion; ++k) {
    if constexpr (has<AskParts, Region>)
      parts.push_back(region.reglist[k]);
    else
      parts.push_back(domain.regions[region.list[k]]);
  }
  return parts;
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
