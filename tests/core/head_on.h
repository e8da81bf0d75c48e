// SPDX-License-Identifier: GPL-2.0-or-later
// Pairs that meet head-on, stepped by their impulses.
#pragma once

#include "core/method/impulses/normal_impulse.h"

#include <gtest/gtest.h>

#include <array>

namespace cfpm::testing {

/// Overlap, closing speed.
using State = std::array<double, 2>;

/// Steps a pair through a collision, each step beginning where the one before has ended.
template <class Kind> State collide(const Kind &kind, double mass, double speed, double gap) {
  const double dt = kind.dt();
  State s{-gap, speed};
  for (int step = 0; step < 100000; ++step) {
    const double wait = s[0] < 0.0 ? (s[1] > 0.0 ? -s[0] / s[1] : 2.0 * dt) : 0.0;
    if (wait > dt) {
      if (s[1] < 0.0) return s;
      s[0] += s[1] * dt;
      continue;
    }
    const double span = dt - wait;
    const NormalImpulse n = kind.normal(s[0] + wait * s[1], s[1], span);
    s[0] += s[1] * dt - n.time_moment / mass;
    s[1] -= n.impulse / mass;
    if (s[1] < 0.0 && n.contact_time == 0.0) return s;
  }
  ADD_FAILURE() << "never parted";
  return s;
}

} // namespace cfpm::testing
