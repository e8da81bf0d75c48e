// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/oscillator.h"

namespace cfpm::validation {

/// The prediction itself as an integrator, which is what Table 3 rates. Prediction gives the state at
/// t + dt from the state at t.
template <class Prediction> class PredictionAlone {
public:
  PredictionAlone(const Prediction &prediction, const OscillatorState &start)
      : prediction_(prediction), state_(start) {}

  void step() { state_ = prediction_(state_); }

  OscillatorState state() const { return state_; }

private:
  Prediction prediction_;
  OscillatorState state_;
};

} // namespace cfpm::validation
