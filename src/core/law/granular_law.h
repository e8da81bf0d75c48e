// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"

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

  constexpr bool tension() const { return least_force < 0.0; }
  /// What acts at an overlap [m]; nothing where the bodies are apart.
  [[gnu::always_inline]] BasicLinearLaw<R> at(const R &overlap) const {
    using std::sqrt;
    const R root = sqrt(larger(R(0.0), overlap));
    const auto touching = R(0.0) < overlap;
    const R damping =
        select(touching, damping_constant + damping_quarter * R(sqrt(root)) + damping_half * root, R(0.0));
    return {select(touching, normal_constant + normal_half * root, R(0.0)),
            damping,
            select(touching, tangential_constant + tangential_half * root, R(0.0)),
            tangential_damping * damping,
            friction,
            least_force};
  }
};

using GranularLaw = BasicGranularLaw<double>;

/// The same law where nothing in it grows with the overlap.
inline LinearLaw as_linear(const GranularLaw &law) {
  return {
      law.normal_constant, law.damping_constant, law.tangential_constant, law.tangential_damping * law.damping_constant,
      law.friction,        law.least_force};
}

/// The same law where all of it grows as Hertz' contact with the damping of Tsuji.
inline HertzMindlinLaw<DampingExponent::quarter> as_self_similar(const GranularLaw &law) {
  return {law.normal_half, law.damping_quarter, law.tangential_half, law.tangential_damping * law.damping_quarter,
          law.friction,    law.least_force};
}

/// The same law where its damping grows with the area of Hertz' contact, as its springs do.
inline HertzMindlinLaw<DampingExponent::half> as_viscoelastic(const GranularLaw &law) {
  return {law.normal_half, law.damping_half, law.tangential_half, law.tangential_damping * law.damping_half,
          law.friction,    law.least_force};
}

} // namespace cfpm
