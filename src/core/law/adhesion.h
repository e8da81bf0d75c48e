// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/pair_material.h"
#include "core/numbers/pack.h"

#include <type_traits>

namespace cfpm {

/// What pulls two bodies together while they touch, the same at any overlap, beside a Hertz contact that they have as
/// without it: the model of B. V. Derjaguin, V. M. Muller and Y. P. Toporov, J. Colloid Interface Sci. 53, 314 (1975).
/// The force fn of spring and pull is negative where these part. R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicAdhesion {
  R pull = 0.0;    ///< 4 pi gamma R* [N]
  R presses = 0.0; ///< 1: Coulomb's limit counts what presses the bodies together, fn + 2 pull, without a dashpot

  [[gnu::always_inline]] bool any_pulls() const { return any(R(0.0) < pull); }
};

/// What belongs to two materials of it. R: as above.
template <class R> struct AdhesiveMaterial {
  R pull_of_radius; ///< 4 pi gamma, gamma the energy of the surface [N/m]
  R presses;        ///< see BasicAdhesion

  [[gnu::always_inline]] BasicAdhesion<R> of(const PairSizes<R> &sizes) const {
    return {pull_of_radius / (1.0 / sizes.radius_i + 1.0 / sizes.radius_j), presses};
  }
};

/// Whether a law has it, as its adhesion, with what presses at an overlap by pressing_at(), see BasicGranularLaw.
template <class Law, class = void> inline constexpr bool adheres = false;
template <class Law> inline constexpr bool adheres<Law, std::void_t<decltype(Law::adhesion)>> = true;

} // namespace cfpm
