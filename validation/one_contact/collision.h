// SPDX-License-Identifier: GPL-2.0-or-later
// The contact that every method is tried on: a body that has just touched a wall (section 2.3). Nothing
// is 1 where a wrong power of it would not show.
#pragma once

#include "core/law/linear_law.h"
#include "core/motion/oscillator.h"

namespace cfpm::validation {

inline constexpr double mass = 0.7;      // [kg]
inline constexpr double omega = 5.0;     // [1/s]
inline constexpr double tc = pi / omega; // Eq. 17 [s]
inline constexpr OscillatorState touch{0.0, 3.0};

/// Eq. 12, two-sided, with h = 2 zeta m omega.
inline Oscillator wall_contact(double zeta) { return {mass * omega * omega, 2.0 * zeta * mass * omega, mass}; }

/// [J]
inline double energy(const OscillatorState &s) {
  return 0.5 * mass * (s.rate * s.rate + omega * omega * s.displacement * s.displacement);
}

} // namespace cfpm::validation
