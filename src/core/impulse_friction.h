// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_geometry.h"
#include "contact_step.h"
#include "mean_friction.h"
#include "normal_impulse.h"
#include "oscillator.h"

namespace cfpm {

/// The tangential spring at the beginning of a step [m]. Between evaluations a contact carries what its isolated
/// motion makes of the spring, less half a step of the slip velocity that this ends with: half a step of the slip
/// velocity that it then really has completes it, so that what the other contacts add to the slip counts, by the
/// trapezoid, and an isolated contact stays exact. limit: Coulomb's [N].
inline Vec3 spring_at_start(const StoredSpring &stored, const ContactGeometry &g) {
  if (!stored.advance) return vec3(stored.now);
  return tangential_part(vec3(stored.values) + 0.5 * stored.dt * g.slip_velocity, g.normal);
}

/// What friction does to the first body while it touches the second.
struct FrictionImpulse {
  Vec3 impulse; ///< [N s]
  Vec3 turning; ///< the same, each part of it with its lever over the one at the beginning [N s]
  Vec3 way;     ///< that the bodies slip [m]
  Vec3 slip;    ///< at the end [m/s]
  Vec3 spring;  ///< at the end [m]
};

/// In parts that stick or slide, each after the others, with the overlap and the tangential stiffness that it has.
template <class Kind> FrictionImpulse friction_in_parts(const Kind &kind, const NormalImpulse &normal,
                                                        const ContactGeometry &g, const Vec3 &spring, double cohesive) {
  constexpr int parts = 8;
  const double part = normal.contact_time / parts;
  const double mass = kind.tangential_mass();
  const double levers = g.lever_j > 0.0 ? g.lever_i + g.lever_j : 2.0 * g.lever_i;
  FrictionImpulse f{{}, {}, {}, g.slip_velocity, spring};
  kind.in_parts(g.overlap, normal.closing_speed, normal.contact_time, parts,
                [&](const NormalPart &p, const Propagator &stick) {
                  Vec3 slip = stick.rate_from_displacement * f.spring + stick.rate_from_rate * f.slip;
                  Vec3 end = stick.displacement_from_displacement * f.spring + stick.displacement_from_rate * f.slip;
                  Vec3 impulse = mass * (slip - f.slip);
                  const double limit = kind.friction() * std::fabs(p.impulse + cohesive * part);
                  const double factor = coulomb_factor(limit / norm(impulse));
                  if (factor < 1.0) {
                    impulse = factor * impulse;
                    slip = f.slip + (1.0 / mass) * impulse;
                    end = f.spring + 0.5 * part * (f.slip + slip);
                  }
                  f.impulse = f.impulse + impulse;
                  f.turning = f.turning + (1.0 - (p.overlap - g.overlap) / levers) * impulse;
                  f.way = f.way + end - f.spring;
                  f.slip = slip;
                  const double longest = kind.friction() * std::fabs(p.end_force + cohesive) / p.tangential_stiffness;
                  f.spring = coulomb_factor(longest / norm(end)) * end;
                });
  return f;
}

/// What a contact does to its first body over a step dt; it acts during the last span of it.
/// Bodies stick as long as the tangential impulse stays below friction times the normal one; else they slide all the
/// time, with a friction that is proportional to the normal force at every instant.
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
    const Vec3 &slip = g.slip_velocity;
    const bool touched_now = span < dt;
    Vec3 spring{};
    if (has_spring && !touched_now) spring = spring_at_start(stored, g);

    const double mass = kind.tangential_mass();
    const bool lasts = normal.contact_time == span;
    Vec3 tangential;
    Vec3 end_spring;
    if (touched_now || !lasts) {
      const FrictionImpulse f = friction_in_parts(kind, normal, g, spring, cohesive);
      tangential = tangential_part(f.impulse, n);
      torque = cross(n, f.turning);
      end_spring = f.spring;
      moment = moment + mass * (f.way + (span - normal.contact_time) * f.slip - span * slip);
    } else {
      const Propagator stick = kind.stick(normal);
      const Vec3 end_slip = stick.rate_from_displacement * spring + stick.rate_from_rate * slip;
      end_spring = stick.displacement_from_displacement * spring + stick.displacement_from_rate * slip;
      const Vec3 sticking = mass * (end_slip - slip);
      const double limit = kind.friction() * std::fabs(normal.impulse + cohesive * dt);
      const double size = norm(sticking);
      const double factor = coulomb_factor(limit / size);
      tangential = factor * tangential_part(sticking, n);
      if (factor < 1.0) {
        if (normal.impulse > 0.0) moment = moment + (normal.moment / normal.impulse) * tangential;
        // what has slipped, but not more than makes the next step stick at the limit if there is no slip
        const double per_spring = -mass * stick.rate_from_displacement;
        end_spring = spring + dt * (slip + (0.5 / mass) * tangential);
        end_spring = coulomb_factor(limit / (per_spring * norm(end_spring))) * end_spring;
      } else {
        moment = moment + mass * (end_spring - spring - dt * slip);
      }
      torque = cross(n, tangential);
    }
    if (has_spring) {
      set(lasts ? end_spring - 0.5 * dt * (slip + (1.0 / mass) * tangential) : Vec3{}, stored.values);
      set(spring, stored.now);
    }
    impulse = impulse + tangential;
  }
  const double per_step = 1.0 / dt;
  return {per_step * impulse, per_step * torque, moment - 0.5 * dt * impulse};
}

} // namespace cfpm
