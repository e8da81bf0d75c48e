// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/method/impulses/crowd_response.h"
#include "core/method/impulses/normal_impulse.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// Coulomb's limits of a crowded contact as factors: on its impulse, and on its spring.
template <class R> struct CrowdedLimits {
  R impulse;
  R spring;
};

/// limit: of the impulse [N s]; per_spring: the impulse by which a spring sticks, over the spring [N s/m];
/// spring_squared: of what the limit holds as a spring.
template <class R> [[gnu::always_inline]] inline CrowdedLimits<R>
crowded_limits(const R &limit, const R &per_spring, const R &impulse_squared, const R &spring_squared) {
  if (all_surely_stick(limit, impulse_squared) && all_surely_stick(limit, per_spring * per_spring * spring_squared))
    return {1.0, 1.0};
  return {coulomb_factor(limit / sqrt(impulse_squared)), coulomb_factor(limit / per_spring / sqrt(spring_squared))};
}
/// Of a single contact both are a pack: one instruction takes both roots, one both quotients.
[[gnu::always_inline]] inline CrowdedLimits<double> crowded_limits(double limit, double per_spring,
                                                                   double impulse_squared, double spring_squared) {
  const TwoDoubles limits = limit / TwoDoubles{1.0, per_spring};
  const TwoDoubles ratio = limits / TwoDoubles{std::sqrt(impulse_squared), std::sqrt(spring_squared)};
  return {coulomb_factor(ratio[0]), coulomb_factor(ratio[1])};
}

/// The share of a step in which a spring is below Coulomb's limit, so that its dashpot acts, if its force grows on a
/// straight line: from what gives the impulse of which start_squared is the square over the whole step, to what makes
/// the mean of both that of impulse_squared.
template <class R>
[[gnu::always_inline]] inline R share_below_limit(const R &limit, const R &impulse_squared, const R &start_squared) {
  using std::sqrt;
  if (all_surely_stick(limit, R(4.0 * impulse_squared))) return 1.0; // the end is below it too
  const R start = sqrt(start_squared);
  const R room = limit - start;
  const R growth = 2.0 * (sqrt(impulse_squared) - start);
  return select(room >= growth, R(1.0), select(R(0.0) < room, room / growth, R(0.0)));
}

/// Friction of a contact in a crowd.
template <class R> struct CrowdedFriction {
  BasicVec3<R> impulse; ///< on the first body [N s]
  BasicVec3<R> next;    ///< see FrictionImpulse
};

/// At once: bodies stick as long as the tangential impulse stays below friction times the normal one; else they slide
/// all the time, with a spring that without slip would stick at the limit. Where the limit holds both together, the
/// dashpot pulls as a spring that is longer by the slip in its retardation; where it holds the spring alone, the
/// dashpot gives its share of the time before. stick: how they stick; limit: see above; carried: of the slip to the
/// next spring [s]; retardation: see there [s]
template <Friction friction, class R> [[gnu::always_inline]] inline CrowdedFriction<R>
friction_in_crowd(const BasicCrowdResponse<R> &stick, const R &tangential_mass, const R &crowding, const R &limit,
                  const BasicVec3<R> &spring, const BasicVec3<R> &slip, const R &carried,
                  [[maybe_unused]] const R &retardation) {
  using std::fabs;
  const R mass = stick.relaxation(crowding) * tangential_mass;
  const R from_spring = stick.softening * stick.rate_from_displacement;
  const BasicVec3<R> sticking = mass * (from_spring * spring + (stick.rate_from_rate - 1.0) * slip);
  // the dashpot's part: its way from a unit of slip is C over ks/mt, see CrowdResponse
  const BasicVec3<R> dashpot = (mass * stick.rate_from_displacement * retardation) * slip;
  const R per_spring = mass * fabs(from_spring);
  if constexpr (friction == Friction::limited_together) {
    const BasicVec3<R> held = spring + retardation * slip;
    const CrowdedLimits<R> factor = crowded_limits(limit, per_spring, dot(sticking, sticking), dot(held, held));
    return {factor.impulse * sticking, spring + (factor.spring - 1.0) * held + carried * slip};
  } else {
    const BasicVec3<R> held = sticking - dashpot;
    const R squared = dot(held, held);
    const R spring_squared = dot(spring, spring);
    const CrowdedLimits<R> factor = crowded_limits(limit, per_spring, squared, spring_squared);
    const R share = share_below_limit(limit, squared, per_spring * per_spring * spring_squared);
    return {factor.impulse * held + share * dashpot, factor.spring * spring + carried * slip};
  }
}

/// What it does to its first body over a step: positions move by the mean force.
template <Friction friction, class R>
[[gnu::always_inline]] inline BasicMeanForce<R> mean_force_in_crowd(const R &dt, const BasicNormalImpulse<R> &normal,
                                                                    const BasicVec3<R> &n,
                                                                    const BasicVec3<R> &tangential) {
  const R per_step = 1.0 / dt;
  BasicVec3<R> impulse = normal.impulse * n;
  if constexpr (friction == Friction::none) return {per_step * impulse, {}, {}};
  return {per_step * (impulse + tangential), per_step * cross(n, tangential), {}};
}

} // namespace cfpm
