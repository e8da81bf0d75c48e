// SPDX-License-Identifier: GPL-2.0-or-later
// What one contact does to its two bodies over one step: the contact force prediction method of
// Tokoro, Okaya and Sadaki, KONA 23 (2005), Eqs. 20-40. The force now and the force predicted for
// t + dt from the isolated two-body problem are averaged; all other contacts are left out of the
// prediction on purpose. A host finds the contacts and applies the mean forces; no physics is there.
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/law/linear_law.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// A contact in the state of one instant t: its law at this overlap, and what is predicted for t + dt.
/// LinearPrediction, IntegratedPrediction and HertzPrediction make it; everything below is the same for every law.
/// R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicPredictedLaw {
  BasicLinearLaw<R> law;            ///< force at t
  R predicted_normal_force;         ///< at t + dt, 0 of bodies that have parted, else not yet clamped [N]
  R predicted_tangential_stiffness; ///< of the force at t + dt from the spring at t [N/m]
  R predicted_tangential_damping;   ///< and from the slip velocity at t [kg/s]
  R predicted_spring_stiffness;     ///< the part of the first that the spring at t + dt has [N/m]
  R predicted_spring_damping;       ///< the part of the second [kg/s]
  R dt;                             ///< [s]
};

using PredictedLaw = BasicPredictedLaw<double>;

/// The same where bodies may adhere.
template <class R> struct BasicPredictedAdhesion : BasicPredictedLaw<R> {
  R presses;   ///< see BasicAdhesion
  R pressing;  ///< what presses at t [N]
  R predicted; ///< at t + dt [N]
};

/// Either of bodies that touch from then on for a time: what is predicted is for its end.
template <class Predicted> struct BasicPredictedTouch {
  Predicted law;       ///< whose dt is the span that the bodies are followed
  double contact_time; ///< in which they overlap; Eq. 39 may end it earlier [s]
};

using PredictedTouch = BasicPredictedTouch<PredictedLaw>;

template <class R> struct BasicNormalAction {
  R force;           ///< f_n(t) >= 0 [N]
  R predicted;       ///< f*_n(t + dt), clamped by Eq. 36 [N]
  R separation_time; ///< Eq. 39 where the contact ends inside the step, else dt [s]

  [[gnu::always_inline]] R mean() const { return 0.5 * (force + predicted); }
};

template <class R> struct BasicTangentialAction {
  BasicVec3<R> force;     ///< f_s(t) on the first body [N]
  BasicVec3<R> predicted; ///< f*_s(t + dt) on the first body [N]

  [[gnu::always_inline]] BasicVec3<R> mean() const { return 0.5 * (force + predicted); }
};

using NormalAction = BasicNormalAction<double>;
using TangentialAction = BasicTangentialAction<double>;

/// Eqs. 2, 35, 36, 39; with tension the contact ends where the bodies part, not by Eq. 36.
template <class R> [[gnu::always_inline]] inline BasicNormalAction<R>
predict_normal(const BasicPredictedLaw<R> &contact, const BasicContactGeometry<R> &g) {
  const BasicLinearLaw<R> &law = contact.law;
  const R force = law.limited(law.normal_force(g.overlap, g.closing_speed));
  const R end = contact.predicted_normal_force;
  const auto acts = end >= law.least_force;
  return {force, select(acts, end, law.least_force), select(acts, contact.dt, contact.dt * force / (force - end))};
}

/// The normal forces that Coulomb's limit counts.
template <class R> struct BasicLimitForces {
  R now;       ///< [N]
  R predicted; ///< [N]
};
/// cohesive: what else presses the bodies together as far as that limit counts it [N].
template <class R> [[gnu::always_inline]] inline BasicLimitForces<R>
limit_forces(const BasicPredictedLaw<R> &, const BasicNormalAction<R> &normal, const R &cohesive) {
  using std::fabs;
  return {fabs(normal.force + cohesive), fabs(normal.predicted + cohesive)};
}
template <class R> [[gnu::always_inline]] inline BasicLimitForces<R>
limit_forces(const BasicPredictedAdhesion<R> &contact, const BasicNormalAction<R> &normal, const R &cohesive) {
  const BasicPredictedLaw<R> &without = contact;
  const BasicLimitForces<R> forces = limit_forces(without, normal, cohesive);
  const auto presses = R(0.0) < contact.presses;
  return {select(presses, contact.pressing, forces.now), select(presses, contact.predicted, forces.predicted)};
}

/// Whether the limit holds a spring that has been slackened to it. Of what that has rounded there is room for; a spring
/// that has nearly come to the limit may as well be at it. squared: of its force.
template <class R> [[gnu::always_inline]] inline auto is_at_limit(const R &limit, const R &squared) {
  constexpr double nearly = 1.0 - 1e-9;
  return squared >= nearly * (limit * limit);
}

/// Where Coulomb's limit holds the spring alone, see Friction. As predict_tangential().
template <class R> [[gnu::always_inline]] inline BasicTangentialAction<R>
predict_with_spring_limited(const BasicPredictedLaw<R> &contact, const BasicVec3<R> &spring,
                            const BasicVec3<R> &slip_velocity, const R &limit, const R &end_limit) {
  using std::sqrt;
  const BasicLinearLaw<R> &law = contact.law;
  const BasicVec3<R> pull = -law.tangential_stiffness * spring;
  const R damping = select(is_at_limit(limit, dot(pull, pull)), R(0.0), law.tangential_damping);
  const BasicVec3<R> end_pull =
      sticking_friction(contact.predicted_spring_stiffness, contact.predicted_spring_damping, spring, slip_velocity);
  const BasicVec3<R> end = sticking_friction(contact.predicted_tangential_stiffness,
                                             contact.predicted_tangential_damping, spring, slip_velocity);
  const R squared = dot(end_pull, end_pull);
  const BasicVec3<R> now = pull - damping * slip_velocity;
  if (all_surely_stick(end_limit, squared)) return {now, end};
  return {now, select(squared >= end_limit * end_limit, coulomb_factor(R(end_limit / sqrt(squared))) * end_pull, end)};
}

/// Eqs. 6, 10, 37, 40, now and predicted. With the literal reading of Eqs. 36 and 40 the prediction
/// vanishes for a contact that separates inside the step, so Eq. 38 never contributes. spring: slip accumulated in this
/// contact (Eq. 7), in the tangent plane [m]; slip_velocity: of the first body against the second, in the tangent plane
/// [m/s]; normal_force, predicted_normal_force: the normal forces that the Coulomb limit counts, at t and t + dt [N].
template <Friction friction, class R> [[gnu::always_inline]] inline BasicTangentialAction<R>
predict_tangential(const BasicPredictedLaw<R> &contact, const BasicVec3<R> &spring, const BasicVec3<R> &slip_velocity,
                   const R &normal_force, const R &predicted_normal_force) {
  const BasicLinearLaw<R> &law = contact.law;
  if constexpr (friction == Friction::spring_and_dashpot)
    return predict_with_spring_limited(contact, spring, slip_velocity, law.friction * normal_force,
                                       law.friction * predicted_normal_force);
  const BasicVec3<R> now = sticking_friction(law.tangential_stiffness, law.tangential_damping, spring, slip_velocity);
  const BasicVec3<R> end = sticking_friction(contact.predicted_tangential_stiffness,
                                             contact.predicted_tangential_damping, spring, slip_velocity);
  const R limit = law.friction * normal_force;
  const R end_limit = law.friction * predicted_normal_force;
  if (all_surely_stick(limit, dot(now, now)) && all_surely_stick(end_limit, dot(end, end))) return {now, end};
  return {coulomb_factor(limit / norm(now)) * now, coulomb_factor(end_limit / norm(end)) * end};
}

/// Of a single contact the two are a pack: one instruction takes both roots, one both quotients.
template <Friction friction>
[[gnu::always_inline]] inline TangentialAction predict_tangential(const PredictedLaw &contact, const Vec3 &spring,
                                                                  const Vec3 &slip_velocity, double normal_force,
                                                                  double predicted_normal_force) {
  if constexpr (friction == Friction::spring_and_dashpot)
    return predict_with_spring_limited(contact, spring, slip_velocity, contact.law.friction * normal_force,
                                       contact.law.friction * predicted_normal_force);
  using Two = Pack<2>;
  const auto two = [](double now, double end) { return Two(Two::Values{now, end}); };
  const LinearLaw &law = contact.law;
  const BasicVec3<Two> both =
      sticking_friction<Two>(two(law.tangential_stiffness, contact.predicted_tangential_stiffness),
                             two(law.tangential_damping, contact.predicted_tangential_damping),
                             {spring.x, spring.y, spring.z}, {slip_velocity.x, slip_velocity.y, slip_velocity.z});
  const Two ratio = law.friction * two(normal_force, predicted_normal_force) / norm(both);
  const auto limited = [&](int k) {
    return coulomb_factor(ratio.values[k]) * Vec3{both.x.values[k], both.y.values[k], both.z.values[k]};
  };
  return {limited(0), limited(1)};
}

} // namespace cfpm
