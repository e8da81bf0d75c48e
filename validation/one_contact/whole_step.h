// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/oscillator.h"

namespace cfpm::validation {

/// The step of the contact force prediction method (Eqs. 20, 27) for one contact. Contact: any law with
/// force(displacement, rate) and a mass; PredictedForce gives f*(t + dt) from the state at t.
template <class Contact, class PredictedForce> class WholeStep {
public:
  WholeStep(const Contact &contact, const PredictedForce &predicted_force, const OscillatorState &start, double dt)
      : contact_(contact), predicted_force_(predicted_force), dt_(dt), state_(start) {}

  void step() {
    const double sum = contact_.force(state_.displacement, state_.rate) + predicted_force_(state_);
    const double rate = state_.rate - 0.5 * dt_ * sum / contact_.mass;
    state_ = {state_.displacement + 0.5 * dt_ * (state_.rate + rate), rate};
  }

  OscillatorState state() const { return state_; }

private:
  Contact contact_;
  PredictedForce predicted_force_;
  double dt_;
  OscillatorState state_;
};

} // namespace cfpm::validation
