// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"

namespace cfpm {

/// What acts in the tangent plane of a contact, limited by Coulomb (Eqs. 6, 10).
enum class Friction { none, dashpot, spring_and_dashpot };

/// Coulomb's limit, over the magnitude of what it limits, as a factor on that: below 1 where the contact slides.
/// Without a branch, because in a bed it would be mispredicted at every other contact; 0/0 counts as sticking.
template <class R> [[gnu::always_inline]] inline R coulomb_factor(const R &limit_over_magnitude) {
  return smaller(R(1.0), limit_over_magnitude);
}

/// Two numbers side by side in one register: one instruction takes both roots, one both quotients.
using TwoDoubles = Pack<2>::Values;

} // namespace cfpm
