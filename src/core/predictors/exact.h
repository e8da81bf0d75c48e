// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../law_kind.h"
#include "../oscillator.h"

#include <cmath>

namespace cfpm {

/// Exact solution of the linear contact (Table 3): under-, critically and overdamped in one form.
/// d(t) = e^{-bt} [(C + bS) d0 + S u0], S and C the (hyperbolic) sine and cosine of the frequency
/// W = sqrt(k/m - b^2), b = h/(2m), with S divided by W; S -> t where W -> 0.
struct Exact {
  static constexpr const char *name = "exact";
  static constexpr LawKind most_general = LawKind::self_similar;
  static constexpr bool impulse = false;
  /// Undamped limit of the whole step (Eq. 27 with this prediction) on t* = dt/tc.
  static constexpr double stable_below = 1.0;
  static constexpr double bed_nt = 6.0;

  static Propagator map(const Oscillator &o, double t) {
    const double b = o.damping / (2.0 * o.mass);
    const double omega_squared = o.stiffness / o.mass;
    const double frequency_squared = omega_squared - b * b;
    double cosine = 0.0; // both already multiplied by e^{-bt}: cosh and sinh alone would overflow
    double sine = 0.0;
    if (frequency_squared > 0.0) {
      const double w = std::sqrt(frequency_squared);
      const double decay = std::exp(-b * t);
      cosine = decay * std::cos(w * t);
      sine = decay * std::sin(w * t) / w;
    } else {
      const double w = std::sqrt(-frequency_squared);
      const double slow = b > 0.0 ? std::exp(-omega_squared / (b + w) * t) : 1.0; // b - w without its cancellation
      cosine = 0.5 * (slow + std::exp(-(b + w) * t));
      sine = w > 0.0 ? -0.5 * slow * std::expm1(-2.0 * w * t) / w : slow * t;
    }
    return {cosine + b * sine, sine, -omega_squared * sine, cosine - b * sine};
  }

  static OscillatorState advance(const Oscillator &o, const OscillatorState &s, double t) { return map(o, t)(s); }
};

template <> inline Propagator make_propagator<Exact>(const Oscillator &o, double dt) { return Exact::map(o, dt); }

} // namespace cfpm
