// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "linear_law.h"
#include "oscillator.h"

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

/// What one direction of a contact gives over a step dt where other contacts hold its bodies too. Alone it takes
/// C d + D u of the rate u. All contacts of a body act on it at once and do not know of each other: a mode of the
/// network in which they act together, L times as strong as one alone, has over a step the determinant 1 - L (D - C
/// dt/2), and 1 + trace + determinant is 4 - 2 L D. It dies out while C dt/2 < D < 2/L; so C is softened where it
/// exceeds what D can damp, and the impulse relaxed to 1/(L D) of it where that is less, with crowding() for L.
struct CrowdResponse {
  double rate_from_displacement; ///< minus C, of bodies that are alone [1/s]
  double rate_from_rate;         ///< 1 - D
  double softening;              ///< factor on C: C dt is at most pi/2, as of an undamped spring over a quarter period
  double most;                   ///< 1/D, the crowding up to which nothing is relaxed

  /// Both rates over at most dt [s] and the time of the largest impulse.
  CrowdResponse(double from_displacement, double from_rate, double dt)
      : rate_from_displacement(from_displacement), rate_from_rate(from_rate),
        softening(-from_displacement * dt > 0.5 * pi ? 0.5 * pi / (-from_displacement * dt) : 1.0),
        most(1.0 / (1.0 - from_rate)) {}
  CrowdResponse(const Propagator &map, double dt) : CrowdResponse(map.rate_from_displacement, map.rate_from_rate, dt) {}

  /// Factor on the impulse.
  double relaxation(double crowding) const { return crowding > most ? most / crowding : 1.0; }
};

} // namespace cfpm
