// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/law/granular_law.h"
#include "core/method/conventional/dashpot_friction.h"
#include "core/method/conventional/granular_order.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// Spring and dashpot in the tangent plane, which Coulomb's limit holds together. A spring that has left the plane is
/// turned into it and keeps its length; one at the limit is set so that both of them reach it. rolls: whether it is
/// that of rolling; R: double, or a Pack of several contacts' numbers.
template <GranularOrder order, bool rolls, class R> struct TurnedFriction {
  R stiffness; ///< [N/m]
  R damping;   ///< [kg/s]
  R limit;     ///< of Coulomb [N]
  R dt;        ///< by which springs move on [s]

  /// The force that acts at the velocity in the tangent plane [m/s].
  template <class Springs> [[gnu::always_inline]] BasicVec3<R>
  force(const BasicVec3<R> &normal, const BasicVec3<R> &velocity, const Springs &springs) const {
    return force_of(turned(springs.load(), normal, stiffness) + dt * velocity, velocity, springs);
  }

  /// That of a spring that has been turned and moved on.
  template <class Springs> [[gnu::always_inline]] BasicVec3<R>
  force_of(const BasicVec3<R> &spring, const BasicVec3<R> &velocity, const Springs &springs) const {
    using std::sqrt;
    const BasicVec3<R> sticking = -(stiffness * spring) - damping * velocity;
    const R squared = dot(sticking, sticking);
    if (all_surely_stick(limit, squared)) {
      springs.store(spring);
      return sticking;
    }
    const R size = sqrt(squared);
    const auto slides = limit < size;
    const auto has_spring = dot(spring, spring) != R(0.0);
    const BasicVec3<R> set{set_at_limit(sticking.x, velocity.x, size), set_at_limit(sticking.y, velocity.y, size),
                           set_at_limit(sticking.z, velocity.z, size)};
    springs.store(select(slides & has_spring, set, spring));
    return select(slides, select(has_spring, limit_over(size), R(0.0)), R(1.0)) * sticking;
  }

  /// Into the tangent plane. per_length: stiffness, or 1 of a spring that is kept as the force that it has.
  [[gnu::always_inline]] BasicVec3<R> turned(const BasicVec3<R> &spring, const BasicVec3<R> &normal,
                                             const R &per_length) const {
    using std::fabs;
    const R along = dot(spring, normal);
    const auto turns = in_plane * limit < R(fabs(along)) * per_length;
    if (!any(turns)) return spring;
    const BasicVec3<R> part = spring - along * normal;
    const R size = norm(part);
    const R factor = select(R(0.0) < size, norm(spring) / size, R(0.0));
    return select(turns, factor * part, spring);
  }

private:
  [[gnu::always_inline]] R limit_over(const R &size) const {
    if constexpr (order == GranularOrder::of_2025 || (rolls && order == GranularOrder::of_2026))
      return limit * (1.0 / size);
    else
      return limit / size;
  }
  /// A component of the spring that is at the limit. sticking, velocity: of the same; size: of the force without limit.
  [[gnu::always_inline]] R set_at_limit(const R &sticking, const R &velocity, const R &size) const {
    if constexpr (order == GranularOrder::of_2021) {
      return -1.0 / stiffness * (limit * sticking / size + damping * velocity);
    } else if constexpr (rolls) {
      const R flexibility = 1.0 / stiffness;
      return -limit * flexibility * (1.0 / size) * sticking - damping * flexibility * velocity;
    } else {
      return -1.0 / stiffness * (limit_over(size) * sticking + damping * velocity);
    }
  }

  /// Of spring and dashpot, in which a spring is taken to lie in the tangent plane [-].
  static constexpr double in_plane = 1e-10;
};

/// The law of LAMMPS' pair_style granular without rolling, twisting and cohesion, see force_of_instant.h. The spheres
/// slip where their surfaces are, and friction acts in the middle of the overlap. Terms of the material that are 0
/// change no bit of a sum, so all combinations of sub-models are this one. R: as above.
template <GranularOrder order, class R> struct TurnedSpring {
  template <class Number> using Over = TurnedSpring<order, Number>;
  template <class Length>
  [[gnu::always_inline]] static Length touch_distance(const Length &radius_i, const Length &radius_j) {
    return radius_i + radius_j;
  }

  GranularMaterial<R> material;
  R reduced_radius; ///< [m]
  R reduced_mass;   ///< [kg]
  R dt;             ///< by which springs move on [s]

  template <Friction kind, class Springs>
  [[gnu::always_inline]] BasicPairForce<R> act(const BasicSpherePair<R> &pair, const Springs &springs) const {
    return act<kind>(along_normal(pair), pair, springs);
  }

protected:
  struct AlongNormal {
    BasicVec3<R> normal;
    BasicVec3<R> relative; ///< velocity [m/s]
    R leaving;             ///< its part along the normal [m/s]
    R overlap;             ///< [m]
    R area_radius;         ///< [m]
    R damping;             ///< [kg/s]
    R push;                ///< [N]
  };

  [[gnu::always_inline]] AlongNormal along_normal(const BasicSpherePair<R> &pair) const {
    return along_normal(pair, [](const R &spring) CFPM_INLINED { return spring; });
  }
  /// elastic(force of the spring): with what else acts along the normal without a dashpot [N].
  template <class Elastic>
  [[gnu::always_inline]] AlongNormal along_normal(const BasicSpherePair<R> &pair, const Elastic &elastic) const {
    using std::sqrt;
    const R distance = sqrt(pair.squared);
    const R per_distance = 1.0 / distance;
    const BasicVec3<R> normal = per_distance * pair.separation;
    const BasicVec3<R> relative = pair.i.velocity - pair.j.velocity;
    const R leaving = dot(relative, normal);
    const R overlap = pair.radius_i + pair.radius_j - distance;
    const R area_radius = sqrt(R(overlap * reduced_radius));
    const R spring = spring_force(overlap, area_radius);
    const R damping = material.damping_constant + material.damping_mass * reduced_mass + damping_of_area(area_radius) +
                      material.damping_ratio * R(sqrt(reduced_mass_times_stiffness(spring, overlap, area_radius)));
    const R along = elastic(spring) - damping * leaving;
    const R push = select(along < material.least_force, material.least_force, along);
    return {normal, relative, leaving, overlap, area_radius, damping, push};
  }

  template <Friction kind, class Springs> [[gnu::always_inline]] BasicPairForce<R>
  act(const AlongNormal &n, const BasicSpherePair<R> &pair, [[maybe_unused]] const Springs &springs) const {
    static_assert(kind != Friction::none);
    using std::fabs;
    const BasicVec3<R> slip_velocity = slip_velocity_of(n, pair);
    const TurnedFriction<order, false, R> friction = friction_of(n, R(fabs(n.push)));
    BasicVec3<R> tangential;
    if constexpr (kind == Friction::dashpot)
      tangential = dashpot_friction(friction.damping, friction.limit, slip_velocity);
    else
      tangential = friction.force(n.normal, slip_velocity, springs);
    return with_friction(n, pair, tangential);
  }

  [[gnu::always_inline]] BasicVec3<R> slip_velocity_of(const AlongNormal &n, const BasicSpherePair<R> &pair) const {
    const BasicVec3<R> passing = n.relative - n.leaving * n.normal;
    const BasicVec3<R> surfaces = pair.radius_i * pair.i.spin + pair.radius_j * pair.j.spin;
    return passing - cross(surfaces, n.normal);
  }
  /// pressing: the normal force that limits count [N]
  [[gnu::always_inline]] TurnedFriction<order, false, R> friction_of(const AlongNormal &n, const R &pressing) const {
    return {material.tangential_constant + material.tangential_area * n.area_radius,
            material.tangential_damping * n.damping, material.friction * pressing, dt};
  }
  [[gnu::always_inline]] BasicPairForce<R> with_friction(const AlongNormal &n, const BasicSpherePair<R> &pair,
                                                         const BasicVec3<R> &tangential) const {
    return {{n.push * n.normal + tangential, cross(n.normal, tangential), {}},
            pair.radius_i - 0.5 * n.overlap,
            pair.radius_j - 0.5 * n.overlap};
  }

private:
  [[gnu::always_inline]] R spring_force(const R &overlap, const R &area_radius) const {
    if constexpr (order == GranularOrder::of_2021)
      return material.normal_constant * overlap + material.normal_area * overlap * area_radius;
    else
      return material.normal_constant * overlap + material.normal_area * area_radius * overlap;
  }
  [[gnu::always_inline]] R damping_of_area(const R &area_radius) const {
    if constexpr (order == GranularOrder::of_2021)
      return material.damping_area * (area_radius * reduced_mass);
    else
      return material.damping_area * reduced_mass * area_radius;
  }
  /// Newer versions take the stiffness from the force; an overlap may be rounded to 0.
  [[gnu::always_inline]] R reduced_mass_times_stiffness(const R &spring, const R &overlap, const R &area_radius) const {
    if constexpr (order == GranularOrder::of_2021)
      return reduced_mass * (material.normal_constant + material.normal_area * area_radius);
    else
      return select(R(0.0) < overlap, reduced_mass * spring / overlap, R(0.0));
  }
};

/// The same with the rolling model sds: spring and dashpot between the parts of the surfaces that roll on each other,
/// with a limit of their own, which give a couple alone.
template <GranularOrder order, class R> struct RollingTurnedSpring : TurnedSpring<order, R> {
  template <class Number> using Over = RollingTurnedSpring<order, Number>;
  static constexpr bool rolls = true;
  static constexpr bool one_torque = order != GranularOrder::of_2021; ///< see sums_torques

  R rolling_stiffness; ///< [N/m]
  R rolling_damping;   ///< [kg/s]
  R rolling_friction;  ///< [-]

  /// springs: with rolling(), those of the rolling.
  template <Friction kind, class Springs>
  [[gnu::always_inline]] BasicRollingPairForce<R> act(const BasicSpherePair<R> &pair, const Springs &springs) const {
    using std::fabs;
    const auto n = this->along_normal(pair);
    const BasicPairForce<R> slipping = TurnedSpring<order, R>::template act<kind>(n, pair, springs);
    const BasicVec3<R> velocity = this->reduced_radius * cross(pair.i.spin - pair.j.spin, n.normal);
    const TurnedFriction<order, true, R> friction{rolling_stiffness, rolling_damping,
                                                  rolling_friction * R(fabs(n.push)), this->dt};
    const BasicVec3<R> force = friction.force(n.normal, velocity, springs.rolling());
    return {slipping, this->reduced_radius * cross(n.normal, force)};
  }
};

} // namespace cfpm
