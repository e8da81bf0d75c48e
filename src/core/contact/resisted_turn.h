// SPDX-License-Identifier: GPL-2.0-or-later
// Rolling and twisting resistance: couples against the rotation of two bodies relative to each other, about the tangent
// plane and about the normal. A spring and a dashpot hold each of the two, up to a limit. A spring that acts at the
// reduced radius R* with the stiffness k turns the bodies back by R*^2 k per angle, so rolling and twisting differ in
// their direction alone.
#pragma once

#include "core/law/coulomb.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// What holds one of them. R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicTurnHold {
  R stiffness; ///< [N m]
  R damping;   ///< [N m s]
  R limit;     ///< of the couple [N m]
};

/// How the bodies move over a step.
template <class R> struct BasicTurnStep {
  R span;        ///< in which they touch [s]
  R part;        ///< of the step that this is
  R per_inertia; ///< 1/Ii + 1/Ij [1/(kg m^2)]
};

/// How large the couple of a spring and a dashpot is, and where the spring has to be for both to reach the limit, as
/// the host sets it: in the direction of both,
template <class R> [[gnu::always_inline]] inline BasicVec3<R>
turn_at_limit(const BasicTurnHold<R> &hold, const BasicVec3<R> &couple, const R &size, const BasicVec3<R> &rate) {
  return (1.0 / hold.stiffness) * ((hold.limit / size) * couple - hold.damping * rate);
}
template <class R> [[gnu::always_inline]] inline R size_of(const BasicVec3<R> &couple) { return norm(couple); }
template <class R> [[gnu::always_inline]] inline R squared_of(const BasicVec3<R> &couple) {
  return dot(couple, couple);
}
/// and about the normal in that of the rate alone.
template <class R>
[[gnu::always_inline]] inline R turn_at_limit(const BasicTurnHold<R> &hold, const R &, const R &, const R &rate) {
  const R sign = select(R(0.0) < rate, R(1.0), select(rate < R(0.0), R(-1.0), R(0.0)));
  return (1.0 / hold.stiffness) * (hold.limit * sign - hold.damping * rate);
}
template <class R> [[gnu::always_inline]] inline R size_of(const R &couple) {
  using std::fabs;
  return fabs(couple);
}
template <class R> [[gnu::always_inline]] inline R squared_of(const R &couple) { return couple * couple; }

/// Sets a spring that is at the limit back. turn: its angle [-]; rate: of the first body against the second [1/s]. Both
/// are a vector or, about the normal, a number.
template <class R, class Turn>
[[gnu::always_inline]] inline Turn set_back(const BasicTurnHold<R> &hold, const Turn &turn, const Turn &rate) {
  const Turn couple = hold.stiffness * turn + hold.damping * rate;
  if (all_surely_stick(hold.limit, squared_of(couple))) return turn;
  const R size = size_of(couple);
  return select((hold.limit < size) & (R(0.0) < hold.stiffness), turn_at_limit(hold, couple, size, rate), turn);
}

/// The mean couple over the step on the first body [N m].
///
/// What acts on the two bodies alone in the middle of the step: K a + H w slows them down by h = H dt/I and k = K
/// dt^2/I in units of the step, so that by the trapezoid it is the couple of now, with a + w dt/2 in place of a, over 1
/// + h/2 + k/4, which is stable at any step. By it a strong dashpot would throw bodies back; it stops them as e^-h with
/// h/(1 - e^-h) in place of 1 + h/2, which is (1 + 2h/3 + h^2/6)/(1 + h/6) to third order, and has its limits.
template <class R, class Turn> [[gnu::always_inline]] inline Turn
mean_couple(const BasicTurnHold<R> &hold, const BasicTurnStep<R> &step, const Turn &turn, const Turn &rate) {
  const R h = step.span * step.per_inertia * hold.damping;
  const R k = step.span * step.span * step.per_inertia * hold.stiffness;
  const R above = 1.0 + (1.0 / 6.0) * h;
  const R softened = above / (1.0 + (2.0 / 3.0) * h + (1.0 / 6.0) * (h * h) + 0.25 * k * above);
  const Turn couple = (step.part * softened) * (hold.stiffness * (turn + 0.5 * step.span * rate) + hold.damping * rate);
  if (all_surely_stick(hold.limit, squared_of(couple))) return -couple;
  return -coulomb_factor(hold.limit / size_of(couple)) * couple;
}

/// The part of a turn that belongs to a contact with this normal: it turns with the plane that it is in; about the
/// normal there is nothing to turn.
template <class R>
[[gnu::always_inline]] inline BasicVec3<R> follow(const BasicVec3<R> &turn, const BasicVec3<R> &normal) {
  return tangential_part(turn, normal);
}
template <class R> [[gnu::always_inline]] inline R follow(const R &turn, const BasicVec3<R> &) { return turn; }

/// Moves a turn that is kept as it is in the middle between two evaluations, as is a MidStepSpring, on to the next
/// middle. Returns it as it is now, rounded as it is found again. dt: of the step that it leads by half [s]
template <class R, class Turn> [[gnu::always_inline]] inline Turn
move_on_turn(const BasicTurnHold<R> &hold, const R &dt, const BasicVec3<R> &normal, Turn &kept, const Turn &rate) {
  const Turn half_step = 0.5 * dt * rate;
  kept = set_back(hold, follow(kept + dt * rate, normal) - half_step, rate) + half_step;
  return kept - half_step;
}

} // namespace cfpm
