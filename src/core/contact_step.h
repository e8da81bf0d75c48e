// SPDX-License-Identifier: GPL-2.0-or-later
// What one contact does to its two bodies over one step: the contact force prediction method of
// Tokoro, Okaya and Sadaki, KONA 23 (2005), Eqs. 20-40. The force now and the force predicted for
// t + dt from the isolated two-body problem are averaged; all other contacts are left out of the
// prediction on purpose. A host finds the contacts and applies the mean forces; no physics is there.
#pragma once

#include "contact_geometry.h"
#include "linear_law.h"
#include "vec3.h"

#include <algorithm>
#include <cmath>

namespace cfpm {

/// A contact in the state of one instant t: its law at this overlap, and what is predicted for t + dt.
/// LinearContact and NonlinearContact make it; everything below is the same for every law.
struct ContactStep {
  LinearLaw law;                         ///< force at t
  double predicted_normal_force;         ///< at t + dt, not yet clamped [N]
  double predicted_tangential_stiffness; ///< of the force at t + dt from the spring at t [N/m]
  double predicted_tangential_damping;   ///< and from the slip velocity at t [kg/s]
  double dt;                             ///< [s]
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

/// Coulomb's limit, over the magnitude of what it limits, as a factor on that: below 1 where the contact slides.
/// Without a branch, because in a bed it would be mispredicted at every other contact; 0/0 counts as sticking.
inline double coulomb_factor(double limit_over_magnitude) { return std::min(1.0, limit_over_magnitude); }

/// Two numbers side by side in one register: one instruction takes both roots, one both quotients.
using TwoDoubles = double __attribute__((vector_size(16)));

/// Eqs. 2, 35, 36, 39.
inline NormalAction predict_normal(const ContactStep &contact, const ContactGeometry &g) {
  const double force = std::max(0.0, contact.law.normal_force(g.overlap, g.closing_speed));
  const double end = contact.predicted_normal_force;
  if (end >= 0.0) return {force, end, contact.dt};
  return {force, 0.0, contact.dt * force / (force - end)};
}

/// Eqs. 6, 10, 37, 40, now and predicted side by side. With the literal reading of Eqs. 36 and 40 the prediction
/// vanishes for a contact that separates inside the step, so Eq. 38 never contributes. spring: slip accumulated in this
/// contact (Eq. 7), in the tangent plane [m]; slip_velocity: of the first body against the second, in the tangent plane
/// [m/s]; normal_force, predicted_normal_force: the normal forces that the Coulomb limit counts, at t and t + dt [N].
inline TangentialAction predict_tangential(const ContactStep &contact, const Vec3 &spring, const Vec3 &slip_velocity,
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

/// The tangential spring, Eq. 7. Positions advance by the trapezoid of the velocities, so does the
/// slip; carrying the spring at mid-step, s(t + dt/2) = s(t) + w(t) dt/2, does that with one stored
/// vector (a leapfrog), and a contact first seen somewhere inside its first step starts with
/// w dt/2, the mean of what it may have slipped.
class MidStepSpring {
public:
  /// stored: what the contact carries from step to step, zero for a new contact [m]; dt: of the step
  /// that it leads by half [s]
  MidStepSpring(const Vec3 &stored, double dt) : stored_(stored), dt_(dt) {}

  /// Moves the spring on to the middle of the coming step and into the tangent plane of n, and
  /// slackens it where it would pull harder than Coulomb's limit [N]. Returns the spring at t.
  Vec3 advance(const LinearLaw &law, const Vec3 &slip_velocity, const Vec3 &n, double limit) {
    const Vec3 half_step = 0.5 * dt_ * slip_velocity;
    const Vec3 spring = tangential_part(stored_ + dt_ * slip_velocity, n) - half_step;
    stored_ = coulomb_factor(limit / (law.tangential_stiffness * norm(spring))) * spring + half_step;
    return stored_ - half_step; // rounded as now() will round it
  }

  /// The spring at t, to the last bit what advance() returned for this t. A stored zero is no spring.
  Vec3 now(const Vec3 &slip_velocity) const { return stored_ == Vec3{} ? Vec3{} : stored_ - 0.5 * dt_ * slip_velocity; }

  /// The same spring at t, leading by half of another step from now on.
  void change_step(const Vec3 &slip_velocity, double dt) {
    if (!(stored_ == Vec3{})) stored_ = now(slip_velocity) + 0.5 * dt * slip_velocity;
    dt_ = dt;
  }

  const Vec3 &stored() const { return stored_; }

private:
  Vec3 stored_;
  double dt_;
};

} // namespace cfpm
