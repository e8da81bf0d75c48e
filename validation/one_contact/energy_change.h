// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "collision.h"

#include <algorithm>
#include <cmath>

namespace cfpm::validation {

struct EnergyChange {
  double per_step;    ///< mean change of ln(energy)
  double early_swing; ///< ln(largest/smallest energy) in the first 1000 steps
  double swing;       ///< the same in all steps
};

/// Runs an undamped contact until its energy has changed by e^200, or for so many steps.
template <class Start> EnergyChange energy_change(const Start &start, double t_star, int steps) {
  constexpr int early = 1000;
  const double first = energy(touch);
  const double far = std::exp(200.0);
  auto method = start(wall_contact(0.0), touch, t_star * tc);
  double low = first;
  double high = first;
  double now = first;
  EnergyChange change{};
  int n = 0;
  while (n < steps && now < first * far && now > first / far) {
    method.step();
    ++n;
    now = energy(method.state());
    low = std::min(low, now);
    high = std::max(high, now);
    if (n == early) change.early_swing = std::log(high / low);
  }
  change.per_step = std::log(now / first) / n;
  change.swing = std::log(high / low);
  return change;
}

} // namespace cfpm::validation
