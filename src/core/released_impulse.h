// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "oscillator.h"
#include "release.h"

#include <cmath>

namespace cfpm {

/// The impulse that a linear contact gives until it is released, without functions that are slow to evaluate. Over
/// m (|u| + w d), w^2 = k/m, it depends on p = |u|/(|u| + w d) and the sign of u alone, whatever the step: here a cubic
/// for either sign, with the value and the slope that it has at rest (p = 0), at the touch (p = 1) and where the force
/// vanishes. Between these it is off by up to 0.045.
class ReleasedImpulse {
public:
  ReleasedImpulse(const Oscillator &o, const LinearRelease &release)
      : mass_(o.mass), rate_(std::sqrt(o.stiffness / o.mass)) {
    const double b = o.damping / (2.0 * o.mass);
    const double at_rest = std::exp(-b * release.time({1.0, 0.0}));
    // at rest a speed adds just itself, at the touch an overlap d adds 2 b e d
    const double e = release.restitution();
    approach_ = {at_rest, 1.0 - at_rest, 1.0 + e, 1.0 + e - 2.0 * b / rate_ * e, 1.0};
    retreat_ = {at_rest, -1.0 - at_rest, 0.0, 0.0, 1.0 / (1.0 + 2.0 * b / rate_)};
  }

  /// [N s]; overlap [m] and closing speed [m/s] of a contact with a positive force that is released before the end
  double operator()(double overlap, double closing_speed) const {
    const double speed = std::fabs(closing_speed);
    const double scale = speed + rate_ * overlap;
    return mass_ * scale * (closing_speed > 0.0 ? approach_ : retreat_)(speed / scale);
  }

private:
  /// With these values and slopes at 0 and at a length.
  class Cubic {
  public:
    Cubic() = default;
    Cubic(double value, double slope, double end_value, double end_slope, double length)
        : value_(value), slope_(slope) {
      const double rise = (end_value - value) / length;
      square_ = (3.0 * rise - 2.0 * slope - end_slope) / length;
      cube_ = (slope + end_slope - 2.0 * rise) / (length * length);
    }
    double operator()(double x) const { return value_ + x * (slope_ + x * (square_ + x * cube_)); }

  private:
    double value_ = 0.0, slope_ = 0.0, square_ = 0.0, cube_ = 0.0;
  };

  double mass_; ///< [kg]
  double rate_; ///< w [1/s]
  Cubic approach_;
  Cubic retreat_;
};

} // namespace cfpm
