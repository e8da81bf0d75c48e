// SPDX-License-Identifier: GPL-2.0-or-later
// Functions that are slow to evaluate one by one, by their series: over a number R, a double or a Pack.
#pragma once

#include "core/numbers/pack.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace cfpm {

/// See below. n: 0, 1, ..., as many as there are pairs of terms but one.
template <const auto &factors, class R, std::size_t... n>
[[gnu::always_inline]] inline R series(const R &x, std::index_sequence<n...>) {
  constexpr std::size_t last = factors.size() - 2;
  const R square = x * x;
  R even = factors[last];
  R odd = factors[last + 1];
  ((even = factors[last - 2 - 2 * n] + square * even, odd = factors[last - 1 - 2 * n] + square * odd), ...);
  return even + x * odd;
}
/// The first terms of a series in x, from the constant on: even and odd ones apart, as either sum waits for itself.
/// factors: an array of an even size. They are literals and there is no loop: what the compiler learns late to be the
/// same in all lanes it puts together from halves.
template <const auto &factors, class R> [[gnu::always_inline]] inline R series(const R &x) {
  static_assert(factors.size() % 2 == 0);
  return series<factors>(x, std::make_index_sequence<factors.size() / 2 - 1>{});
}

/// 1/n!
inline constexpr auto exponential_factors = [] {
  std::array<double, 14> factors{};
  double factor = 1.0;
  for (std::size_t n = 0; n < factors.size(); ++n) {
    factors[n] = factor;
    factor /= static_cast<double>(n) + 1.0;
  }
  return factors;
}();

/// e^x for -700 < x <= 0, to two units in the last place.
///
/// x = k ln 2 + r with |r| <= ln(2)/2, where fourteen terms are off by r^14/14! < 5e-18. The upper part of ln 2 has so
/// few digits that k times it is exact.
template <class R> [[gnu::always_inline]] inline R exponential(const R &x) {
  constexpr double log2_e = 1.44269504088896340736;
  constexpr double upper = 6.93147180369123816490e-01;
  constexpr double lower = 1.90821492927058770002e-10;
  constexpr double shift = 4503599627370496.0; // 2^52: added to an integer below it, it shows that in its lower bits
  constexpr double bias = 1023.0;              // of the exponent of a number
  const R k = number<R>(integer(log2_e * x - 0.5));
  const R r = (x - k * upper) - k * lower;
  return number_of<R>(bits((k + bias) + shift) << 52) * series<exponential_factors>(r);
}

/// n!/(2n+1)!!
inline constexpr auto angle_factors = [] {
  std::array<double, 12> factors{};
  double factor = 1.0;
  for (std::size_t n = 0; n < factors.size(); ++n) {
    factors[n] = factor;
    factor *= (static_cast<double>(n) + 1.0) / (2.0 * static_cast<double>(n) + 3.0);
  }
  return factors;
}();

/// a/sin(a) of the angle a, from 0 to a right one, with that cosine: for cosines >= 0, to a few units in the last
/// place.
///
/// As a power series in 1 - cos(a) its terms are n!/(2n+1)!! of it. With the cosine of a/4, by halving the angle twice,
/// 1 - cos is at most 0.077, and twelve terms are off by less than 1e-17; sin(a) = 2 sin(a/2) cos(a/2) leads back.
template <class R> [[gnu::always_inline]] inline R angle_over_sine(const R &cosine) {
  using std::sqrt;
  const R half = sqrt(R(0.5 + 0.5 * cosine));
  const R quarter = sqrt(R(0.5 + 0.5 * half));
  return series<angle_factors>(R(1.0 - quarter)) / (half * quarter);
}

} // namespace cfpm
