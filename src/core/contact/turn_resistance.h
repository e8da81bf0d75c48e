// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/resisted_turn.h"
#include "core/law/adhesion.h"
#include "core/law/granular_law.h"
#include "core/law/pair_material.h"

namespace cfpm {

/// What two materials have against rolling and twisting of their contacts, beside the law of these. R: double, or a
/// Pack of several contacts' numbers.
template <class R> struct BasicTurnResistance {
  R rolling_stiffness;     ///< of a spring at the reduced radius [N/m]
  R rolling_damping;       ///< likewise [kg/s]
  R rolling_friction;      ///< [-]
  R twisting_stiffness;    ///< [N m]
  R twisting_damping;      ///< [N m s]
  R twisting_friction;     ///< [m]
  R twisting_of_area;      ///< 1: in place of these three what friction has all over the area of contact (Marshall)
  GranularMaterial<R> law; ///< for that, and for what presses
  AdhesiveMaterial<R> adhesion = {};

  /// push: the normal force that limits count [N]
  [[gnu::always_inline]] BasicTurnHold<R> rolling(const R &reduced_radius, const R &push) const {
    const R square = reduced_radius * reduced_radius;
    return {square * rolling_stiffness, square * rolling_damping, reduced_radius * rolling_friction * push};
  }
  [[gnu::always_inline]] BasicTurnHold<R> twisting(const R &push) const {
    return {twisting_stiffness, twisting_damping, twisting_friction * push};
  }
  /// push, or where adhesion presses what it presses by at an overlap [m].
  [[gnu::always_inline]] R pushed(const PairSizes<R> &sizes, const R &overlap, const R &push) const {
    return select(R(0.0) < adhesion.presses, law_of(sizes).pressing_at(overlap), push);
  }
  /// By the area at an overlap [m].
  [[gnu::always_inline]] BasicTurnHold<R> twisting_by_area(const PairSizes<R> &sizes, const R &reduced_radius,
                                                           const R &overlap, const R &push) const {
    using std::sqrt;
    const BasicLinearLaw<R> friction = law_of(sizes).at(overlap);
    const R square = reduced_radius * larger(R(0.0), overlap);
    return {0.5 * square * friction.tangential_stiffness, 0.5 * square * friction.tangential_damping,
            (2.0 / 3.0) * R(sqrt(square)) * friction.friction * push};
  }

private:
  [[gnu::always_inline]] BasicGranularLaw<R> law_of(const PairSizes<R> &sizes) const {
    BasicGranularLaw<R> of_sizes = granular_law(law, sizes);
    of_sizes.adhesion = adhesion.of(sizes);
    return of_sizes;
  }
};

} // namespace cfpm
