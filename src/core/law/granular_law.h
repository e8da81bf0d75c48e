// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/adhesion.h"
#include "core/law/follows_area.h"
#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"
#include "core/law/pair_material.h"

#include <cmath>

namespace cfpm {

/// Stiffness and damping that grow with the overlap d as c0 + c1 d^(1/4) + c2 d^(1/2): sums of the powers that Hooke's
/// and Hertz' springs, the dashpots of either, of Tsuji and of viscoelastic spheres, and Mindlin's spring have, so that
/// one type of law is every combination of them. R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicGranularLaw {
  template <class Number> using Over = BasicGranularLaw<Number>;
  static constexpr LawKind law_kind = LawKind::any;
  static constexpr int history_values = 0;
  template <class Length>
  [[gnu::always_inline]] static Length touch_distance(const Length &radius_i, const Length &radius_j) {
    return radius_i + radius_j;
  }

  R normal_constant;     ///< of kn [N/m]
  R normal_half;         ///< of kn, with d^(1/2) [N/m^(3/2)]
  R damping_constant;    ///< of hn [kg/s]
  R damping_quarter;     ///< of hn, with d^(1/4) [kg/(s m^(1/4))]
  R damping_half;        ///< of hn, with d^(1/2) [kg/(s m^(1/2))]
  R tangential_constant; ///< of ks [N/m]
  R tangential_half;     ///< of ks, with d^(1/2) [N/m^(3/2)]
  R tangential_damping;  ///< hs over hn [-]
  R friction;            ///< Coulomb coefficient mu [-]
  R least_force = without_tension;
  BasicAreaSpring<R> area_spring = {};
  BasicAdhesion<R> adhesion = {};

  /// That the normal spring holds at an overlap, less what the pull has given [J].
  R spring_energy(const R &overlap) const {
    using std::sqrt;
    return (0.5 * normal_constant + 0.4 * normal_half * sqrt(larger(R(0.0), overlap))) * overlap * overlap -
           adhesion.pull * overlap;
  }
  /// By which adhesion presses two bodies together at an overlap, see BasicAdhesion::presses [N].
  [[gnu::always_inline]] R pressing_at(const R &overlap) const {
    const R area = root_of(overlap);
    return select(R(0.0) < area, (normal_constant + normal_half * area) * overlap + adhesion.pull, R(0.0));
  }
  constexpr bool tension() const { return least_force < 0.0; }
  /// With which the radius of the area goes [m^(1/2)].
  [[gnu::always_inline]] static R root_of(const R &overlap) {
    using std::sqrt;
    return sqrt(larger(R(0.0), overlap));
  }
  /// What acts at an overlap [m]; nothing where the bodies are apart. A pull is part of the stiffness, by which the
  /// spring has the force of both there.
  [[gnu::always_inline]] BasicLinearLaw<R> at(const R &overlap) const {
    using std::sqrt;
    const R root = sqrt(larger(R(0.0), overlap));
    const auto touching = R(0.0) < overlap;
    R stiffness = normal_constant + normal_half * root;
    if (adhesion.any_pulls()) stiffness = stiffness - adhesion.pull / overlap;
    const R damping =
        select(touching, damping_constant + damping_quarter * R(sqrt(root)) + damping_half * root, R(0.0));
    return {select(touching, stiffness, R(0.0)),
            damping,
            select(touching, tangential_constant + tangential_half * root, R(0.0)),
            tangential_damping * damping,
            friction,
            least_force};
  }

  /// Likewise with a spring from where the root of the overlap was another one.
  struct Springs {
    BasicLinearLaw<R> law;
    R kept;  ///< stiffness by which the spring of there has its force here [N/m]
    R fresh; ///< likewise what has slipped on the way, to second order
  };
  [[gnu::always_inline]] Springs springs_at(const R &overlap, const R &before) const {
    const R root = root_of(overlap);
    const R kept = area_spring.kept(before, root);
    const auto touching = R(0.0) < root;
    return {at(overlap), select(touching, tangential_constant + tangential_half * kept, R(0.0)),
            select(touching, tangential_constant + 0.5 * tangential_half * (root + kept), R(0.0))};
  }
};

using GranularLaw = BasicGranularLaw<double>;

/// What belongs to two materials of such a law: of the normal stiffness kn and of the tangential one at most one of two
/// terms, of the damping one of four, the others 0. R: as above.
template <class R> struct GranularMaterial {
  R normal_constant;     ///< of kn [N/m]
  R normal_area;         ///< of kn, with the radius (R* d)^(1/2) of the contact area [N/m^2]
  R damping_constant;    ///< of hn [kg/s]
  R damping_mass;        ///< of hn, with m* [1/s]
  R damping_area;        ///< of hn, with m* and that radius [1/(s m)]
  R damping_ratio;       ///< of hn, with (m* kn)^(1/2) [-]
  R tangential_constant; ///< of ks [N/m]
  R tangential_area;     ///< of ks, with that radius [N/m^2]
  R tangential_damping;  ///< hs over hn [-]
  R friction;            ///< Coulomb coefficient mu [-]
  R least_force;         ///< see without_tension [N]
};

/// The law of two bodies.
template <class R> [[gnu::always_inline]] inline BasicGranularLaw<R> granular_law(const GranularMaterial<R> &material,
                                                                                  const PairSizes<R> &sizes) {
  using std::sqrt;
  const R root = sqrt(R(1.0 / (1.0 / sizes.radius_i + 1.0 / sizes.radius_j)));
  const R mass = sizes.reduced_mass;
  const R normal_half = root * material.normal_area;
  return {material.normal_constant,
          normal_half,
          material.damping_constant + mass * material.damping_mass +
              material.damping_ratio * R(sqrt(R(mass * material.normal_constant))),
          material.damping_ratio * R(sqrt(R(mass * normal_half))),
          root * mass * material.damping_area,
          material.tangential_constant,
          root * material.tangential_area,
          material.tangential_damping,
          material.friction,
          material.least_force,
          {},
          {}};
}

/// The same law where nothing in it grows with the overlap.
template <class R> [[gnu::always_inline]] inline BasicLinearLaw<R> as_linear(const BasicGranularLaw<R> &law) {
  return {
      law.normal_constant, law.damping_constant, law.tangential_constant, law.tangential_damping * law.damping_constant,
      law.friction,        law.least_force};
}

/// The same law where all of it grows as Hertz' contact with the damping of Tsuji.
template <class R> [[gnu::always_inline]] inline HertzMindlinLaw<DampingExponent::quarter, R>
as_self_similar(const BasicGranularLaw<R> &law) {
  return {law.normal_half, law.damping_quarter, law.tangential_half, law.tangential_damping * law.damping_quarter,
          law.friction,    law.least_force};
}

/// The same law where its damping grows with the area of Hertz' contact, as its springs do.
template <class R> [[gnu::always_inline]] inline HertzMindlinLaw<DampingExponent::half, R>
as_viscoelastic(const BasicGranularLaw<R> &law) {
  return {law.normal_half, law.damping_half, law.tangential_half, law.tangential_damping * law.damping_half,
          law.friction,    law.least_force};
}

} // namespace cfpm
