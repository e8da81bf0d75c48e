// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/law_kind.h"
#include "core/motion/oscillator.h"
#include "core/predict/right_from.h"

#include <limits>

namespace cfpm {

/// Implicit trapezoid (Table 3): u1 = u - h (f + f1)/(2m), d1 = d + h (u + u1)/2, solved for u1.
struct Trapezoid {
  static constexpr const char *name = "trapezoid";
  static constexpr LawKind most_general = LawKind::linear;
  /// The whole step repeats the prediction, so it is stable wherever the trapezoid is: everywhere.
  static constexpr double stable_below = std::numeric_limits<double>::infinity();
  static constexpr RightFrom right_from{RightFrom::unmeasured, RightFrom::unmeasured, 30.0};
  static constexpr RightFrom right_from_with_onset{RightFrom::unmeasured, RightFrom::unmeasured, 4.0};

  template <class R> [[gnu::always_inline]] static RelativeState<R> advance(const BasicOscillator<R> &o,
                                                                            const RelativeState<R> &s, const R &dt) {
    const R half = 0.5 * dt / o.mass;
    const R u = (s.rate - half * (o.force(s.displacement, s.rate) + 0.5 * o.stiffness * dt * s.rate +
                                  o.stiffness * s.displacement)) /
                (1.0 + half * (o.damping + 0.5 * o.stiffness * dt));
    return {s.displacement + 0.5 * dt * (s.rate + u), u};
  }
};

} // namespace cfpm
