// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "slope.h"

namespace cfpm::validation {

/// Predictor-corrector method (Table 2): Adams-Bashforth predicts, the trapezoid corrects once, with the
/// predicted force and the predicted velocity. The paper's limit, t* = 0.410, and its energy
/// error belong to this form; closing the position with the corrected velocity would change both.
template <class Contact> class PredictorCorrector {
public:
  PredictorCorrector(const Contact &contact, const OscillatorState &start, double dt)
      : contact_(contact), dt_(dt), state_(start), earlier_slope_(slope(contact, start)) {}

  void step() {
    const OscillatorState now = slope(contact_, state_);
    const OscillatorState predicted = combined(1.0, state_, dt_, combined(1.5, now, -0.5, earlier_slope_));
    state_ = combined(1.0, state_, 0.5 * dt_, combined(1.0, now, 1.0, slope(contact_, predicted)));
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
