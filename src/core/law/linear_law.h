// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/law_kind.h"

#include <cmath>

namespace cfpm {

inline constexpr double pi = 3.14159265358979323846;

/// Linear spring-dashpot contact (Eqs. 2, 6 and 10 with a1 = 1, a2 = a3 = a4 = 0). Any other law is of
/// this form too while its overlap is given. Eq. 6 with its limit is predict_tangential() of a step.
struct LinearLaw {
  static constexpr LawKind law_kind = LawKind::linear;
  static constexpr bool allows_tension = false;
  static constexpr int history_values = 0; ///< of the normal direction in a contact's history
  /// Of the centres where two bodies begin to act on each other [m].
  static double touch_distance(double radius_i, double radius_j) { return radius_i + radius_j; }

  double normal_stiffness;     ///< kn [N/m]
  double normal_damping;       ///< hn [kg/s]
  double tangential_stiffness; ///< ks [N/m], 0 for a law without tangential spring
  double tangential_damping;   ///< hs [kg/s]
  double friction;             ///< Coulomb coefficient mu [-]

  /// Eq. 2 along the normal, positive where the contact pushes [N].
  constexpr double normal_force(double overlap, double closing_speed) const {
    return normal_stiffness * overlap + normal_damping * closing_speed;
  }
};

/// Duration of an undamped linear contact (Eq. 17): tc = pi sqrt(m/k).
inline double contact_time(double stiffness, double reduced_mass) { return pi * std::sqrt(reduced_mass / stiffness); }

} // namespace cfpm
