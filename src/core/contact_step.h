// SPDX-License-Identifier: GPL-2.0-or-later
// What one contact does to its two bodies over one step: the contact force prediction method of
// Tokoro, Okaya and Sadaki, KONA 23 (2005), Eqs. 20-40. The force now and the force predicted for
// t + dt from the isolated two-body problem are averaged; all other contacts are left out of the
// prediction on purpose. A host finds the contacts and applies the impulses; no physics is there.
#pragma once

#include "linear_law.h"
#include "oscillator.h"
#include "predictor.h"
#include "vec3.h"

namespace cfpm {

/// Everything about a contact that depends only on its materials, masses and the step: computed once
/// per kind of contact and kept.
struct ContactStep {
  LinearLaw law;
  Propagator normal;     ///< of (overlap, closing speed), reduced mass m*
  Propagator tangential; ///< of (spring, slip velocity), tangential reduced mass mt
  double dt;             ///< [s]

  /// 1/mt = 1/m* + ri^2/Ii + rj^2/Ij, both [kg].
  ContactStep(const LinearLaw &contact_law, double reduced_mass, double tangential_reduced_mass,
              const Predictor &predictor, double step)
      : law(contact_law),
        normal(predictor.propagator({contact_law.normal_stiffness, contact_law.normal_damping, reduced_mass}, step)),
        tangential(predictor.propagator(
            {contact_law.tangential_stiffness, contact_law.tangential_damping, tangential_reduced_mass}, step)),
        dt(step) {}
};

struct NormalAction {
  double force;           ///< f_n(t) >= 0 [N]
  double predicted;       ///< f*_n(t + dt), clamped by Eq. 36 [N]
  double separation_time; ///< Eq. 39 where the contact ends inside the step, else dt [s]

  double impulse(double dt) const { return 0.5 * dt * (force + predicted); }
};

struct TangentialAction {
  Vec3 force;     ///< f_s(t) on the first body [N]
  Vec3 predicted; ///< f*_s(t + dt) on the first body [N]

  Vec3 impulse(double dt) const { return 0.5 * dt * (force + predicted); }
};

/// Eqs. 2, 35, 36, 39.
inline NormalAction predict_normal(const ContactStep &contact, double overlap, double closing_speed) {
  const OscillatorState end = contact.normal({overlap, closing_speed});
  const double force = contact.law.normal_force(overlap, closing_speed);
  const double unclamped = contact.law.normal_stiffness * end.displacement + contact.law.normal_damping * end.rate;
  if (unclamped >= 0.0) return {force, unclamped, contact.dt};
  return {force, 0.0, contact.dt * force / (force - unclamped)};
}

/// Eqs. 6, 10, 37, 40. With the literal reading of Eqs. 36 and 40 the prediction vanishes for a
/// contact that separates inside the step, so Eq. 38 never contributes.
/// spring: slip accumulated in this contact (Eq. 7), in the tangent plane [m]; slip_velocity: of the
/// first body against the second, in the tangent plane [m/s]; normal_force, predicted_normal_force:
/// the normal forces that the Coulomb limit counts, at t and t + dt [N].
inline TangentialAction predict_tangential(const ContactStep &contact, const Vec3 &spring, const Vec3 &slip_velocity,
                                           double normal_force, double predicted_normal_force) {
  const LinearLaw &law = contact.law;
  const Propagator &map = contact.tangential;
  const auto force = [&law](const Vec3 &s, const Vec3 &w) {
    return -(law.tangential_stiffness * s + law.tangential_damping * w);
  };
  const Vec3 end_spring = map.displacement_from_displacement * spring + map.displacement_from_rate * slip_velocity;
  const Vec3 end_velocity = map.rate_from_displacement * spring + map.rate_from_rate * slip_velocity;
  return {limited(force(spring, slip_velocity), law.friction * normal_force),
          limited(force(end_spring, end_velocity), law.friction * predicted_normal_force)};
}

/// The tangential spring, Eq. 7. Positions advance by the trapezoid of the velocities, so does the
/// slip; carrying the spring at mid-step, s(t + dt/2) = s(t) + w(t) dt/2, does that with one stored
/// vector (a leapfrog), and a contact first seen somewhere inside its first step starts with
/// w dt/2, the mean of what it may have slipped.
class MidStepSpring {
public:
  /// stored: what the contact carries from step to step; zero for a new contact [m]
  explicit MidStepSpring(const Vec3 &stored) : stored_(stored) {}

  /// Moves the spring on to the middle of the coming step and into the tangent plane of n, and
  /// slackens it where it would pull harder than Coulomb's limit [N].
  void advance(const LinearLaw &law, const Vec3 &slip_velocity, const Vec3 &n, double dt, double limit) {
    stored_ = tangential_part(stored_ + dt * slip_velocity, n);
    if (law.tangential_stiffness <= 0.0) {
      stored_ = {};
      return;
    }
    const Vec3 spring = now(slip_velocity, dt);
    const double longest = limit / law.tangential_stiffness;
    if (dot(spring, spring) > longest * longest) stored_ = limited(spring, longest) + 0.5 * dt * slip_velocity;
  }

  /// The spring at t, the same to the last bit whether just advanced or read back later.
  Vec3 now(const Vec3 &slip_velocity, double dt) const {
    return stored_ == Vec3{} ? Vec3{} : stored_ - 0.5 * dt * slip_velocity;
  }

  const Vec3 &stored() const { return stored_; }

private:
  Vec3 stored_;
};

} // namespace cfpm
