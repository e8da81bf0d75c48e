// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/oscillator.h"
#include "core/numbers/pack.h"
#include "core/numbers/series.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace cfpm {

/// 1/(2n + odd)! for n = 0, 1, ... in turn positive and negative.
template <std::size_t terms> constexpr std::array<double, terms> inverse_factorials(int odd) {
  std::array<double, terms> factors{};
  double factor = 1.0;
  for (std::size_t n = 0; n < terms; ++n) {
    factors[n] = factor;
    const double next = 2.0 * static_cast<double>(n) + 2.0 + odd;
    factor /= -(next - 1.0) * next;
  }
  return factors;
}

/// Of cos(sqrt(y)) and sin(sqrt(y))/sqrt(y) in y, and of exp(-q) in q.
inline constexpr auto cosine_factors = inverse_factorials<10>(0);
inline constexpr auto sine_factors = inverse_factorials<10>(1);
inline constexpr std::array<double, 12> decay_factors{
    1.0,         -1.0,          1.0 / 2.0,     -1.0 / 6.0,      1.0 / 24.0,      -1.0 / 120.0,
    1.0 / 720.0, -1.0 / 5040.0, 1.0 / 40320.0, -1.0 / 362880.0, 1.0 / 3628800.0, -1.0 / 39916800.0};

/// exact_flow() over a number R, a double or a Pack of several oscillators' numbers, without functions that are slow to
/// evaluate. omega_squared: k/m [1/s^2]; b: h/(2m) [1/s]; t: >= 0 [s].
///
/// With y = (k/m - b^2) t^2 its C is e^{-bt} cos sqrt(y) and its S, over t, e^{-bt} sin sqrt(y)/sqrt(y): entire
/// functions of y, whatever its sign. Where |y| <= 1 and bt <= 1/2 ten terms of their series are off by y^10/20! <
/// 1e-18, twelve of e^{-bt/2} by (bt/2)^12/12! < 2e-16. A longer time is halved until that holds, and the map repeated.
template <class R>
[[gnu::always_inline]] inline BasicPropagator<R> flow_by_series(const R &omega_squared, const R &b, const R &t) {
  using std::fabs;
  const R whole_q = b * t;
  const R whole_y = (omega_squared - b * b) * t * t;
  const R size = larger(R(fabs(whole_y)), 4.0 * whole_q * whole_q);
  R part = 1.0;
  for (auto longer = R(1.0) < size; any(longer); longer = R(1.0) < size * part * part)
    part = select(longer, 0.5 * part, part);
  const R q = whole_q * part;
  const R y = whole_y * part * part;
  const R half_decay = series<decay_factors>(R(0.5 * q));
  const R decay = half_decay * half_decay;
  const R cosine = decay * series<cosine_factors>(y);
  const R sine = decay * series<sine_factors>(y);
  const R from_rate = t * part * sine;
  BasicPropagator<R> map{cosine + q * sine, from_rate, -omega_squared * from_rate, cosine - q * sine};
  for (auto shorter = part < R(1.0); any(shorter); shorter = part < R(1.0)) {
    const R trace = map.displacement_from_displacement + map.rate_from_rate;
    const R across = map.displacement_from_rate * map.rate_from_displacement;
    const auto twice = [&shorter](R & entry, const R &doubled) __attribute__((always_inline)) {
      entry = select(shorter, doubled, entry);
    };
    twice(map.displacement_from_displacement,
          map.displacement_from_displacement * map.displacement_from_displacement + across);
    twice(map.displacement_from_rate, trace * map.displacement_from_rate);
    twice(map.rate_from_displacement, trace * map.rate_from_displacement);
    twice(map.rate_from_rate, map.rate_from_rate * map.rate_from_rate + across);
    twice(part, 2.0 * part);
  }
  return map;
}
template <class R>
[[gnu::always_inline]] inline BasicPropagator<R> flow_by_series(const BasicOscillator<R> &o, const R &t) {
  return flow_by_series<R>(o.stiffness / o.mass, o.damping / (2.0 * o.mass), t);
}

} // namespace cfpm
