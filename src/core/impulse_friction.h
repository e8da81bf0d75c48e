// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_geometry.h"
#include "contact_step.h"
#include "mean_friction.h"
#include "normal_impulse.h"
#include "oscillator.h"

#include <algorithm>
#include <cmath>

namespace cfpm {

/// The tangential spring at the beginning of a step [m]. Between evaluations a contact carries what its isolated
/// motion makes of the spring, less half a step of the slip velocity that this ends with: half a step of the slip
/// velocity that it then really has completes it, so that what the other contacts add to the slip counts, by the
/// trapezoid, and an isolated contact stays exact. limit: Coulomb's [N].
inline Vec3 spring_at_start(const StoredSpring &stored, const ContactGeometry &g) {
  if (!stored.advance) return vec3(stored.now);
  return tangential_part(vec3(stored.values) + 0.5 * stored.dt * g.slip_velocity, g.normal);
}

/// What friction does to the first body.
struct FrictionImpulse {
  Vec3 impulse; ///< [N s]
  Vec3 turning; ///< the same, every part of it times its lever over the one at the beginning [N s]
  Vec3 moment;  ///< of the force times the time that is left [N s^2]
  Vec3 spring;  ///< at the end of the contact [m]
};

/// In equal parts of the contact that stick or slide, with the overlap and the tangential stiffness that each has.
/// Never inlined: the step of a resting contact needs its registers.
template <class Kind> [[gnu::noinline]] FrictionImpulse friction_in_parts(const Kind &kind, const NormalImpulse &normal,
                                                                          const ContactGeometry &g, double span,
                                                                          const Vec3 &start, double cohesive,
                                                                          int parts) {
  const double part = normal.contact_time / parts;
  const double mass = kind.tangential_mass();
  const double levers = g.lever_j > 0.0 ? g.lever_i + g.lever_j : 2.0 * g.lever_i;
  const auto slackened = [&](const Vec3 &spring, double force, double stiffness) {
    return coulomb_factor(kind.friction() * std::fabs(force + cohesive) / (stiffness * norm(spring))) * spring;
  };
  Vec3 slip = g.slip_velocity;
  Vec3 spring = slackened(start, normal.force, kind.spring_stiffness(g.overlap));
  Vec3 way{};
  FrictionImpulse all{};
  const auto add_part = [&](const NormalPart &p, const Propagator &stick) {
    Vec3 end_slip = stick.rate_from_displacement * spring + stick.rate_from_rate * slip;
    Vec3 moved = stick.displacement_from_displacement * spring + stick.displacement_from_rate * slip - spring;
    Vec3 impulse = mass * (end_slip - slip);
    const double factor = coulomb_factor(kind.friction() * std::fabs(p.impulse + cohesive * part) / norm(impulse));
    if (factor < 1.0) {
      impulse = factor * impulse;
      end_slip = slip + (1.0 / mass) * impulse;
      moved = 0.5 * part * (slip + end_slip);
    }
    all.impulse = all.impulse + impulse;
    all.turning = all.turning + (1.0 - (p.overlap - g.overlap) / levers) * impulse;
    way = way + moved;
    slip = end_slip;
    spring = slackened(spring + moved, p.end_force, p.tangential_stiffness);
  };
  kind.in_parts(g.overlap, normal.closing_speed, normal.contact_time, parts, add_part);
  all.moment = mass * (way + (span - normal.contact_time) * slip - span * g.slip_velocity);
  all.spring = spring;
  return all;
}

/// Over a step in contact that only sticks or only slides: bodies stick as long as the tangential impulse stays below
/// friction times the normal one; else they slide all the time, with a friction that is proportional to the normal
/// force at every instant.
template <class Kind> FrictionImpulse friction_at_once(const Kind &kind, const NormalImpulse &normal,
                                                       const ContactGeometry &g, const Vec3 &spring, double cohesive) {
  const double dt = kind.dt();
  const double mass = kind.tangential_mass();
  const Vec3 &slip = g.slip_velocity;
  const Propagator stick = kind.stick(normal);
  const Vec3 end_slip = stick.rate_from_displacement * spring + stick.rate_from_rate * slip;
  const Vec3 sticking = mass * (end_slip - slip);
  const double limit = kind.friction() * std::fabs(normal.impulse + cohesive * dt);
  const double factor = coulomb_factor(limit / norm(sticking));
  if (factor < 1.0) {
    const Vec3 impulse = factor * sticking;
    const Vec3 moment = normal.impulse > 0.0 ? (normal.moment / normal.impulse) * impulse : Vec3{};
    // what has slipped, but not more than makes the next step stick at the limit if there is no slip
    const double per_spring = -mass * stick.rate_from_displacement;
    const Vec3 end = spring + dt * (slip + (0.5 / mass) * impulse);
    return {impulse, impulse, moment, coulomb_factor(limit / (per_spring * norm(end))) * end};
  }
  const Vec3 end = stick.displacement_from_displacement * spring + stick.displacement_from_rate * slip;
  return {sticking, sticking, mass * (end - spring - dt * slip), end};
}

/// How far the bodies are alone, from 0 to 1. Their normal force changes inside the step as if they were where they
/// move against each other by more than a quarter of what the contact changes in the step. At rest it does not, because
/// of the others: only its impulse is to be trusted. Without a jump between: rounding errors would grow at it.
template <class Kind> double collision(const Kind &kind, const NormalImpulse &normal) {
  return std::clamp(8.0 * kind.mass() * std::fabs(normal.closing_speed) / normal.impulse - 1.0, 0.0, 1.0);
}

/// f: of friction_at_once(). Its answer is then exact.
template <class Kind> bool sticks_all_along(const Kind &kind, const NormalImpulse &normal, const ContactGeometry &g,
                                            const Vec3 &spring, const FrictionImpulse &f, double cohesive) {
  const double limit = kind.friction() * (normal.impulse + cohesive * kind.dt());
  return dot(f.impulse, f.impulse) < 0.999 * limit * limit &&
         kind.sticks(normal.force + cohesive, spring, g.slip_velocity) &&
         kind.sticks(normal.end_force + cohesive, f.spring,
                     g.slip_velocity + (1.0 / kind.tangential_mass()) * f.impulse);
}

inline FrictionImpulse mix(const FrictionImpulse &a, const FrictionImpulse &b, double part_of_b) {
  const auto mixed = [&](const Vec3 &x, const Vec3 &y) { return x + part_of_b * (y - x); };
  return {mixed(a.impulse, b.impulse), mixed(a.turning, b.turning), mixed(a.moment, b.moment),
          mixed(a.spring, b.spring)};
}

/// What a contact does to its first body over a step dt; it acts during the last span of it.
/// Kind: LinearImpulse or HertzImpulse; cohesive: what else presses the bodies together as far as Coulomb counts it [N]
template <Friction friction, class Kind> MeanForce mean_force_of_impulse(const Kind &kind, const NormalImpulse &normal,
                                                                         const ContactGeometry &g, double span,
                                                                         const StoredSpring &stored, double cohesive) {
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
    constexpr int parts_of_contact = 12;
    Vec3 spring{};
    if (has_spring && span == dt) spring = spring_at_start(stored, g);
    const bool lasts = normal.contact_time == span;
    FrictionImpulse f;
    if (span < dt || !lasts) {
      f = friction_in_parts(kind, normal, g, span, spring, cohesive, parts_of_contact);
    } else {
      f = friction_at_once(kind, normal, g, spring, cohesive);
      const double alone = collision(kind, normal);
      if (alone > 0.0 && !sticks_all_along(kind, normal, g, spring, f, cohesive))
        f = mix(f, friction_in_parts(kind, normal, g, span, spring, cohesive, parts_of_step), alone);
    }
    const Vec3 tangential = tangential_part(f.impulse, n);
    if (has_spring) {
      const Vec3 end_slip = g.slip_velocity + (1.0 / kind.tangential_mass()) * tangential;
      set(lasts ? f.spring - 0.5 * dt * end_slip : Vec3{}, stored.values);
      set(spring, stored.now);
    }
    impulse = impulse + tangential;
    moment = moment + f.moment;
    torque = cross(n, f.turning);
  }
  const double per_step = 1.0 / dt;
  return {per_step * impulse, per_step * torque, moment - 0.5 * dt * impulse};
}

} // namespace cfpm
