// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "collision.h"

namespace cfpm::validation {

/// The limit on t* lies between the two. stable = 0: unstable at the smallest t* tried; unstable = 0:
/// stable at the largest.
struct StabilityLimit {
  double stable;
  double unstable;
};

inline constexpr double smallest_t_star = 0.1;
inline constexpr double largest_t_star = 1000.0;

/// Whether an undamped contact keeps its energy bounded, from running it. A stable orbit is an ellipse,
/// and near the limit a long one: leapfrog's energy swings by 1/(1 - (t*/limit)^2), 1000 at 0.05 % below
/// the limit. Above it the energy grows by exp(2 c eps) per step at t* = limit (1 + eps), c = 2/3 for the
/// slowest (rk4's whole step): 1e5 steps at 0.05 % above give e^66 = 1e29. Between the two is 1e9, which
/// the weakest instability without a limit (Adams-Bashforth, exp(theta^4/2) per step) passes at the
/// smallest t* with e^487. The rounding of a step, 1e-16 (1 + theta^2), stays below 1e-4 up to the largest.
template <class Start> bool stable(const Start &start, double t_star) {
  constexpr int steps = 100000;
  const double bound = 1e9 * energy(touch);
  auto method = start(wall_contact(0.0), touch, t_star * tc);
  for (int n = 0; n < steps; ++n) {
    method.step();
    if (!(energy(method.state()) < bound)) return false; // also when it is no number any more
  }
  return true;
}

/// Upwards by tenths to the first t* that is unstable, then bisection to 0.1 %.
template <class Start> StabilityLimit stability_limit(const Start &start) {
  StabilityLimit limit{0.0, smallest_t_star};
  while (stable(start, limit.unstable)) {
    limit = {limit.unstable, 1.1 * limit.unstable};
    if (limit.stable > largest_t_star) return {limit.stable, 0.0};
  }
  if (limit.stable == 0.0) return limit;
  while (limit.unstable - limit.stable > 1e-3 * limit.stable) {
    const double middle = 0.5 * (limit.stable + limit.unstable);
    (stable(start, middle) ? limit.stable : limit.unstable) = middle;
  }
  return limit;
}

} // namespace cfpm::validation
