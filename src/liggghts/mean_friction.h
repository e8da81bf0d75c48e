// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../core/contact_step.h"
#include "host_contact_models.h"

namespace cfpm::liggghts {

namespace models = LIGGGHTS::ContactModels;

inline Vec3 vec3(const double *host) { return {host[0], host[1], host[2]}; }

inline void add(const Vec3 &v, double *host_sum) {
  host_sum[0] += v.x;
  host_sum[1] += v.y;
  host_sum[2] += v.z;
}

/// Mean friction over the step on the first body [N] for the host's id of a tangential model.
/// spring: where the host keeps the contact's tangential spring, moved on if advance is set;
/// normal_force, predicted_normal_force: what Coulomb's limit counts at t and t + dt [N].
template <int Tangential> Vec3 mean_friction(const ContactStep &contact, const ContactGeometry &g,
                                             [[maybe_unused]] double *spring, [[maybe_unused]] bool advance,
                                             double normal_force, double predicted_normal_force) {
  if constexpr (Tangential == models::TANGENTIAL_OFF) return {};
  Vec3 stretched{};
  if constexpr (Tangential == models::TANGENTIAL_HISTORY) {
    MidStepSpring mid_step(vec3(spring));
    if (advance) {
      stretched =
          mid_step.advance(contact.law, g.slip_velocity, g.normal, contact.dt, contact.law.friction * normal_force);
      spring[0] = mid_step.stored().x;
      spring[1] = mid_step.stored().y;
      spring[2] = mid_step.stored().z;
    } else {
      stretched = mid_step.now(g.slip_velocity, contact.dt);
    }
  }
  return predict_tangential(contact, stretched, g.slip_velocity, normal_force, predicted_normal_force).mean();
}

} // namespace cfpm::liggghts
