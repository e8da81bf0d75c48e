// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"

#include <cmath>
#include <type_traits>

namespace cfpm {

/// What becomes of a spring in the tangent plane while the area of contact changes, whose stiffness goes with the
/// radius of that area. As it is, it keeps its length. R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicAreaSpring {
  R keeps_force = 0.0; ///< 1: it keeps its force instead
  R rescales = 0.0;    ///< 1: while the area shrinks, what it keeps is multiplied by the radius over the one before

  /// Whether there is any that does.
  [[gnu::always_inline]] bool any_follows() const { return any((R(0.0) < keeps_force) | (R(0.0) < rescales)); }

  /// The radius at which a spring that has the length of before would have its force of now. In any unit: the root of
  /// the overlap goes with it.
  [[gnu::always_inline]] R kept(const R &before, const R &now) const {
    const R kept = select(R(0.0) < keeps_force, before, now);
    return select((now < before) & (R(0.0) < rescales), kept * (now / before), kept);
  }
  /// What the length of a spring is multiplied by, so that it counts with the radius of now.
  [[gnu::always_inline]] R stretch(const R &before, const R &now) const {
    return select(R(0.0) < now, kept(before, now) / now, R(1.0));
  }
};

/// Whether a law has such springs, as its area_spring, with the root_of() an overlap and what acts at an overlap by
/// springs_at(), see BasicGranularLaw.
template <class Law, class = void> inline constexpr bool follows_area = false;
template <class Law> inline constexpr bool follows_area<Law, std::void_t<decltype(Law::area_spring)>> = true;

} // namespace cfpm
