// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "linear_law.h"
#include "oscillator.h"
#include "predictors/exact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cfpm {

/// When a spring that is released from rest has given its bodies the most impulse, a quarter of its period: later it
/// takes back. At an overdamped contact about when the dashpot has caught up with it [s].
inline double time_of_largest_impulse(const Oscillator &o) {
  const double b = o.damping / (2.0 * o.mass);
  const double frequency_squared = o.stiffness / o.mass - b * b;
  if (frequency_squared > 0.0) return std::atan2(std::sqrt(frequency_squared), b) / std::sqrt(frequency_squared);
  return b > 0.0 ? 1.0 / b : std::numeric_limits<double>::infinity();
}

/// What one direction of a contact gives over a step dt where other contacts hold its bodies and do not know of it:
/// J/m = (C d + D u) over 1 + crowding, see Crowd, so that a network of contacts comes to rest at any step. All
/// contacts see the same bodies at once: a mode of the network in which they act together, L times as strong as one
/// alone, has the determinant 1 - L (D - C dt/2) over a step, and the sum of 1, trace and determinant 4 - 2 L D. It
/// dies out while C dt/2 < D < 2/L.
struct CrowdResponse {
  Propagator map;   ///< of the bodies that are alone, up to the largest impulse: C is minus rate_from_displacement
  double softening; ///< on C: C dt is at most pi/2, as of an undamped spring over a quarter of its period
  double most;      ///< 1/D: on the impulse of a contact that feels 1 + crowding, over which it is, 1 at most

  CrowdResponse(const Oscillator &o, double span, double dt)
      : map(make_propagator<Exact>(o, span)), softening(std::min(1.0, 0.5 * pi / (-map.rate_from_displacement * dt))),
        most(1.0 / (1.0 - map.rate_from_rate)) {}

  /// On the impulse.
  double relaxation(double crowding) const { return std::min(1.0, most / crowding); }
};

} // namespace cfpm
