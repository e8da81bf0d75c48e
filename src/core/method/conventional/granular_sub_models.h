// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/method/conventional/dashpot_friction.h"
#include "core/method/conventional/granular_order.h"
#include "core/method/conventional/turned_spring.h"
#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// Which sub-models of LAMMPS' pair_style granular two materials have beside those of a TurnedSpring, and their
/// coefficients. Numbers that say whether are 1 or 0, and where they are 0 so are their coefficients. R: double, or a
/// Pack of several contacts' numbers.
template <class R> struct GranularSubModels {
  R springless;         ///< whether there is no tangential spring: then its stiffness is 0
  R keeps_force;        ///< whether that is kept as the force that it has: mindlin/force [N], else as a length [m]
  R rescales;           ///< whether what is kept shrinks with the area: mindlin_rescale
  R rolls;              ///< whether sds resists rolling
  R rolling_stiffness;  ///< [N/m]
  R rolling_damping;    ///< [kg/s]
  R rolling_friction;   ///< [-]
  R twists;             ///< whether sds or marshall resists twisting
  R twists_by_area;     ///< whether marshall does: what friction has all over the area, in place of these three
  R twisting_stiffness; ///< [N m]
  R twisting_damping;   ///< [N m s]
  R twisting_friction;  ///< [m]
  R adheres;            ///< whether dmt does: then the limits count what presses the bodies together, without a dashpot
  R pull_of_radius;     ///< of dmt, over the reduced radius [N/m]
};

/// The law of a granular with all of them, also where some pairs of types have other ones than others. What no contact
/// of a pack has is not computed. R: as above.
template <GranularOrder order, class R> struct TurnedSpringWithSubModels : TurnedSpring<order, R> {
  template <class Number> using Over = TurnedSpringWithSubModels<order, Number>;
  static constexpr bool rolls = true;
  static constexpr bool twists = true;
  static constexpr bool one_torque = order != GranularOrder::of_2021; ///< see sums_torques

  GranularSubModels<R> sub_models;

  /// springs: with area(), rolling() and twist(), see HistoryPlaces.
  template <Friction kind, class Springs>
  [[gnu::always_inline]] BasicTurningPairForce<R> act(const BasicSpherePair<R> &pair, const Springs &springs) const {
    const R pull = sub_models.pull_of_radius * this->reduced_radius;
    R elastic;
    const AlongNormal n =
        this->along_normal(pair, [&](const R &spring) CFPM_INLINED { return elastic = spring - pull; });
    const Turning turning{n, pair.i.spin - pair.j.spin, pressing(n, elastic, pull)};
    const Slipping friction = this->friction_of(n, turning.pressing);
    const BasicVec3<R> slip_velocity = this->slip_velocity_of(n, pair);
    BasicTurningPairForce<R> force{};
    if constexpr (kind == Friction::dashpot) {
      force.pair = this->with_friction(n, pair, dashpot_friction(friction.damping, friction.limit, slip_velocity));
    } else {
      force.pair = this->with_friction(n, pair, friction_of_spring(n, friction, slip_velocity, springs));
      if (any(R(0.0) < sub_models.rolls)) force.rolling = rolling_couple(turning, springs.rolling());
      if (any(R(0.0) < sub_models.twists)) force.twisting = twisting_couple(turning, friction, springs.twist());
    }
    return force;
  }

private:
  using AlongNormal = typename TurnedSpring<order, R>::AlongNormal;
  using Slipping = TurnedFriction<order, false, R>;
  struct Turning {
    const AlongNormal &n;
    BasicVec3<R> spin; ///< of i less that of j [rad/s]
    R pressing;        ///< the normal force that limits count [N]
  };

  [[gnu::always_inline]] R pressing(const AlongNormal &n, const R &elastic, const R &pull) const {
    using std::fabs;
    return fabs(select(R(0.0) < sub_models.adheres, elastic + 2.0 * pull, n.push));
  }

  template <class Springs>
  [[gnu::always_inline]] BasicVec3<R> friction_of_spring(const AlongNormal &n, const Slipping &friction,
                                                         const BasicVec3<R> &velocity, const Springs &springs) const {
    const auto is_force = R(0.0) < sub_models.keeps_force;
    const R stiffness = friction.stiffness;
    BasicVec3<R> spring = springs.load();
    if (any(R(0.0) < sub_models.rescales)) spring = rescaled(spring, n.area_radius, springs.area());
    spring = friction.turned(spring, n.normal, select(is_force, R(1.0), stiffness));
    spring = spring + select(is_force, -slipped_force(stiffness, velocity), this->dt * velocity);
    // a force that is kept is a spring of stiffness -1, to the last bit
    const Slipping kept{select(is_force, R(-1.0), stiffness), friction.damping, friction.limit, this->dt};
    const BasicVec3<R> force = kept.force_of(spring, velocity, springs);
    if constexpr (order != GranularOrder::of_2021) { // there a force of 0 is kept
      const auto springless = R(0.0) < sub_models.springless;
      if (any(springless))
        return select(springless, dashpot_friction(friction.damping, friction.limit, velocity), force);
    }
    return force;
  }

  /// While the area shrinks.
  template <class Number> [[gnu::always_inline]] BasicVec3<R> rescaled(const BasicVec3<R> &spring, const R &area_radius,
                                                                       const Number &kept_radius) const {
    const R before = kept_radius.load();
    const R factor = select(area_radius < sub_models.rescales * before, area_radius / before, R(1.0));
    kept_radius.store(select(R(0.0) < sub_models.rescales, area_radius, before));
    return factor * spring;
  }

  [[gnu::always_inline]] BasicVec3<R> slipped_force(const R &stiffness, const BasicVec3<R> &velocity) const {
    if constexpr (order == GranularOrder::of_2021)
      return this->dt * (stiffness * velocity);
    else
      return (stiffness * this->dt) * velocity;
  }

  template <class Springs>
  [[gnu::always_inline]] BasicVec3<R> rolling_couple(const Turning &t, const Springs &springs) const {
    const R radius = sub_models.rolls * this->reduced_radius;
    const TurnedFriction<order, true, R> friction{sub_models.rolling_stiffness, sub_models.rolling_damping,
                                                  sub_models.rolling_friction * t.pressing, this->dt};
    return radius * cross(t.n.normal, friction.force(t.n.normal, radius * cross(t.spin, t.n.normal), springs));
  }

  /// friction: of slip.
  template <class Number> [[gnu::always_inline]] BasicVec3<R>
  twisting_couple(const Turning &t, const Slipping &friction, const Number &twist) const {
    using std::fabs;
    const auto by_area = R(0.0) < sub_models.twists_by_area;
    const R area_radius = t.n.area_radius;
    const R stiffness =
        select(by_area, 0.5 * slip_stiffness(friction) * area_radius * area_radius, sub_models.twisting_stiffness);
    const R damping = select(by_area, 0.5 * friction.damping * area_radius * area_radius, sub_models.twisting_damping);
    const R limit = select(by_area, slip_friction(area_radius), sub_models.twisting_friction) * t.pressing;
    const R rate = sub_models.twists * dot(t.spin, t.n.normal);
    const R turned = twist.load() + rate * this->dt;
    const R sticking = -stiffness * turned - damping * rate;
    const R against = select(R(0.0) < rate, limit, select(rate < R(0.0), -limit, R(0.0)));
    const auto slides = limit < R(fabs(sticking));
    twist.store(select(slides, at_limit(R(against - damping * rate), stiffness), turned));
    return R(select(slides, -against, sticking)) * t.n.normal;
  }

  [[gnu::always_inline]] R slip_stiffness(const Slipping &friction) const {
    if constexpr (order == GranularOrder::of_2021)
      return friction.stiffness;
    else
      return this->material.tangential_constant + this->material.tangential_area; // one of them is 0
  }
  /// Its mean lever over the area times the coefficient [m].
  [[gnu::always_inline]] R slip_friction(const R &area_radius) const {
    constexpr double lever = 2.0 / 3.0;
    if constexpr (order == GranularOrder::of_2021)
      return lever * area_radius * this->material.friction;
    else
      return lever * this->material.friction * area_radius;
  }
  [[gnu::always_inline]] static R at_limit(const R &couple, const R &stiffness) {
    if constexpr (order == GranularOrder::of_2021)
      return 1.0 / stiffness * couple;
    else
      return couple / stiffness;
  }
};

} // namespace cfpm
