// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/oscillator.h"

namespace cfpm::validation {

/// Leapfrog method (Table 2): the velocity lives at mid-steps. Eq. 21 starts it, Eq. 22 brings it back to
/// the step. The force of a dashpot uses the velocity there is, half a step old: first order only.
/// Contact: any law with acceleration(displacement, rate).
template <class Contact> class Leapfrog {
public:
  Leapfrog(const Contact &contact, const OscillatorState &start, double dt)
      : contact_(contact), dt_(dt), displacement_(start.displacement), rate_(start.rate),
        acceleration_(contact.acceleration(start.displacement, start.rate)), lag_(0.0) {}

  void step() {
    rate_ += (lag_ + 0.5 * dt_) * acceleration_;
    lag_ = 0.5 * dt_;
    displacement_ += dt_ * rate_;
    acceleration_ = contact_.acceleration(displacement_, rate_);
  }

  OscillatorState state() const { return {displacement_, rate_ + lag_ * acceleration_}; } // (22)

private:
  Contact contact_;
  double dt_;
  double displacement_;
  double rate_;         ///< half a step behind the displacement, after the first step
  double acceleration_; ///< at the displacement's time
  double lag_;          ///< of the rate behind the displacement [s]
};

} // namespace cfpm::validation
