// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/law_kind.h"
#include "core/motion/exact_flow.h"
#include "core/motion/oscillator.h"
#include "core/predict/right_from.h"

namespace cfpm {

/// The exact solution (Table 3), which is known where a law is linear or self-similar.
struct Exact {
  static constexpr const char *name = "exact";
  static constexpr LawKind most_general = LawKind::self_similar;
  /// Undamped limit of the whole step (Eq. 27 with this prediction) on t* = dt/tc.
  static constexpr double stable_below = 1.0;
  static constexpr RightFrom right_from{6.0, 6.0, 30.0};
  static constexpr RightFrom right_from_with_onset{RightFrom::unmeasured, RightFrom::unmeasured, 6.0};

  static OscillatorState advance(const Oscillator &o, const OscillatorState &s, double t) {
    return exact_flow(o, t)(s);
  }
};

/// One evaluation in place of two.
template <> inline Propagator make_propagator<Exact>(const Oscillator &o, double dt) { return exact_flow(o, dt); }

} // namespace cfpm
