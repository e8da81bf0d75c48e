// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/law_kind.h"
#include "core/motion/oscillator.h"
#include "core/predict/right_from.h"

namespace cfpm {

/// Modified second-order Runge-Kutta (Eqs. 31-34): the position is closed by the trapezoid.
struct RungeKutta2 {
  static constexpr const char *name = "rk2";
  static constexpr LawKind most_general = LawKind::any;
  /// Undamped limit of the whole step on t* = dt/tc: 2/pi.
  static constexpr double stable_below = 0.63661977236758134308;
  static constexpr RightFrom right_from{RightFrom::unmeasured, RightFrom::unmeasured, 30.0};
  static constexpr RightFrom right_from_with_onset{RightFrom::unmeasured, RightFrom::unmeasured, 4.0};

  /// Contact: any law with acceleration(displacement, rate). R: the number that the components of T are.
  template <class Contact, class T, class R>
  [[gnu::always_inline]] static RelativeState<T> advance(const Contact &c, const RelativeState<T> &s, const R &dt) {
    const T half_rate = s.rate + 0.5 * dt * c.acceleration(s.displacement, s.rate); // (31)
    const T half_displacement = s.displacement + 0.5 * dt * s.rate;                 // (32)
    const T rate = s.rate + dt * c.acceleration(half_displacement, half_rate);      // (33)
    return {s.displacement + 0.5 * dt * (s.rate + rate), rate};                     // (34)
  }
};

} // namespace cfpm
