// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/method/forces/predicted_law.h"

#include <cmath>

namespace cfpm {

/// Mean friction over the step on the first body [N]. normal_force, predicted_normal_force: what
/// Coulomb's limit counts at t and t + dt [N].
/// Inlined by order: among the many loops that contain it the compiler otherwise runs out of budget, and a call
/// that passes a PredictedLaw through memory costs a tenth of the step.
template <Friction friction>
[[gnu::always_inline]] inline Vec3 mean_friction(const PredictedLaw &contact, const ContactGeometry &g,
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

/// normal: what predict_normal() makes of the contact; cohesive: what else presses the bodies together as far
/// as Coulomb's limit counts it [N].
template <Friction friction>
[[gnu::always_inline]] inline MeanForce mean_force(const PredictedLaw &contact, const ContactGeometry &g,
                                                   const NormalAction &normal, const StoredSpring &stored,
                                                   double cohesive = 0.0) {
  const Vec3 tangential = mean_friction<friction>(contact, g, stored, std::fabs(normal.force + cohesive),
                                                  std::fabs(normal.predicted + cohesive));
  return {normal.mean() * g.normal + tangential, cross(g.normal, tangential), {}};
}

} // namespace cfpm
