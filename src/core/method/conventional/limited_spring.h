// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/law/linear_law.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// What acts at an overlap by LIGGGHTS' normal models hooke and hooke/stiffness: always the same. R: double, or a Pack
/// of several contacts' numbers.
template <class R> struct HookeCoefficients {
  template <class Number> using Over = HookeCoefficients<Number>;

  BasicLinearLaw<R> law;

  [[gnu::always_inline]] const BasicLinearLaw<R> &at(const R &) const { return law; }
};

/// Likewise by hertz, from the materials.
template <class R> struct HertzCoefficients {
  template <class Number> using Over = HertzCoefficients<Number>;

  R reduced_radius;       ///< [m]
  R reduced_mass;         ///< [kg]
  R normal_stiffness;     ///< 4/3 E* [N/m^2]
  R normal_tangent;       ///< 2 E* [N/m^2]
  R tangential_stiffness; ///< 8 G* [N/m^2]
  R normal_damping;       ///< over the root of tangent and mass [-]
  R tangential_damping;   ///< over the root of stiffness and mass [-]
  R friction;             ///< Coulomb coefficient mu [-]
  R least_force;          ///< [N]

  [[gnu::always_inline]] BasicLinearLaw<R> at(const R &overlap) const {
    using std::sqrt;
    const R area_radius = sqrt(reduced_radius * overlap);
    const R slip_stiffness = tangential_stiffness * area_radius;
    return {normal_stiffness * area_radius,
            normal_damping * sqrt(normal_tangent * area_radius * reduced_mass),
            slip_stiffness,
            tangential_damping * sqrt(slip_stiffness * reduced_mass),
            friction,
            least_force};
  }
};

/// Likewise by hertz/stiffness.
template <class R> struct HertzStiffnessCoefficients {
  template <class Number> using Over = HertzStiffnessCoefficients<Number>;

  R reduced_radius;       ///< [m]
  R reduced_mass;         ///< [kg]
  R normal_stiffness;     ///< [N/m^2]
  R normal_damping;       ///< [1/(s m)]
  R tangential_stiffness; ///< [N/m^2]
  R tangential_damping;   ///< [1/(s m)]
  R friction;             ///< Coulomb coefficient mu [-]
  R least_force;          ///< [N]

  [[gnu::always_inline]] BasicLinearLaw<R> at(const R &overlap) const {
    using std::sqrt;
    const R area_radius = sqrt(reduced_radius * overlap);
    const R damping = area_radius * reduced_mass;
    return {area_radius * normal_stiffness,
            damping * normal_damping,
            area_radius * tangential_stiffness,
            damping * tangential_damping,
            friction,
            least_force};
  }
};

/// The law of LIGGGHTS, see force_of_instant.h. Coulomb's limit holds the spring alone; the dashpot of friction acts
/// while the spring is below it. The spheres slip in the middle of the overlap. Coefficients: one of those above; R:
/// double, or a Pack of several contacts' numbers.
template <template <class> class Coefficients, class R> struct LimitedSpring {
  template <class Number> using Over = LimitedSpring<Coefficients, Number>;
  template <class Length>
  [[gnu::always_inline]] static Length touch_distance(const Length &radius_i, const Length &radius_j) {
    return radius_i + radius_j;
  }

  Coefficients<R> coefficients;
  R dt; ///< by which springs move on [s]

  template <Friction kind, class Springs>
  [[gnu::always_inline]] BasicPairForce<R> act(const BasicSpherePair<R> &pair, const Springs &springs) const {
    using std::fabs;
    using std::sqrt;
    const R distance = sqrt(pair.squared);
    const R per_distance = 1.0 / distance;
    const BasicVec3<R> normal = per_distance * pair.separation;
    const BasicVec3<R> relative = pair.i.velocity - pair.j.velocity;
    const R leaving = dot(relative, normal);
    const R overlap = pair.radius_i + pair.radius_j - distance;
    const R lever_i = pair.radius_i - 0.5 * overlap;
    const R lever_j = pair.radius_j - 0.5 * overlap;

    const BasicLinearLaw<R> law = coefficients.at(overlap);
    const R along = law.normal_stiffness * overlap - law.normal_damping * leaving;
    const R push = select(along < law.least_force, law.least_force, along);
    if constexpr (kind == Friction::none) return {{push * normal, {}, {}}, lever_i, lever_j};

    const BasicVec3<R> passing = relative - leaving * normal;
    const BasicVec3<R> rolling = per_distance * (lever_i * pair.i.spin + lever_j * pair.j.spin);
    const BasicVec3<R> slip_velocity = passing - cross(rolling, pair.separation);
    const BasicVec3<R> tangential = friction<kind>(law, normal, slip_velocity, law.friction * fabs(push), springs);
    return {{push * normal + tangential, cross(normal, tangential), {}}, lever_i, lever_j};
  }

private:
  /// limit: of Coulomb [N]
  template <Friction kind, class Springs>
  [[gnu::always_inline]] BasicVec3<R> friction(const BasicLinearLaw<R> &law, const BasicVec3<R> &normal,
                                               const BasicVec3<R> &slip_velocity, const R &limit,
                                               [[maybe_unused]] const Springs &springs) const {
    using std::sqrt;
    if constexpr (kind == Friction::dashpot) {
      const R speed = norm(slip_velocity);
      return -select(limit < law.tangential_damping * speed, limit / speed, law.tangential_damping) * slip_velocity;
    } else {
      const BasicVec3<R> spring = tangential_part(springs.load() + dt * slip_velocity, normal);
      const BasicVec3<R> sticking = -(law.tangential_stiffness * spring);
      const R squared = dot(spring, spring);
      if (all_surely_stick(limit, law.tangential_stiffness * law.tangential_stiffness * squared)) {
        springs.store(spring);
        return sticking - law.tangential_damping * slip_velocity;
      }
      const R size = law.tangential_stiffness * sqrt(squared);
      const auto slides = limit < size;
      const BasicVec3<R> sliding = (limit / size) * sticking;
      const BasicVec3<R> shortened = {-sliding.x / law.tangential_stiffness, -sliding.y / law.tangential_stiffness,
                                      -sliding.z / law.tangential_stiffness};
      springs.store(select(slides, shortened, spring));
      return select(slides, sliding, sticking - law.tangential_damping * slip_velocity);
    }
  }
};

} // namespace cfpm
