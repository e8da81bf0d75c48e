// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/oscillator.h"

#include <cmath>

namespace cfpm {

/// Exact solution of the linear contact after a time t [s] (Table 3): under-, critically and overdamped in one form.
/// d(t) = e^{-bt} [(C + bS) d0 + S u0], S and C the (hyperbolic) sine and cosine of the frequency
/// W = sqrt(k/m - b^2), b = h/(2m), with S divided by W; S -> t where W -> 0.
inline Propagator exact_flow(const Oscillator &o, double t) {
  const double b = o.damping / (2.0 * o.mass);
  const double omega_squared = o.stiffness / o.mass;
  const double frequency_squared = omega_squared - b * b;
  double cosine = 0.0; // both already multiplied by e^{-bt}: cosh and sinh alone would overflow
  double sine = 0.0;
  if (frequency_squared > 0.0) {
    const double w = std::sqrt(frequency_squared);
    const double decay = std::exp(-b * t);
    cosine = decay * std::cos(w * t);
    sine = decay * std::sin(w * t) / w;
  } else {
    const double w = std::sqrt(-frequency_squared);
    const double slow = b > 0.0 ? std::exp(-omega_squared / (b + w) * t) : 1.0; // b - w without its cancellation
    cosine = 0.5 * (slow + std::exp(-(b + w) * t));
    sine = w > 0.0 ? -0.5 * slow * std::expm1(-2.0 * w * t) / w : slow * t;
  }
  return {cosine + b * sine, sine, -omega_squared * sine, cosine - b * sine};
}

} // namespace cfpm
