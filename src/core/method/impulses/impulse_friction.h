// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/method/impulses/crowd_response.h"
#include "core/method/impulses/normal_impulse.h"
#include "core/motion/oscillator.h"

#include <cmath>

namespace cfpm {

/// The tangential spring at the beginning of a step [m]. Between evaluations a contact carries it less half a step of
/// the slip velocity that it then really has: what the other contacts add to the slip counts, by the trapezoid.
inline Vec3 spring_at_start(const StoredSpring &stored, const ContactGeometry &g) {
  if (!stored.advance) return vec3(stored.now);
  return tangential_part(vec3(stored.values) + 0.5 * stored.dt * g.slip_velocity, g.normal);
}

/// The unit normal halfway through a contact that lasts this long [s].
inline Vec3 normal_halfway(const ContactGeometry &g, double contact_time) {
  const Vec3 turned = g.normal + 0.5 * contact_time * g.normal_rate;
  return (1.0 / norm(turned)) * turned;
}

/// What friction does to the first body over a step.
struct FrictionImpulse {
  Vec3 impulse;     ///< [N s]
  Vec3 levered;     ///< the same, every part of it times its lever over the one at the beginning [N s]
  Vec3 time_moment; ///< the integral of the force times the time that is left [N s^2]
  Vec3 next;        ///< that the spring is carried on as, see spring_at_start() [m]
};

/// Of an isolated contact, in equal parts of it that stick or slide, with the overlap and the tangential stiffness that
/// each has.
template <class Parameters> FrictionImpulse friction_alone(const Parameters &parameters, const NormalImpulse &normal,
                                                           const ContactGeometry &g, double span, const Vec3 &start,
                                                           double cohesive) {
  const int parts = parts_of_contact(normal.contact_time, normal.duration);
  const double part = normal.contact_time / parts;
  const double mass = parameters.tangential_mass();
  const double levers = g.lever_j > 0.0 ? g.lever_i + g.lever_j : 2.0 * g.lever_i;
  const auto slackened = [&](const Vec3 &spring, double force, double stiffness) {
    return coulomb_factor(parameters.friction() * std::fabs(force + cohesive) / (stiffness * norm(spring))) * spring;
  };
  Vec3 slip = g.slip_velocity;
  Vec3 spring = slackened(start, normal.force, parameters.spring_stiffness(g.overlap));
  Vec3 way{};
  FrictionImpulse all{};
  const auto add_part = [&](const NormalPart &p, const Propagator &stick) {
    Vec3 end_slip = stick.rate_from_displacement * spring + stick.rate_from_rate * slip;
    Vec3 moved = stick.displacement_from_displacement * spring + stick.displacement_from_rate * slip - spring;
    Vec3 impulse = mass * (end_slip - slip);
    const double factor =
        coulomb_factor(parameters.friction() * std::fabs(p.impulse + cohesive * part) / norm(impulse));
    if (factor < 1.0) {
      impulse = factor * impulse;
      end_slip = slip + (1.0 / mass) * impulse;
      moved = 0.5 * part * (slip + end_slip);
    }
    all.impulse = all.impulse + impulse;
    all.levered = all.levered + (1.0 - (p.overlap - g.overlap) / levers) * impulse;
    way = way + moved;
    slip = end_slip;
    spring = slackened(spring + moved, p.end_force, p.tangential_stiffness);
  };
  parameters.in_parts(g.overlap, normal.closing_speed, normal.contact_time, parts, add_part);
  all.time_moment = mass * (way + (span - normal.contact_time) * slip - span * g.slip_velocity);
  if (normal.contact_time == span) all.next = spring - 0.5 * parameters.dt() * slip;
  return all;
}

/// See mean_force_of_impulse(). Never inlined: the step of a crowded contact needs its registers.
template <Friction friction, class Parameters>
[[gnu::noinline]] MeanForce mean_force_alone(const Parameters &parameters, const NormalImpulse &normal,
                                             const ContactGeometry &g, double span, const Vec3 &spring,
                                             const StoredSpring &stored, double cohesive) {
  const double dt = parameters.dt();
  const double per_step = 1.0 / dt;
  const Vec3 n = normal_halfway(g, normal.contact_time);
  Vec3 impulse = normal.impulse * n;
  Vec3 time_moment = normal.time_moment * n;
  Vec3 torque{};
  if constexpr (friction != Friction::none) {
    const FrictionImpulse f = friction_alone(parameters, normal, g, span, spring, cohesive);
    if constexpr (friction == Friction::spring_and_dashpot) set(f.next, stored.values);
    impulse = impulse + tangential_part(f.impulse, n);
    time_moment = time_moment + f.time_moment;
    torque = cross(n, f.levered);
  }
  return {per_step * impulse, per_step * torque, time_moment - 0.5 * dt * impulse};
}

/// The same in a crowd, where nothing else is asked for.
struct CrowdedFriction {
  Vec3 impulse;
  Vec3 next;
};

/// Of a contact in a crowd, at once: bodies stick as long as the tangential impulse stays below friction times the
/// normal one; else they slide all the time, with a spring that without slip would stick at the limit.
template <class Parameters> [[gnu::always_inline]] inline CrowdedFriction
friction_in_crowd(const Parameters &parameters, const NormalImpulse &normal, const ContactGeometry &g, double span,
                  double crowding, const Vec3 &spring, double cohesive) {
  const Vec3 &slip = g.slip_velocity;
  const CrowdResponse stick = parameters.slip_in_crowd(normal);
  const double mass = stick.relaxation(crowding) * parameters.tangential_mass();
  const double from_spring = stick.softening * stick.rate_from_displacement;
  const Vec3 sticking = mass * (from_spring * spring + (stick.rate_from_rate - 1.0) * slip);
  const double limit = parameters.friction() * std::fabs(normal.impulse + cohesive * normal.contact_time);
  // both limits side by side: the spring's is that without slip it would stick at the limit
  const TwoDoubles squared{dot(sticking, sticking), dot(spring, spring)};
  const TwoDoubles limits = limit / TwoDoubles{1.0, mass * std::fabs(from_spring)};
  const TwoDoubles ratio = limits / TwoDoubles{std::sqrt(squared[0]), std::sqrt(squared[1])};
  Vec3 next{};
  if (normal.contact_time == span) next = coulomb_factor(ratio[1]) * spring + (span - 0.5 * parameters.dt()) * slip;
  return {coulomb_factor(ratio[0]) * sticking, next};
}

/// What a contact does to its first body over a step dt; it acts during the last span of it.
/// An isolated contact is followed exactly, in velocity, place and spring. One of a crowd, where a body has others, is
/// held by them: there positions move by the mean force, as they do for the others, and the spring by that same way,
/// or a heap at rest would creep; bodies that stick come to rest, they do not swing back; and it gives what
/// CrowdResponse leaves of its impulse.
/// Parameters: LinearImpulse or HertzImpulse; cohesive: what else presses the bodies together as far as Coulomb counts
/// it [N]
template <Friction friction, class Parameters>
[[gnu::always_inline]] inline MeanForce mean_force_of_impulse(const Parameters &parameters, const NormalImpulse &normal,
                                                              const ContactGeometry &g, double span, double crowding,
                                                              const StoredSpring &stored, double cohesive) {
  constexpr bool has_spring = friction == Friction::spring_and_dashpot;
  if (normal.contact_time == 0.0) {
    if constexpr (has_spring) {
      set({}, stored.values);
      set({}, stored.now);
    }
    return {};
  }
  const double dt = parameters.dt();
  const double per_step = 1.0 / dt;
  const Vec3 spring = has_spring && span == dt ? spring_at_start(stored, g) : Vec3{};
  if constexpr (has_spring) set(spring, stored.now);
  if (crowding == 1.0) return mean_force_alone<friction>(parameters, normal, g, span, spring, stored, cohesive);
  Vec3 impulse = normal.impulse * g.normal;
  Vec3 torque{};
  if constexpr (friction != Friction::none) {
    const CrowdedFriction f = friction_in_crowd(parameters, normal, g, span, crowding, spring, cohesive);
    if constexpr (has_spring) set(f.next, stored.values);
    impulse = impulse + f.impulse;
    torque = cross(g.normal, f.impulse);
  }
  return {per_step * impulse, per_step * torque, {}};
}

} // namespace cfpm
