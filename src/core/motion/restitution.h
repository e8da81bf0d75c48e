// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"
#include "core/motion/release.h"

#include <cmath>
#include <limits>

namespace cfpm {

/// Speed after a head-on collision over the speed before it.
struct Restitution {
  double found = std::numeric_limits<double>::quiet_NaN();        ///< as the contact ends by its law
  double with_tension = std::numeric_limits<double>::quiet_NaN(); ///< if it ended where the bodies part
};

/// reduced_mass: m* [kg]
inline Restitution restitution(const LinearLaw &law, double reduced_mass) {
  const Oscillator o{law.normal_stiffness, law.normal_damping, reduced_mass};
  return {LinearRelease(o, law.tension()).restitution(), LinearRelease(o, true).restitution()};
}

/// Of the damping of the paper the same at all speeds: along the trajectory of hertz_trajectory.h exp(-(alpha/w)
/// (pi/2 - theta)), w = sqrt(5 - alpha^2), with theta where the force vanishes, or -pi/2 where the bodies part.
/// Not known where a collision depends on its speed, nor where damping lets nothing rebound.
template <DampingExponent exponent> Restitution restitution(const HertzMindlinLaw<exponent> &law, double reduced_mass) {
  if (exponent != DampingExponent::quarter) return {};
  const double alpha = law.normal_damping / std::sqrt(law.normal_stiffness * reduced_mass);
  if (!(alpha * alpha < 5.0)) return {};
  const double w = std::sqrt(5.0 - alpha * alpha);
  const auto ending_at = [&](double theta) { return std::exp(-alpha / w * (0.5 * pi - theta)); };
  const bool earlier = !law.tension() && alpha > 0.0;
  return {ending_at(earlier ? std::atan((2.0 * alpha - 5.0 / alpha) / (2.0 * w)) : -0.5 * pi), ending_at(-0.5 * pi)};
}

} // namespace cfpm
