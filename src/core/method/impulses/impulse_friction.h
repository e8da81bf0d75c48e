// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/method/impulses/friction_alone.h"
#include "core/method/impulses/friction_in_crowd.h"
#include "core/method/impulses/normal_impulse.h"

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
    const FrictionImpulse f = FrictionAlone<friction, Parameters>(parameters, normal, g, spring, cohesive).over(span);
    if constexpr (has_spring(friction)) set(f.next, stored.values);
    impulse = impulse + tangential_part(f.impulse, n);
    time_moment = time_moment + f.time_moment;
    torque = cross(n, f.levered);
  }
  return {per_step * impulse, per_step * torque, time_moment - 0.5 * dt * impulse};
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
