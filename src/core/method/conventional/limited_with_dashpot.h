// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/method/conventional/dashpot_friction.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// How spring and dashpot grow with the overlap: not at all,
struct HookeGrowth {
  template <class R> [[gnu::always_inline]] static R of(const R &, const R &, const R &) { return 1.0; }
};
/// or, both of them, with the radius of the contact area [m].
struct HertzGrowth {
  template <class R> [[gnu::always_inline]] static R of(const R &overlap, const R &radius_i, const R &radius_j) {
    using std::sqrt;
    return sqrt(overlap * radius_i * radius_j / (radius_i + radius_j));
  }
};

/// The law of LAMMPS' gran/hooke/history, gran/hertz/history and, with the dashpot of friction alone, gran/hooke, see
/// force_of_instant.h. Coulomb's limit holds spring and dashpot of friction together, and a spring at the limit is
/// shortened so that both of them reach it. The spheres slip where their surfaces are. Growth: HookeGrowth or
/// HertzGrowth; R: double, or a Pack of several contacts' numbers.
template <class Growth, class R> struct LimitedWithDashpot {
  template <class Number> using Over = LimitedWithDashpot<Growth, Number>;
  template <class Length>
  [[gnu::always_inline]] static Length touch_distance(const Length &radius_i, const Length &radius_j) {
    return radius_i + radius_j;
  }

  // Hertz: each of the first four over the radius of the contact area
  R normal_stiffness;     ///< [N/m]
  R normal_damping;       ///< [kg/s]
  R tangential_stiffness; ///< [N/m]
  R tangential_damping;   ///< [kg/s]
  R friction;             ///< Coulomb coefficient mu [-]
  R least_force;          ///< of the normal, see without_tension; 0 or without a bound [N]
  R dt;                   ///< by which springs move on [s]

  template <Friction kind, class Springs> [[gnu::always_inline]] BasicPairForce<R>
  act(const BasicSpherePair<R> &pair, [[maybe_unused]] const Springs &springs) const {
    static_assert(kind != Friction::none);
    using std::fabs;
    using std::sqrt;
    const R distance = sqrt(pair.squared);
    const R per_distance = 1.0 / distance;
    const R per_squared = 1.0 / pair.squared;

    const BasicVec3<R> relative = pair.i.velocity - pair.j.velocity;
    const R leaving = dot(relative, pair.separation); // speed times distance
    const BasicVec3<R> passing = relative - per_squared * (leaving * pair.separation);
    const BasicVec3<R> rolling = per_distance * (pair.radius_i * pair.i.spin + pair.radius_j * pair.j.spin);
    const BasicVec3<R> slip_velocity = passing - cross(rolling, pair.separation);

    const R overlap = pair.radius_i + pair.radius_j - distance;
    const R growth = Growth::of(overlap, pair.radius_i, pair.radius_j);
    const R along = (normal_stiffness * overlap * per_distance - normal_damping * leaving * per_squared) * growth;
    const R push = select(along < least_force, least_force, along); // force over distance
    const R limit = friction * fabs(push * distance);

    BasicVec3<R> tangential;
    if constexpr (kind == Friction::dashpot)
      tangential = dashpot_friction(R(growth * tangential_damping), limit, slip_velocity);
    else
      tangential = friction_of_spring(pair.separation, per_squared, growth, limit, slip_velocity, springs);
    return {{push * pair.separation + tangential, per_distance * cross(pair.separation, tangential), {}},
            pair.radius_i,
            pair.radius_j};
  }

private:
  template <class Springs> [[gnu::always_inline]] BasicVec3<R>
  friction_of_spring(const BasicVec3<R> &separation, const R &per_squared, const R &growth, const R &limit,
                     const BasicVec3<R> &slip_velocity, const Springs &springs) const {
    using std::sqrt;
    const BasicVec3<R> slipped = springs.load() + dt * slip_velocity;
    const BasicVec3<R> spring = slipped - (dot(slipped, separation) * per_squared) * separation;
    const BasicVec3<R> dashpot = tangential_damping * slip_velocity;
    const BasicVec3<R> sticking = -growth * (tangential_stiffness * spring + dashpot);
    const R squared = dot(sticking, sticking);
    if (all_surely_stick(limit, squared)) {
      springs.store(spring);
      return sticking;
    }
    const R size = sqrt(squared);
    const R factor = limit / size;
    const auto slides = limit < size;
    const auto has_spring = R(0.0) < dot(slipped, slipped);
    const BasicVec3<R> in_lengths = {dashpot.x / tangential_stiffness, dashpot.y / tangential_stiffness,
                                     dashpot.z / tangential_stiffness};
    springs.store(select(slides & has_spring, factor * (spring + in_lengths) - in_lengths, spring));
    return select(slides, select(has_spring, factor, R(0.0)), R(1.0)) * sticking;
  }
};

} // namespace cfpm
