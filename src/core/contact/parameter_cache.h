// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/pair_material.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

namespace cfpm {

/// The radius of curvature of a flat wall [m].
constexpr double flat_wall = std::numeric_limits<double>::infinity();

/// Two touching bodies as a contact law sees them; of a wall the type and the curvature count.
struct ContactPartners {
  int type_i;
  int type_j;
  double radius_i;     ///< [m]
  double radius_j;     ///< [m], of a wall that of its curvature, where its host asks for it: below 0 around i
  double reduced_mass; ///< m* [kg]

  bool operator==(const ContactPartners &other) const {
    return type_i == other.type_i && type_j == other.type_j && radius_i == other.radius_i &&
           radius_j == other.radius_j && reduced_mass == other.reduced_mass;
  }
};

/// Apart from their types.
inline PairSizes<double> sizes_of(const ContactPartners &p) { return {p.radius_i, p.radius_j, p.reduced_mass}; }
/// With a reduced radius of 1 m and a reduced mass of 1 kg, whose powers are all 1.
inline ContactPartners of_unit_size(int type_i, int type_j) { return {type_i, type_j, 2.0, 2.0, 1.0}; }

/// The parameters of contacts that have been met. The law of the host depends on radii and masses, so a type pair alone
/// is no key; a small direct-mapped table keeps all that a deck with a discrete size distribution has; for a continuous
/// one see method/made_steps.h.
/// Parameters: of a law and a method over a step dt(), such as LinearPrediction or HertzImpulse.
template <class Parameters> class ParameterCache {
public:
  explicit ParameterCache(int log2_entries = 6)
      : log2_entries_(log2_entries), entries_(std::size_t{1} << log2_entries) {}

  void clear() { entries_.assign(entries_.size(), {}); }

  template <class Make> const Parameters &get(const ContactPartners &key, double dt, Make make) {
    Entry &entry = entries_[slot(key)];
    if (!entry.parameters || !(entry.key == key) || entry.parameters->dt() != dt) {
      entry.key = key;
      entry.parameters.emplace(make());
    }
    return *entry.parameters;
  }

private:
  struct Entry {
    ContactPartners key{};
    std::optional<Parameters> parameters;
  };

  static std::uint64_t bits(double x) {
    std::uint64_t u;
    std::memcpy(&u, &x, sizeof u);
    return u;
  }

  std::size_t slot(const ContactPartners &key) const {
    const std::uint64_t types = static_cast<std::uint64_t>(key.type_i) * 31 + static_cast<std::uint64_t>(key.type_j);
    const std::uint64_t mixed = bits(key.radius_i) + 3 * bits(key.radius_j) + 7 * bits(key.reduced_mass) + types;
    return (mixed * 0x9E3779B97F4A7C15ULL) >> (64 - log2_entries_);
  }

  int log2_entries_;
  std::vector<Entry> entries_;
};

} // namespace cfpm
