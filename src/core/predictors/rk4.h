// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../oscillator.h"

namespace cfpm {

/// Classical fourth-order Runge-Kutta (Table 3).
struct RungeKutta4 {
  static constexpr const char *name = "rk4";
  /// Undamped limit of the whole step on t* = dt/tc: 2/pi (the prediction alone reaches 2 sqrt(2)/pi).
  static constexpr double stable_below = 0.63661977236758134308;

  /// Contact: any law with force(displacement, rate) and a mass.
  template <class Contact> static OscillatorState advance(const Contact &c, const OscillatorState &s, double dt) {
    const auto derivative = [&c](const OscillatorState &at) {
      return OscillatorState{at.rate, -c.force(at.displacement, at.rate) / c.mass};
    };
    const auto moved = [&s](const OscillatorState &slope, double h) {
      return OscillatorState{s.displacement + h * slope.displacement, s.rate + h * slope.rate};
    };
    const OscillatorState k1 = derivative(s);
    const OscillatorState k2 = derivative(moved(k1, 0.5 * dt));
    const OscillatorState k3 = derivative(moved(k2, 0.5 * dt));
    const OscillatorState k4 = derivative(moved(k3, dt));
    const OscillatorState mean{(k1.displacement + 2.0 * k2.displacement + 2.0 * k3.displacement + k4.displacement) /
                                   6.0,
                               (k1.rate + 2.0 * k2.rate + 2.0 * k3.rate + k4.rate) / 6.0};
    return moved(mean, dt);
  }
};

} // namespace cfpm
