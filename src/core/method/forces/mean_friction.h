// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/method/forces/predicted_law.h"

namespace cfpm {

/// Moves the spring that a host keeps on to the coming step. Returns the spring at t. limit: of Coulomb [N]. Inlined by
/// order, see mean_friction().
template <Friction friction> [[gnu::always_inline]] inline Vec3
move_on(const StoredSpring &stored, const PredictedLaw &contact, const ContactGeometry &g, double limit) {
  MidStepSpring mid_step(vec3(stored.values), stored.dt);
  const Vec3 spring = stored.advance ? mid_step.advance<friction>(contact.law, g.slip_velocity, g.normal, limit)
                                     : mid_step.now(g.slip_velocity);
  if (stored.dt != contact.dt) mid_step.change_step(g.slip_velocity, contact.dt);
  set(mid_step.stored(), stored.values);
  return spring;
}

/// Mean friction over the step on the first body [N]. Spring: a StoredSpring, or what reads and writes those of a pack;
/// normal_force, predicted_normal_force: what Coulomb's limit counts at t and t + dt [N].
/// Inlined by order: among the many loops that contain it the compiler otherwise runs out of budget, and a call
/// that passes a PredictedLaw through memory costs a tenth of the step.
template <Friction friction, class R, class Spring = StoredSpring> [[gnu::always_inline]] inline BasicVec3<R>
mean_friction(const BasicPredictedLaw<R> &contact, const BasicContactGeometry<R> &g,
              [[maybe_unused]] const Spring &stored, const R &normal_force, const R &predicted_normal_force) {
  if constexpr (friction == Friction::none) return {};
  BasicVec3<R> spring{};
  if constexpr (has_spring(friction))
    spring = move_on<friction>(stored, contact, g, contact.law.friction * normal_force);
  return predict_tangential<friction>(contact, spring, g.slip_velocity, normal_force, predicted_normal_force).mean();
}

/// Predicted: a BasicPredictedLaw, or what limit_forces() else knows; normal: what predict_normal() makes of it;
/// cohesive: see limit_forces() [N].
template <Friction friction, class Predicted, class R, class Spring = StoredSpring>
[[gnu::always_inline]] inline BasicMeanForce<R> mean_force(const Predicted &contact, const BasicContactGeometry<R> &g,
                                                           const BasicNormalAction<R> &normal, const Spring &stored,
                                                           const R &cohesive = 0.0) {
  const BasicLimitForces<R> limit = limit_forces(contact, normal, cohesive);
  const BasicVec3<R> tangential = mean_friction<friction>(contact, g, stored, limit.now, limit.predicted);
  return {normal.mean() * g.normal + tangential, cross(g.normal, tangential), {}};
}

} // namespace cfpm
