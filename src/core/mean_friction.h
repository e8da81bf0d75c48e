// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_step.h"

#include <cmath>

namespace cfpm {

/// What acts in the tangent plane, limited by Coulomb (Eqs. 6, 10).
enum class Friction { none, dashpot, spring_and_dashpot };

/// Where a host keeps the tangential spring of a contact, null without one, and how to read it.
struct StoredSpring {
  double *values;
  double dt;             ///< step that it leads by half, as an impulse lags: of the evaluation before this one [s]
  bool advance;          ///< false where a state is evaluated again
  double *now = nullptr; ///< of the last evaluation, where the method keeps it apart
};

/// Mean friction over the step on the first body [N]. normal_force, predicted_normal_force: what
/// Coulomb's limit counts at t and t + dt [N].
/// Inlined by order: among the many loops that contain it the compiler otherwise runs out of budget, and a call
/// that passes a ContactStep through memory costs a tenth of the step.
template <Friction friction>
[[gnu::always_inline]] inline Vec3 mean_friction(const ContactStep &contact, const ContactGeometry &g,
                                                 [[maybe_unused]] const StoredSpring &stored, double normal_force,
                                                 double predicted_normal_force) {
  if constexpr (friction == Friction::none) return {};
  Vec3 spring{};
  if constexpr (friction == Friction::spring_and_dashpot) {
    MidStepSpring mid_step(vec3(stored.values), stored.dt);
    if (stored.advance)
      spring = mid_step.advance(contact.law, g.slip_velocity, g.normal, contact.law.friction * normal_force);
    else
      spring = mid_step.now(g.slip_velocity);
    if (stored.dt != contact.dt) mid_step.change_step(g.slip_velocity, contact.dt);
    set(mid_step.stored(), stored.values);
  }
  return predict_tangential(contact, spring, g.slip_velocity, normal_force, predicted_normal_force).mean();
}

/// On the first body over the step; the second gets the opposite force.
struct MeanForce {
  Vec3 force;  ///< [N]
  Vec3 moment; ///< n cross friction [N]: the torque on either body is minus its lever times this
  /// What the displacement over the step is short of with the mean force acting all the time, times the mass [kg m]:
  /// the integral of the force times the time that is left, less dt^2/2 times its mean. 0 in the method of the paper.
  Vec3 shift{};
};

/// normal: what predict_normal() makes of the contact; cohesive: what else presses the bodies together as far
/// as Coulomb's limit counts it [N].
template <Friction friction>
[[gnu::always_inline]] inline MeanForce mean_force(const ContactStep &contact, const ContactGeometry &g,
                                                   const NormalAction &normal, const StoredSpring &stored,
                                                   double cohesive = 0.0) {
  const Vec3 tangential = mean_friction<friction>(contact, g, stored, std::fabs(normal.force + cohesive),
                                                  std::fabs(normal.predicted + cohesive));
  return {normal.mean() * g.normal + tangential, cross(g.normal, tangential), {}};
}

} // namespace cfpm
