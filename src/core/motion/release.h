// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/exact_flow.h"
#include "core/motion/oscillator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cfpm {

/// The isolated motion of two bodies over a span of time: in contact, then, once no force is left, free.
struct Flight {
  OscillatorState end; ///< overlap [m], negative where they are apart, and closing speed [m/s]
  double contact_time; ///< how long they were in contact [s]
};

/// How a linear contact ends. With b = h/(2m), f0 = k d/m + 2 b u and g0 = k u/m - b f0 the force over m is
/// e^{-bt} (f0 cos Wt + g0/W sin Wt), W^2 = k/m - b^2, with hyperbolic functions where W^2 is negative.
class LinearRelease {
public:
  explicit LinearRelease(const Oscillator &o)
      : oscillator_(o), b_(o.damping / (2.0 * o.mass)), omega_squared_(o.stiffness / o.mass),
        frequency_squared_(omega_squared_ - b_ * b_), w_(std::sqrt(std::fabs(frequency_squared_))),
        duration_(time({0.0, 1.0})), restitution_(std::exp(-b_ * duration_)) {}

  /// Of a collision, from touch to release; infinite if bodies never part [s].
  double duration() const { return duration_; }
  double restitution() const { return restitution_; }

  /// When the force vanishes, from a state with a positive force; infinite if it never does [s].
  double time(const OscillatorState &s) const { return time(force(s), slope(s)); }

  /// From a state with a positive force.
  Flight fly(const OscillatorState &start, double span) const {
    const double f0 = force(start);
    const double g0 = slope(start);
    const bool at_touch = start.displacement == 0.0;
    const double contact_time = at_touch ? duration_ : time(f0, g0);
    if (!(contact_time < span)) return {exact_flow(oscillator_, span)(start), span};
    // there the force has the slope -e^{-bt} sqrt(g0^2 + W^2 f0^2), which is k/m times the closing speed
    const double speed =
        at_touch ? restitution_ * start.rate
                 : std::exp(-b_ * contact_time) * std::sqrt(g0 * g0 + frequency_squared_ * f0 * f0) / omega_squared_;
    const double overlap = 2.0 * b_ * speed / omega_squared_;
    return {{overlap - (span - contact_time) * speed, -speed}, contact_time};
  }

private:
  double force(const OscillatorState &s) const { return omega_squared_ * s.displacement + 2.0 * b_ * s.rate; }
  double slope(const OscillatorState &s) const { return omega_squared_ * s.rate - b_ * force(s); }

  double time(double f0, double g0) const {
    if (frequency_squared_ > 0.0) return std::atan2(f0 * w_, -g0) / w_;
    if (!(-g0 > f0 * w_)) return std::numeric_limits<double>::infinity();
    return w_ > 0.0 ? std::atanh(f0 * w_ / -g0) / w_ : f0 / -g0;
  }

  Oscillator oscillator_;
  double b_;                 ///< [1/s]
  double omega_squared_;     ///< k/m [1/s^2]
  double frequency_squared_; ///< W^2 [1/s^2]
  double w_;                 ///< |W| [1/s]
  double duration_;          ///< [s]
  double restitution_;
};

} // namespace cfpm
