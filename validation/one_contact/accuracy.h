// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "collision.h"
#include "core/predict/exact.h"

#include <cmath>

namespace cfpm::validation {

/// Distance from the exact solution, relative to the speed at touch, half a contact time after it. With
/// zeta up to 0.7 the contact still lasts there.
template <class Start> double error_in_contact(const Start &start, double zeta, int steps) {
  const double time = 0.5 * tc;
  auto method = start(wall_contact(zeta), touch, time / steps);
  for (int n = 0; n < steps; ++n) method.step();
  const OscillatorState end = method.state();
  const OscillatorState exact = Exact::advance(wall_contact(zeta), touch, time);
  return std::hypot(omega * (end.displacement - exact.displacement), end.rate - exact.rate) / touch.rate;
}

} // namespace cfpm::validation
