// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/linear_law.h"
#include "core/motion/flow_by_series.h"
#include "core/motion/oscillator.h"
#include "core/numbers/pack.h"
#include "core/numbers/series.h"

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
/// The same by series, over a number R, a double or a Pack: with the damping ratio zeta it is a/sin(a) over the
/// frequency without damping, where zeta = cos(a).
template <class R> [[gnu::always_inline]] inline R time_of_largest_impulse_by_series(const BasicOscillator<R> &o) {
  using std::sqrt;
  const R frequency = sqrt(R(o.stiffness / o.mass));
  const R b = o.damping / (2.0 * o.mass);
  return select(b < frequency, angle_over_sine<R>(b / frequency) / frequency, 1.0 / b);
}

/// What one direction of a contact gives over a step dt where other contacts hold its bodies too.
///
/// Alone it takes C d + D u of the rate u over the step, where d is the displacement. All contacts of a body act on it
/// at once and do not know of each other. In a mode of the network in which they act together the rate changes by L
/// times that, with L as in crowding(), and the displacement by the mean of both rates:
///   u' = u - L (C d + D u),  d' = d + dt (u + u')/2.
/// This is a 2x2 map with the determinant 1 - L D + L C dt/2 and the trace 2 - L D - L C dt/2. Both eigenvalues lie
/// within the unit circle where 1 - trace + determinant = L C dt > 0, determinant < 1, that is C dt/2 < D, and
/// 1 + trace + determinant = 4 - 2 L D > 0, that is D < 2/L. Alone, L = 1, both hold up to a quarter of the period.
/// So C is softened where it exceeds what D can damp, and the impulse relaxed to 1/(L D) of it where that is less than
/// 1, half of what would be stable.
/// R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicCrowdResponse {
  R rate_from_displacement; ///< minus C, of bodies that are alone [1/s]
  R rate_from_rate;         ///< 1 - D
  R softening;              ///< factor on C: C dt is at most pi/2, as of an undamped spring over a quarter period
  R most;                   ///< 1/D, the crowding up to which nothing is relaxed

  /// Factor on the impulse.
  [[gnu::always_inline]] R relaxation(const R &crowding) const { return select(most < crowding, most / crowding, 1.0); }
};

using CrowdResponse = BasicCrowdResponse<double>;

/// Both rates over at most dt [s] and the time of the largest impulse.
template <class R> [[gnu::always_inline]] inline BasicCrowdResponse<R> crowd_response(const R &from_displacement,
                                                                                      const R &from_rate, const R &dt) {
  const R taken = -from_displacement * dt;
  return {from_displacement, from_rate, select(0.5 * pi < taken, 0.5 * pi / taken, 1.0), 1.0 / (1.0 - from_rate)};
}
template <class R>
[[gnu::always_inline]] inline BasicCrowdResponse<R> crowd_response(const BasicPropagator<R> &map, const R &dt) {
  return crowd_response<R>(map.rate_from_displacement, map.rate_from_rate, dt);
}
/// Of a contact of any mass, by series: see time_of_largest_impulse_by_series().
template <class R>
[[gnu::always_inline]] inline BasicCrowdResponse<R> crowd_response_by_series(const BasicOscillator<R> &o, const R &dt) {
  return crowd_response<R>(flow_by_series(o, smaller(dt, time_of_largest_impulse_by_series(o))), dt);
}

} // namespace cfpm
