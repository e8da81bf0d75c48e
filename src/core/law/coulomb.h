// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"

#include <limits>
#include <type_traits>

namespace cfpm {

/// What acts in the tangent plane of a contact, limited by Coulomb (Eqs. 6, 10). The two hosts have two laws:
/// - spring_and_dashpot, of LIGGGHTS: the limit holds the spring alone. The dashpot adds to it, without a limit, while
///   the spring is below, and nothing while the contact slides.
/// - limited_together, of LAMMPS: it holds both, and while the contact slides the spring is what is left of it beside
///   the dashpot (S. Luding, Granular Matter 10, 235 (2008)).
/// Without a dashpot they are one.
enum class Friction { none, dashpot, spring_and_dashpot, limited_together };

constexpr bool has_spring(Friction friction) {
  return friction == Friction::spring_and_dashpot || friction == Friction::limited_together;
}

/// Coulomb's limit, over the magnitude of what it limits, as a factor on that: below 1 where the contact slides.
/// Without a branch, because in a bed it would be mispredicted at every other contact; 0/0 counts as sticking.
template <class R> [[gnu::always_inline]] inline R coulomb_factor(const R &limit_over_magnitude) {
  return smaller(R(1.0), limit_over_magnitude);
}

/// Whether every contact of a pack surely sticks, so that its factor is 1 to the last bit without root or quotient: by
/// squares, with room for all their rounding. Of a single contact it is never known: a branch would be mispredicted at
/// every other one. squared: of what is limited.
template <class R> [[gnu::always_inline]] inline bool all_surely_stick(const R &limit, const R &squared) {
  if constexpr (std::is_same_v<R, double>)
    return false;
  else
    return all(squared < (1.0 - 32 * std::numeric_limits<double>::epsilon()) * (limit * limit));
}

/// Two numbers side by side in one register: one instruction takes both roots, one both quotients.
using TwoDoubles = Pack<2>::Values;

} // namespace cfpm
