// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_geometry.h"
#include "contact_step.h"
#include "mean_friction.h"
#include "normal_impulse.h"
#include "oscillator.h"

namespace cfpm {

/// The tangential spring at the beginning of a step [m]. Between evaluations a contact carries it less half a step of
/// the slip velocity that it then really has: what the other contacts add to the slip counts, by the trapezoid.
inline Vec3 spring_at_start(const StoredSpring &stored, const ContactGeometry &g) {
  if (!stored.advance) return vec3(stored.now);
  return tangential_part(vec3(stored.values) + 0.5 * stored.dt * g.slip_velocity, g.normal);
}

/// What a contact does to its first body over a step dt; it acts during the last span of it.
/// Bodies stick as long as the tangential impulse stays below friction times the normal one; else they slide all the
/// time, with a friction that is proportional to the normal force at every instant.
/// An isolated contact is followed exactly, in velocity, place and spring. One of a crowd, where a body has others, is
/// held by them: there positions move by the mean force, as they do for the others, and the spring by that same way,
/// or a heap at rest would creep; and bodies that stick come to rest, they do not swing back.
/// Kind: LinearImpulse or HertzImpulse; cohesive: what else presses the bodies together as far as Coulomb counts it [N]
template <Friction friction, class Kind>
MeanForce mean_force_of_impulse(const Kind &kind, const NormalImpulse &normal, const ContactGeometry &g, double span,
                                bool crowded, const StoredSpring &stored, double cohesive) {
  const double dt = kind.dt();
  const bool has_spring = friction == Friction::spring_and_dashpot;
  if (normal.contact_time == 0.0) {
    if (has_spring) {
      set({}, stored.values);
      set({}, stored.now);
    }
    return {};
  }
  const Vec3 turned = g.normal + 0.5 * normal.contact_time * g.turning;
  const Vec3 n = (1.0 / norm(turned)) * turned; // halfway through the contact
  Vec3 impulse = normal.impulse * n;
  Vec3 moment = normal.moment * n;
  Vec3 torque{};
  if constexpr (friction != Friction::none) {
    const Vec3 &slip = g.slip_velocity;
    const bool touched_now = span < dt;
    const Vec3 spring = has_spring && !touched_now ? spring_at_start(stored, g) : Vec3{};

    const double mass = kind.tangential_mass();
    const Propagator stick = kind.stick(normal, crowded);
    const Vec3 end_slip = stick.rate_from_displacement * spring + stick.rate_from_rate * slip;
    const Vec3 sticking = mass * (end_slip - slip);
    const double limit = kind.friction() * std::fabs(normal.impulse + cohesive * normal.contact_time);
    const double size = norm(sticking);
    const double factor = coulomb_factor(limit / size);
    const Vec3 tangential = factor * tangential_part(sticking, n);
    const bool slides = factor < 1.0;
    // of a sliding contact the spring that without slip would stick at the limit
    const double per_spring = -mass * stick.rate_from_displacement;
    const Vec3 sliding_spring = slides && per_spring > 0.0 ? -(limit / (per_spring * size)) * sticking : Vec3{};
    const Vec3 end_spring = stick.displacement_from_displacement * spring + stick.displacement_from_rate * slip;
    if (slides && normal.impulse > 0.0)
      moment = moment + (normal.moment / normal.impulse) * tangential;
    else if (!slides)
      moment = moment + mass * (end_spring - spring + (span - normal.contact_time) * end_slip - span * slip);
    if (has_spring) {
      Vec3 next{};
      if (normal.contact_time < span)
        next = {}; // released
      else if (crowded && !touched_now)
        next = (slides ? sliding_spring : spring) + 0.5 * dt * slip;
      else
        next = (slides ? sliding_spring : end_spring) - 0.5 * dt * (slip + (1.0 / mass) * tangential);
      set(next, stored.values);
      set(spring, stored.now);
    }
    impulse = impulse + tangential;
    torque = cross(n, tangential);
  }
  const double per_step = 1.0 / dt;
  const Vec3 shift = crowded ? Vec3{} : moment - 0.5 * dt * impulse;
  return {per_step * impulse, per_step * torque, shift};
}

} // namespace cfpm
