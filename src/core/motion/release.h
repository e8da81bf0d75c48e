// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/exact_flow.h"
#include "core/motion/oscillator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cfpm {

/// The isolated motion of two bodies over a span of time: in contact, then, once released, free.
struct Flight {
  OscillatorState end; ///< overlap [m], negative where they are apart, and closing speed [m/s]
  double contact_time; ///< how long they were in contact [s]
};

/// What holds a linear contact together, y: negative after the release. R: double, or a Pack.
template <class R> struct BasicHold {
  R from_displacement; ///< k/m [1/s^2], or 1 with tension
  R from_rate;         ///< 2 b [1/s], or 0

  [[gnu::always_inline]] R operator()(const RelativeState<R> &s) const {
    return from_displacement * s.displacement + from_rate * s.rate;
  }
};

/// How a linear contact ends: where what holds it vanishes, y, which is the force over m, k d/m + 2 b u, b = h/(2m), or
/// with tension the overlap d. Either obeys the equation of the contact, y'' + 2 b y' + k y/m = 0, so that from y0 and
/// g0 = y0' + b y0 on it is y = e^{-bt} (y0 cos Wt + g0/W sin Wt), W^2 = k/m - b^2, with hyperbolic functions where W^2
/// is negative. Where it vanishes, y' = -e^{-bt} sqrt(g0^2 + W^2 y0^2).
class LinearRelease {
public:
  LinearRelease(const Oscillator &o, bool tension)
      : oscillator_(o), tension_(tension), b_(o.damping / (2.0 * o.mass)), omega_squared_(o.stiffness / o.mass),
        hold_(tension ? BasicHold<double>{1.0, 0.0} : BasicHold<double>{omega_squared_, 2.0 * b_}),
        frequency_squared_(omega_squared_ - b_ * b_), w_(std::sqrt(std::fabs(frequency_squared_))),
        duration_(time({0.0, 1.0})), restitution_(std::exp(-b_ * duration_)) {}

  /// Of a collision, from touch to release; infinite if bodies never part [s].
  double duration() const { return duration_; }
  double restitution() const { return restitution_; }

  /// From a state in contact to its release; infinite if that never comes [s].
  double time(const OscillatorState &s) const { return time(hold_(s), slope(s)); }

  /// What holds the bodies together, y.
  const BasicHold<double> &hold() const { return hold_; }

  /// From a state in contact.
  Flight fly(const OscillatorState &start, double span) const {
    const double y0 = hold_(start);
    const double g0 = slope(start);
    const bool at_touch = start.displacement == 0.0;
    const double contact_time = at_touch ? duration_ : time(y0, g0);
    if (!(contact_time < span)) return {exact_flow(oscillator_, span)(start), span};
    // y' is the closing speed with tension, else, where k d = -h u, k/m times that
    const double per_slope = tension_ ? 1.0 : omega_squared_;
    const double speed =
        at_touch ? restitution_ * start.rate
                 : std::exp(-b_ * contact_time) * std::sqrt(g0 * g0 + frequency_squared_ * y0 * y0) / per_slope;
    const double overlap = tension_ ? 0.0 : 2.0 * b_ * speed / omega_squared_;
    return {{overlap - (span - contact_time) * speed, -speed}, contact_time};
  }

private:
  /// g0
  double slope(const OscillatorState &s) const {
    return tension_ ? s.rate + b_ * s.displacement : omega_squared_ * s.rate - b_ * hold_(s);
  }

  double time(double y0, double g0) const {
    if (frequency_squared_ > 0.0) return std::atan2(y0 * w_, -g0) / w_;
    if (!(-g0 > y0 * w_)) return std::numeric_limits<double>::infinity();
    return w_ > 0.0 ? std::atanh(y0 * w_ / -g0) / w_ : y0 / -g0;
  }

  Oscillator oscillator_;
  bool tension_;
  double b_;             ///< [1/s]
  double omega_squared_; ///< k/m [1/s^2]
  BasicHold<double> hold_;
  double frequency_squared_; ///< W^2 [1/s^2]
  double w_;                 ///< |W| [1/s]
  double duration_;          ///< [s]
  double restitution_;
};

} // namespace cfpm
