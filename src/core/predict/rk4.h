// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/law_kind.h"
#include "core/motion/oscillator.h"
#include "core/predict/right_from.h"

namespace cfpm {

/// Classical fourth-order Runge-Kutta (Table 3).
struct RungeKutta4 {
  static constexpr const char *name = "rk4";
  static constexpr LawKind most_general = LawKind::any;
  /// Undamped limit of the whole step on t* = dt/tc: 2/pi (the prediction alone reaches 2 sqrt(2)/pi).
  static constexpr double stable_below = 0.63661977236758134308;
  static constexpr RightFrom right_from{6.0, RightFrom::unmeasured, 30.0};
  static constexpr RightFrom right_from_with_onset{RightFrom::unmeasured, RightFrom::unmeasured, 6.0};

  /// Contact: any law with acceleration(displacement, rate). R: the number that the components of T are.
  template <class Contact, class T, class R>
  [[gnu::always_inline]] static RelativeState<T> advance(const Contact &c, const RelativeState<T> &s, const R &dt) {
    const auto derivative = [&c](const RelativeState<T> &at) __attribute__((always_inline)) {
      return RelativeState<T>{at.rate, c.acceleration(at.displacement, at.rate)};
    };
    const auto moved = [&s](const RelativeState<T> &slope, const R &h) __attribute__((always_inline)) {
      return RelativeState<T>{s.displacement + h * slope.displacement, s.rate + h * slope.rate};
    };
    const RelativeState<T> k1 = derivative(s);
    const RelativeState<T> k2 = derivative(moved(k1, 0.5 * dt));
    const RelativeState<T> k3 = derivative(moved(k2, 0.5 * dt));
    const RelativeState<T> k4 = derivative(moved(k3, dt));
    return moved({k1.displacement + 2.0 * (k2.displacement + k3.displacement) + k4.displacement,
                  k1.rate + 2.0 * (k2.rate + k3.rate) + k4.rate},
                 dt / 6.0);
  }
};

} // namespace cfpm
