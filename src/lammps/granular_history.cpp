// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_history.h"

#include "host_versions.h"

#include <algorithm>
#include <set>

namespace cfpm::lammps {

/// The host of 2021 has a place for the area before for each type that is the lower one of a pair that rescales, and
/// one for the twist; later ones have one, and three.
GranularHistory granular_history(const GranularPairs &pairs) {
  const auto any = [&](const auto &has) {
    return std::any_of(pairs.begin(), pairs.end(), [&](const auto &pair) { return has(pair.second); });
  };
  if (!any([](const GranularCoefficients &c) { return c.has_spring; })) return {};
  constexpr bool of_2021 = granular_order == GranularOrder::of_2021;
  std::set<int> rescaling;
  for (const auto &[types, c] : pairs)
    if (c.rescales) rescaling.insert(of_2021 ? types.first : 0);
  GranularHistory history;
  history.places.rolling = 3 + static_cast<std::ptrdiff_t>(rescaling.size());
  const bool rolls = any([](const GranularCoefficients &c) { return c.rolls; });
  history.places.twist = history.places.rolling + (rolls ? 3 : 0);
  const bool twists = any([](const GranularCoefficients &c) { return c.resists_twisting(); });
  history.size = static_cast<int>(history.places.twist) + (!twists ? 0 : of_2021 ? 1 : 3);
  return history;
}

} // namespace cfpm::lammps
