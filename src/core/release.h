// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "oscillator.h"
#include "predictors/exact.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cfpm {

/// When the force of a linear contact vanishes, from a state with a positive force; infinite if it never does [s].
/// With b = h/(2m), f0 = k d/m + 2 b u and g0 = k u/m - b f0 the force over m is e^{-bt} (f0 cos Wt + g0/W sin Wt),
/// W^2 = k/m - b^2, with hyperbolic functions where W^2 is negative.
inline double release_time(const Oscillator &o, const OscillatorState &s) {
  const double b = o.damping / (2.0 * o.mass);
  const double omega_squared = o.stiffness / o.mass;
  const double frequency_squared = omega_squared - b * b;
  const double f0 = omega_squared * s.displacement + 2.0 * b * s.rate;
  const double g0 = omega_squared * s.rate - b * f0;
  const double w = std::sqrt(std::fabs(frequency_squared));
  if (w == 0.0) return g0 < 0.0 ? -f0 / g0 : std::numeric_limits<double>::infinity();
  if (frequency_squared > 0.0) return std::atan2(f0 * w, -g0) / w;
  return -g0 > f0 * w ? std::atanh(f0 * w / -g0) / w : std::numeric_limits<double>::infinity();
}

/// When a spring that is released from rest has given its bodies the most impulse, a quarter of its period: later it
/// takes back. At an overdamped contact about when the dashpot has caught up with it [s].
inline double time_of_largest_impulse(const Oscillator &o) {
  const double b = o.damping / (2.0 * o.mass);
  const double frequency_squared = o.stiffness / o.mass - b * b;
  if (frequency_squared > 0.0) return std::atan2(std::sqrt(frequency_squared), b) / std::sqrt(frequency_squared);
  return b > 0.0 ? 1.0 / b : std::numeric_limits<double>::infinity();
}

/// The isolated motion of two bodies over a span of time: in contact, then, once no force is left, free.
struct Flight {
  OscillatorState end; ///< overlap [m], negative where they are apart, and closing speed [m/s]
  double contact_time; ///< how long they were in contact [s]
};

/// Of a linear contact, from a state with a positive force.
inline Flight fly(const Oscillator &o, const OscillatorState &start, double span) {
  const double contact_time = std::min(span, release_time(o, start));
  OscillatorState end = Exact::advance(o, start, contact_time);
  end.displacement += (span - contact_time) * end.rate;
  return {end, contact_time};
}

} // namespace cfpm
