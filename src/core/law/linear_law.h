// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/law_kind.h"
#include "core/numbers/pack.h"

#include <cmath>
#include <limits>

namespace cfpm {

inline constexpr double pi = 3.14159265358979323846;

/// How a contact ends, which the deck says, by the least normal force that its law allows [N]: where no force is left
/// that pushes (Eq. 36), or later, where the bodies part, which a dashpot stronger than the spring delays.
inline constexpr double without_tension = 0.0;
inline constexpr double with_tension = -std::numeric_limits<double>::infinity();

/// Linear spring-dashpot contact (Eqs. 2, 6 and 10 with a1 = 1, a2 = a3 = a4 = 0). Any other law is of
/// this form too while its overlap is given. Eq. 6 with its limit is predict_tangential() of a step. R: double, or a
/// Pack of several contacts' numbers.
template <class R> struct BasicLinearLaw {
  template <class Number> using Over = BasicLinearLaw<Number>;
  static constexpr LawKind law_kind = LawKind::linear;
  static constexpr int history_values = 0; ///< of the normal direction in a contact's history
  /// Of the centres where two bodies begin to act on each other [m].
  template <class Length>
  [[gnu::always_inline]] static Length touch_distance(const Length &radius_i, const Length &radius_j) {
    return radius_i + radius_j;
  }

  /// Of the overlap at rest where the force grows by a factor.
  static constexpr double overlap_factor(double force_factor) { return force_factor; }

  R normal_stiffness;     ///< kn [N/m]
  R normal_damping;       ///< hn [kg/s]
  R tangential_stiffness; ///< ks [N/m], 0 for a law without tangential spring
  R tangential_damping;   ///< hs [kg/s]
  R friction;             ///< Coulomb coefficient mu [-]
  R least_force = without_tension;

  /// Eq. 2 along the normal, positive where the contact pushes [N].
  [[gnu::always_inline]] constexpr R normal_force(const R &overlap, const R &closing_speed) const {
    return normal_stiffness * overlap + normal_damping * closing_speed;
  }
  /// That the normal spring holds at an overlap [J].
  constexpr R spring_energy(const R &overlap) const { return 0.5 * normal_stiffness * overlap * overlap; }
  constexpr bool tension() const { return least_force < 0.0; }
  /// The same as it acts between bodies that touch.
  [[gnu::always_inline]] constexpr R limited(const R &normal_force) const { return larger(least_force, normal_force); }
};

using LinearLaw = BasicLinearLaw<double>;

/// The time hs/ks by which the dashpot holds the tangential spring back, 0 without a spring [s].
template <class R> [[gnu::always_inline]] inline R retardation(const BasicLinearLaw<R> &law) {
  return select(R(0.0) < law.tangential_stiffness, law.tangential_damping / law.tangential_stiffness, R(0.0));
}

/// Duration of an undamped linear contact (Eq. 17): tc = pi sqrt(m/k).
inline double contact_time(double stiffness, double reduced_mass) { return pi * std::sqrt(reduced_mass / stiffness); }

} // namespace cfpm
