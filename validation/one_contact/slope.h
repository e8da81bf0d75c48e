// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/oscillator.h"

namespace cfpm::validation {

/// What the state of a contact changes by per second. Contact: any law with acceleration(displacement, rate).
template <class Contact> OscillatorState slope(const Contact &c, const OscillatorState &s) {
  return {s.rate, c.acceleration(s.displacement, s.rate)};
}

/// a p + b q
constexpr OscillatorState combined(double a, const OscillatorState &p, double b, const OscillatorState &q) {
  return {a * p.displacement + b * q.displacement, a * p.rate + b * q.rate};
}

} // namespace cfpm::validation
