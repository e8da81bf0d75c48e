// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "slope.h"

namespace cfpm::validation {

/// Second-order Adams-Bashforth method (Table 2): force and velocity are extrapolated to mid-step from
/// their last two values, 3/2 and -1/2. There is no earlier value where a contact begins; taking the
/// first one twice makes the first step explicit Euler, whose error of one step is of second order.
template <class Contact> class AdamsBashforth2 {
public:
  AdamsBashforth2(const Contact &contact, const OscillatorState &start, double dt)
      : contact_(contact), dt_(dt), state_(start), earlier_slope_(slope(contact, start)) {}

  void step() {
    const OscillatorState now = slope(contact_, state_);
    state_ = combined(1.0, state_, dt_, combined(1.5, now, -0.5, earlier_slope_));
    earlier_slope_ = now;
  }

  OscillatorState state() const { return state_; }

private:
  Contact contact_;
  double dt_;
  OscillatorState state_;
  OscillatorState earlier_slope_;
};

} // namespace cfpm::validation
