// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../oscillator.h"

namespace cfpm {

/// Modified second-order Runge-Kutta (Eqs. 31-34): the position is closed by the trapezoid.
struct RungeKutta2 {
  static constexpr const char *name = "rk2";
  /// Undamped limit of the whole step on t* = dt/tc: 2/pi.
  static constexpr double stable_below = 0.63661977236758134308;

  /// Contact: any law with force(displacement, rate) and a mass.
  template <class Contact> static OscillatorState advance(const Contact &c, const OscillatorState &s, double dt) {
    const double half_rate = s.rate - 0.5 * dt * c.force(s.displacement, s.rate) / c.mass; // (31)
    const double half_displacement = s.displacement + 0.5 * dt * s.rate;                   // (32)
    const double rate = s.rate - dt * c.force(half_displacement, half_rate) / c.mass;      // (33)
    return {s.displacement + 0.5 * dt * (s.rate + rate), rate};                            // (34)
  }
};

} // namespace cfpm
