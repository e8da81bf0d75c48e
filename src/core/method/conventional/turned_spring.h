// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/law/granular_law.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// The law of LAMMPS' pair_style granular of 2021 without rolling, twisting and cohesion, see force_of_instant.h. A
/// spring that has left the tangent plane is turned into it and keeps its length. Coulomb's limit holds spring and
/// dashpot of friction together, and a spring at the limit is set so that both of them reach it. The spheres slip where
/// their surfaces are, and friction acts in the middle of the overlap. Terms of the material that are 0 change no bit
/// of a sum, so all combinations of sub-models are this one. R: double, or a Pack of several contacts' numbers.
template <class R> struct TurnedSpring {
  template <class Number> using Over = TurnedSpring<Number>;
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
    static_assert(kind != Friction::none);
    using std::fabs;
    using std::sqrt;
    const R distance = sqrt(pair.squared);
    const R per_distance = 1.0 / distance;
    const BasicVec3<R> normal = per_distance * pair.separation;
    const BasicVec3<R> relative = pair.i.velocity - pair.j.velocity;
    const R leaving = dot(relative, normal);
    const R overlap = pair.radius_i + pair.radius_j - distance;
    const R area_radius = sqrt(R(overlap * reduced_radius));
    const R stiffness = material.normal_constant + material.normal_area * area_radius;
    const R spring = material.normal_constant * overlap + material.normal_area * overlap * area_radius;
    const R damping = material.damping_constant + material.damping_mass * reduced_mass +
                      material.damping_area * (area_radius * reduced_mass) +
                      material.damping_ratio * R(sqrt(R(reduced_mass * stiffness)));
    const R along = spring - damping * leaving;
    const R push = select(along < material.least_force, material.least_force, along);

    const BasicVec3<R> passing = relative - leaving * normal;
    const BasicVec3<R> rolling = pair.radius_i * pair.i.spin + pair.radius_j * pair.j.spin;
    const BasicVec3<R> slip_velocity = passing - cross(rolling, normal);
    const BasicLinearLaw<R> slip{stiffness,
                                 damping,
                                 material.tangential_constant + material.tangential_area * area_radius,
                                 material.tangential_damping * damping,
                                 material.friction,
                                 material.least_force};
    const BasicVec3<R> tangential =
        friction<kind>(slip, normal, slip_velocity, material.friction * R(fabs(push)), springs);
    return {{push * normal + tangential, cross(normal, tangential), {}},
            pair.radius_i - 0.5 * overlap,
            pair.radius_j - 0.5 * overlap};
  }

private:
  /// Of spring and dashpot, in which a spring is taken to lie in the tangent plane [-].
  static constexpr double in_plane = 1e-10;

  /// limit: of Coulomb [N]
  template <Friction kind, class Springs>
  [[gnu::always_inline]] BasicVec3<R> friction(const BasicLinearLaw<R> &law, const BasicVec3<R> &normal,
                                               const BasicVec3<R> &slip_velocity, const R &limit,
                                               [[maybe_unused]] const Springs &springs) const {
    using std::sqrt;
    if constexpr (kind == Friction::dashpot) {
      const R speed = norm(slip_velocity);
      const R force = law.tangential_damping * speed;
      return -select(speed != R(0.0), smaller(force, limit) / speed, R(0.0)) * slip_velocity;
    } else {
      const BasicVec3<R> spring = turned(springs.load(), normal, law.tangential_stiffness, limit) + dt * slip_velocity;
      const BasicVec3<R> dashpot = law.tangential_damping * slip_velocity;
      const BasicVec3<R> sticking = -(law.tangential_stiffness * spring) - dashpot;
      const R squared = dot(sticking, sticking);
      if (all_surely_stick(limit, squared)) {
        springs.store(spring);
        return sticking;
      }
      const R size = sqrt(squared);
      const auto slides = limit < size;
      const auto has_spring = dot(spring, spring) != R(0.0);
      const R flexibility = -1.0 / law.tangential_stiffness;
      const auto at_limit = [&](const R &component, const R &damped)
                                CFPM_INLINED { return flexibility * (limit * component / size + damped); };
      const BasicVec3<R> set{at_limit(sticking.x, dashpot.x), at_limit(sticking.y, dashpot.y),
                             at_limit(sticking.z, dashpot.z)};
      springs.store(select(slides & has_spring, set, spring));
      return select(slides, select(has_spring, R(limit / size), R(0.0)), R(1.0)) * sticking;
    }
  }

  [[gnu::always_inline]] static BasicVec3<R> turned(const BasicVec3<R> &spring, const BasicVec3<R> &normal,
                                                    const R &stiffness, const R &limit) {
    using std::fabs;
    using std::sqrt;
    const R along = dot(spring, normal);
    const auto turns = in_plane * limit < R(fabs(along)) * stiffness;
    if (!any(turns)) return spring;
    const BasicVec3<R> part = spring - along * normal;
    const R size = norm(part);
    const R factor = select(R(0.0) < size, norm(spring) / size, R(0.0));
    return select(turns, factor * part, spring);
  }
};

} // namespace cfpm
