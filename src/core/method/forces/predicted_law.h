// SPDX-License-Identifier: GPL-2.0-or-later
// What one contact does to its two bodies over one step: the contact force prediction method of
// Tokoro, Okaya and Sadaki, KONA 23 (2005), Eqs. 20-40. The force now and the force predicted for
// t + dt from the isolated two-body problem are averaged; all other contacts are left out of the
// prediction on purpose. A host finds the contacts and applies the mean forces; no physics is there.
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/law/linear_law.h"
#include "core/numbers/vec3.h"

#include <algorithm>
#include <cmath>

namespace cfpm {

/// A contact in the state of one instant t: its law at this overlap, and what is predicted for t + dt.
/// LinearPrediction, IntegratedPrediction and HertzImpulse make it; everything below is the same for every law.
struct PredictedLaw {
  LinearLaw law;                         ///< force at t
  double predicted_normal_force;         ///< at t + dt, 0 of bodies that have parted, else not yet clamped [N]
  double predicted_tangential_stiffness; ///< of the force at t + dt from the spring at t [N/m]
  double predicted_tangential_damping;   ///< and from the slip velocity at t [kg/s]
  double dt;                             ///< [s]
};

/// The same of bodies that touch from then on for a time: what is predicted is for its end.
struct PredictedTouch {
  PredictedLaw law;    ///< whose dt is the span that the bodies are followed
  double contact_time; ///< in which they overlap; Eq. 39 may end it earlier [s]
};

struct NormalAction {
  double force;           ///< f_n(t) >= 0 [N]
  double predicted;       ///< f*_n(t + dt), clamped by Eq. 36 [N]
  double separation_time; ///< Eq. 39 where the contact ends inside the step, else dt [s]

  double mean() const { return 0.5 * (force + predicted); }
};

struct TangentialAction {
  Vec3 force;     ///< f_s(t) on the first body [N]
  Vec3 predicted; ///< f*_s(t + dt) on the first body [N]

  Vec3 mean() const { return 0.5 * (force + predicted); }
};

/// Eqs. 2, 35, 36, 39; with tension the contact ends where the bodies part, not by Eq. 36.
inline NormalAction predict_normal(const PredictedLaw &contact, const ContactGeometry &g) {
  const LinearLaw &law = contact.law;
  const double force = law.limited(law.normal_force(g.overlap, g.closing_speed));
  const double end = contact.predicted_normal_force;
  if (end >= law.least_force) return {force, end, contact.dt};
  return {force, law.least_force, contact.dt * force / (force - end)};
}

/// Eqs. 6, 10, 37, 40, now and predicted side by side. With the literal reading of Eqs. 36 and 40 the prediction
/// vanishes for a contact that separates inside the step, so Eq. 38 never contributes. spring: slip accumulated in this
/// contact (Eq. 7), in the tangent plane [m]; slip_velocity: of the first body against the second, in the tangent plane
/// [m/s]; normal_force, predicted_normal_force: the normal forces that the Coulomb limit counts, at t and t + dt [N].
inline TangentialAction predict_tangential(const PredictedLaw &contact, const Vec3 &spring, const Vec3 &slip_velocity,
                                           double normal_force, double predicted_normal_force) {
  const LinearLaw &law = contact.law;
  const TwoDoubles stiffness{law.tangential_stiffness, contact.predicted_tangential_stiffness};
  const TwoDoubles damping{law.tangential_damping, contact.predicted_tangential_damping};
  const TwoDoubles x = -stiffness * spring.x - damping * slip_velocity.x;
  const TwoDoubles y = -stiffness * spring.y - damping * slip_velocity.y;
  const TwoDoubles z = -stiffness * spring.z - damping * slip_velocity.z;
  const TwoDoubles squared = x * x + y * y + z * z;
  const TwoDoubles limit = law.friction * TwoDoubles{normal_force, predicted_normal_force};
  const TwoDoubles ratio = limit / TwoDoubles{std::sqrt(squared[0]), std::sqrt(squared[1])};
  return {coulomb_factor(ratio[0]) * Vec3{x[0], y[0], z[0]}, coulomb_factor(ratio[1]) * Vec3{x[1], y[1], z[1]}};
}

} // namespace cfpm
