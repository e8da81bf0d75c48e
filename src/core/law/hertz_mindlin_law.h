// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/linear_law.h"

#include <algorithm>
#include <cmath>

namespace cfpm {

/// How damping grows with the overlap, the exponents a2 = a4 of Eqs. 2 and 6.
enum class DampingExponent {
  quarter, ///< of the paper (Tsuji): the restitution does not depend on the impact speed
  half     ///< of the granular styles that are given a damping per area
};

/// Hertz-Mindlin contact (Eqs. 2, 6 and 10 with a1 = 3/2, a3 = 1/2): the spring and the dashpot of a
/// linear law that grow with the overlap. Lengths in the denominators are powers of the overlap. R: double, or a Pack
/// of several contacts' numbers.
template <DampingExponent exponent, class R = double> struct HertzMindlinLaw {
  template <class Number> using Over = HertzMindlinLaw<exponent, Number>;
  static constexpr LawKind law_kind =
      exponent == DampingExponent::quarter ? LawKind::self_similar : LawKind::viscoelastic;
  static constexpr int history_values = 0;
  template <class Length>
  [[gnu::always_inline]] static Length touch_distance(const Length &radius_i, const Length &radius_j) {
    return radius_i + radius_j;
  }

  /// Of the overlap at rest where the force grows by a factor.
  static double overlap_factor(double force_factor) { return std::cbrt(force_factor * force_factor); }

  R normal_stiffness;     ///< kn [N/m^(3/2)]
  R normal_damping;       ///< hn [kg/(s m^a2)]
  R tangential_stiffness; ///< ks [N/m^(3/2)], 0 for a law without tangential spring
  R tangential_damping;   ///< hs [kg/(s m^a4)]
  R friction;             ///< Coulomb coefficient mu [-]
  R least_force = without_tension;

  /// That the normal spring holds at an overlap [J].
  R spring_energy(const R &overlap) const {
    using std::sqrt;
    return 0.4 * normal_stiffness * overlap * overlap * sqrt(larger(R(0.0), overlap));
  }
  constexpr bool tension() const { return least_force < 0.0; }
  /// What acts at an overlap [m]; nothing where the bodies are apart.
  [[gnu::always_inline]] BasicLinearLaw<R> at(const R &overlap) const {
    using std::sqrt;
    const R root = sqrt(larger(R(0.0), overlap));
    return at_root(root, exponent == DampingExponent::quarter ? sqrt(root) : root);
  }
  /// The same where roots are known. root: of the overlap [m^(1/2)]; damping: the overlap to the exponent [m^a2]
  [[gnu::always_inline]] BasicLinearLaw<R> at_root(const R &root, const R &damping) const {
    return {root * normal_stiffness,
            damping * normal_damping,
            root * tangential_stiffness,
            damping * tangential_damping,
            friction,
            least_force};
  }
};

/// Duration of an undamped Hertz contact in units of (m/k)^(2/5) u^(-1/5): 3.2181.
inline double hertz_contact_time_unit() {
  return 2.0 * std::pow(1.25, 0.4) * std::sqrt(pi) * std::tgamma(1.4) / std::tgamma(0.9);
}

/// The duration [s] from kn [N/m^(3/2)], m* [kg] and the impact speed u [m/s].
inline double hertz_contact_time(double stiffness, double reduced_mass, double impact_speed) {
  return hertz_contact_time_unit() * std::pow(reduced_mass / stiffness, 0.4) * std::pow(impact_speed, -0.2);
}

/// A Hertz contact is stiffest at its largest overlap, (5 m u^2/(4 k))^(2/5), with the tangent (3/2) kn d^(1/2).
/// Eq. 17 with that stiffness, over the duration of the contact: 0.7795. Limits on dt/tc shrink by this.
inline double stiffest_hertz_contact_time() {
  return pi / std::sqrt(1.5 * std::pow(1.25, 0.2)) / hertz_contact_time_unit();
}

} // namespace cfpm
