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
/// values: what it is carried as; dt: of the step before [s]. R: double, or a Pack of several contacts' numbers.
template <class R> [[gnu::always_inline]] inline BasicVec3<R> spring_at_start(const BasicVec3<R> &values, const R &dt,
                                                                              const BasicContactGeometry<R> &g) {
  return tangential_part(values + 0.5 * dt * g.slip_velocity, g.normal);
}
inline Vec3 spring_at_start(const StoredSpring &stored, const ContactGeometry &g) {
  return stored.advance ? spring_at_start(vec3(stored.values), stored.dt, g) : vec3(stored.now);
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

/// The same over a part of an isolated contact.
struct FrictionPart {
  Vec3 impulse;  ///< [N s]
  Vec3 end_slip; ///< [m/s]
  Vec3 moved;    ///< [m]
};

/// Between an instant and another, from how far a number is below 0 and where it is then, above, on a straight line:
/// the share of the time until it is 0.
inline double share_below(double at_start, double at_end) {
  return at_start < 0.0 ? at_start / (at_start - at_end) : 0.0;
}

/// Of an isolated contact, in equal parts of it that stick or slide, with the overlap and the tangential stiffness that
/// each has. Where Coulomb's limit holds the spring alone, which takes the dashpot with it, a part is divided where the
/// spring comes to it, by the straight line between its ends: the force has a jump there.
template <Friction friction, class Parameters>
FrictionImpulse friction_alone(const Parameters &parameters, const NormalImpulse &normal, const ContactGeometry &g,
                               double span, const Vec3 &start, double cohesive) {
  const int parts = parts_of_contact(normal.contact_time, normal.duration);
  const double part = normal.contact_time / parts;
  const double mass = parameters.tangential_mass();
  const double levers = g.lever_j > 0.0 ? g.lever_i + g.lever_j : 2.0 * g.lever_i;
  const auto limit_of = [&](double force) { return parameters.friction() * std::fabs(force + cohesive); };
  LinearLaw law = parameters.law(g.overlap);
  double limit = limit_of(normal.force);
  Vec3 slip = g.slip_velocity;
  Vec3 spring = slackened<friction>(start, law, slip, limit);
  Vec3 way{};
  FrictionImpulse all{};

  // after a share of the part with an impulse another one until its end
  const auto slides = [&](double share, const Vec3 &before, const Vec3 &impulse) {
    const Vec3 then = slip + (1.0 / mass) * before;
    const Vec3 end = then + (1.0 / mass) * impulse;
    return FrictionPart{before + impulse, end, 0.5 * part * (share * (slip + then) + (1.0 - share) * (then + end))};
  };
  // held: the impulse that the limit holds
  const auto limited_by_impulse = [&](const FrictionPart &f, const Vec3 &held, double limit_impulse) {
    const double factor = coulomb_factor(limit_impulse / norm(held));
    return factor < 1.0 ? slides(0.0, {}, factor * held) : f;
  };
  const auto limited_by_spring = [&](const FrictionPart &f, double limit_impulse, const NormalPart &p,
                                     double end_limit) {
    const Vec3 pull = law.tangential_stiffness * spring;
    const Vec3 end_pull = p.end_law.tangential_stiffness * (spring + f.moved);
    const double end_beyond = norm(end_pull) - end_limit;
    if (!(end_beyond > 0.0)) { // by its impulse it may be, where the limit vanishes at the end
      return limited_by_impulse(f, f.impulse + p.law.tangential_damping * f.moved, limit_impulse);
    }
    const double sticks = share_below(norm(pull) - limit, end_beyond);
    // of a force that goes on a straight line too, with the impulse of f over the whole part
    const Vec3 force = sticking_friction(law.tangential_stiffness, law.tangential_damping, spring, slip);
    const Vec3 before = sticks * sticks * f.impulse + sticks * (1.0 - sticks) * part * force;
    if (limit + end_limit == 0.0) return slides(sticks, before, {});
    const double then = limit + sticks * (end_limit - limit);
    const double of_limit = (1.0 - sticks) * (then + end_limit) / (limit + end_limit);
    const Vec3 halfway = 0.5 * ((1.0 - sticks) * pull + (1.0 + sticks) * end_pull); // through what slides
    return slides(sticks, before, (-of_limit * limit_impulse / norm(halfway)) * halfway);
  };

  const auto add_part = [&](const NormalPart &p, const Propagator &stick) {
    const Vec3 end_slip = stick.rate_from_displacement * spring + stick.rate_from_rate * slip;
    const Vec3 moved = stick.displacement_from_displacement * spring + stick.displacement_from_rate * slip - spring;
    const double limit_impulse = parameters.friction() * std::fabs(p.impulse + cohesive * part);
    const double end_limit = limit_of(p.end_force);
    FrictionPart f{mass * (end_slip - slip), end_slip, moved};
    const bool has_dashpot = law.tangential_damping > 0.0 || p.end_law.tangential_damping > 0.0;
    if (friction == Friction::spring_and_dashpot && has_dashpot)
      f = limited_by_spring(f, limit_impulse, p, end_limit);
    else
      f = limited_by_impulse(f, f.impulse, limit_impulse);
    all.impulse = all.impulse + f.impulse;
    all.levered = all.levered + (1.0 - (p.overlap - g.overlap) / levers) * f.impulse;
    way = way + f.moved;
    slip = f.end_slip;
    law = p.end_law;
    limit = end_limit;
    spring = slackened<friction>(spring + f.moved, law, slip, limit);
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
    const FrictionImpulse f = friction_alone<friction>(parameters, normal, g, span, spring, cohesive);
    if constexpr (has_spring(friction)) set(f.next, stored.values);
    impulse = impulse + tangential_part(f.impulse, n);
    time_moment = time_moment + f.time_moment;
    torque = cross(n, f.levered);
  }
  return {per_step * impulse, per_step * torque, time_moment - 0.5 * dt * impulse};
}

/// Coulomb's limits of a crowded contact as factors: on its impulse, and on its spring.
template <class R> struct CrowdedLimits {
  R impulse;
  R spring;
};

/// limit: of the impulse [N s]; per_spring: the impulse by which a spring sticks, over the spring [N s/m];
/// spring_squared: of what the limit holds as a spring.
template <class R> [[gnu::always_inline]] inline CrowdedLimits<R>
crowded_limits(const R &limit, const R &per_spring, const R &impulse_squared, const R &spring_squared) {
  if (all_surely_stick(limit, impulse_squared) && all_surely_stick(limit, per_spring * per_spring * spring_squared))
    return {1.0, 1.0};
  return {coulomb_factor(limit / sqrt(impulse_squared)), coulomb_factor(limit / per_spring / sqrt(spring_squared))};
}
/// Of a single contact both are a pack: one instruction takes both roots, one both quotients.
[[gnu::always_inline]] inline CrowdedLimits<double> crowded_limits(double limit, double per_spring,
                                                                   double impulse_squared, double spring_squared) {
  const TwoDoubles limits = limit / TwoDoubles{1.0, per_spring};
  const TwoDoubles ratio = limits / TwoDoubles{std::sqrt(impulse_squared), std::sqrt(spring_squared)};
  return {coulomb_factor(ratio[0]), coulomb_factor(ratio[1])};
}

/// The share of a step in which a spring is below Coulomb's limit, so that its dashpot acts, if its force grows on a
/// straight line: from what gives the impulse of which start_squared is the square over the whole step, to what makes
/// the mean of both that of impulse_squared.
template <class R>
[[gnu::always_inline]] inline R share_below_limit(const R &limit, const R &impulse_squared, const R &start_squared) {
  using std::sqrt;
  if (all_surely_stick(limit, R(4.0 * impulse_squared))) return 1.0; // the end is below it too
  const R start = sqrt(start_squared);
  const R room = limit - start;
  const R growth = 2.0 * (sqrt(impulse_squared) - start);
  return select(room >= growth, R(1.0), select(R(0.0) < room, room / growth, R(0.0)));
}

/// Friction of a contact in a crowd.
template <class R> struct CrowdedFriction {
  BasicVec3<R> impulse; ///< on the first body [N s]
  BasicVec3<R> next;    ///< see FrictionImpulse
};

/// At once: bodies stick as long as the tangential impulse stays below friction times the normal one; else they slide
/// all the time, with a spring that without slip would stick at the limit. Where the limit holds both together, the
/// dashpot pulls as a spring that is longer by the slip in its retardation; where it holds the spring alone, the
/// dashpot gives its share of the time before. stick: how they stick; limit: see above; carried: of the slip to the
/// next spring [s]; retardation: see there [s]
template <Friction friction, class R> [[gnu::always_inline]] inline CrowdedFriction<R>
friction_in_crowd(const BasicCrowdResponse<R> &stick, const R &tangential_mass, const R &crowding, const R &limit,
                  const BasicVec3<R> &spring, const BasicVec3<R> &slip, const R &carried,
                  [[maybe_unused]] const R &retardation) {
  using std::fabs;
  const R mass = stick.relaxation(crowding) * tangential_mass;
  const R from_spring = stick.softening * stick.rate_from_displacement;
  const BasicVec3<R> sticking = mass * (from_spring * spring + (stick.rate_from_rate - 1.0) * slip);
  // the dashpot's part: its way from a unit of slip is C over ks/mt, see CrowdResponse
  const BasicVec3<R> dashpot = (mass * stick.rate_from_displacement * retardation) * slip;
  const R per_spring = mass * fabs(from_spring);
  if constexpr (friction == Friction::limited_together) {
    const BasicVec3<R> held = spring + retardation * slip;
    const CrowdedLimits<R> factor = crowded_limits(limit, per_spring, dot(sticking, sticking), dot(held, held));
    return {factor.impulse * sticking, spring + (factor.spring - 1.0) * held + carried * slip};
  } else {
    const BasicVec3<R> held = sticking - dashpot;
    const R squared = dot(held, held);
    const R spring_squared = dot(spring, spring);
    const CrowdedLimits<R> factor = crowded_limits(limit, per_spring, squared, spring_squared);
    const R share = share_below_limit(limit, squared, per_spring * per_spring * spring_squared);
    return {factor.impulse * held + share * dashpot, factor.spring * spring + carried * slip};
  }
}

/// What it does to its first body over a step: positions move by the mean force.
template <Friction friction, class R>
[[gnu::always_inline]] inline BasicMeanForce<R> mean_force_in_crowd(const R &dt, const BasicNormalImpulse<R> &normal,
                                                                    const BasicVec3<R> &n,
                                                                    const BasicVec3<R> &tangential) {
  const R per_step = 1.0 / dt;
  BasicVec3<R> impulse = normal.impulse * n;
  if constexpr (friction == Friction::none) return {per_step * impulse, {}, {}};
  return {per_step * (impulse + tangential), per_step * cross(n, tangential), {}};
}

/// What a contact does to its first body over a step dt; it acts during the last span of it.
/// An isolated contact is followed exactly, in velocity, place and spring. One of a crowd, where a body has others, is
/// held by them: there positions move by the mean force, as they do for the others, and the spring by that same way,
/// or a heap at rest would creep; bodies that stick come to rest, they do not swing back; and it gives what
/// CrowdResponse leaves of its impulse.
/// Parameters: LinearImpulse, HertzImpulse or ViscoelasticImpulse; cohesive: what else presses the bodies together as
/// far as Coulomb counts it [N]
template <Friction friction, class Parameters>
[[gnu::always_inline]] inline MeanForce mean_force_of_impulse(const Parameters &parameters, const NormalImpulse &normal,
                                                              const ContactGeometry &g, double span, double crowding,
                                                              const StoredSpring &stored, double cohesive) {
  constexpr bool with_spring = has_spring(friction);
  if (normal.contact_time == 0.0) {
    if constexpr (with_spring) {
      set({}, stored.values);
      set({}, stored.now);
    }
    return {};
  }
  const double dt = parameters.dt();
  const Vec3 spring = with_spring && span == dt ? spring_at_start(stored, g) : Vec3{};
  if constexpr (with_spring) set(spring, stored.now);
  if (crowding == 1.0) return mean_force_alone<friction>(parameters, normal, g, span, spring, stored, cohesive);
  CrowdedFriction<double> f{};
  if constexpr (friction != Friction::none) {
    const double limit = parameters.friction() * std::fabs(normal.impulse + cohesive * normal.contact_time);
    f = friction_in_crowd<friction>(parameters.slip_in_crowd(normal), parameters.tangential_mass(), crowding, limit,
                                    spring, g.slip_velocity, span - 0.5 * dt, parameters.retardation(normal));
    if constexpr (with_spring) set(normal.contact_time == span ? f.next : Vec3{}, stored.values);
  }
  return mean_force_in_crowd<friction>(dt, normal, g.normal, f.impulse);
}

} // namespace cfpm
