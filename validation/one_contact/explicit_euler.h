// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "slope.h"

namespace cfpm::validation {

/// Explicit Euler method (Table 2, Eq. 13): force and velocity at the step's start hold over all of it.
template <class Contact> class ExplicitEuler {
public:
  ExplicitEuler(const Contact &contact, const OscillatorState &start, double dt)
      : contact_(contact), dt_(dt), state_(start) {}

  void step() { state_ = combined(1.0, state_, dt_, slope(contact_, state_)); }

  OscillatorState state() const { return state_; }

private:
  Contact contact_;
  double dt_;
  OscillatorState state_;
};

} // namespace cfpm::validation
