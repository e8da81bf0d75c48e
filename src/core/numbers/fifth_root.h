// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"

#include <cstdint>

namespace cfpm {

/// x^(-1/5) of normal numbers x > 0, to a few units in the last place; finite for x = 0. R: double, or a Pack.
///
/// The guess y divides the logarithm of x by 5: the upper half of the bits is nearly a linear function of it, so that
/// x y^5 is between 0.84 and 1.16. With h = 1 - x y^5 the root is y (1 - h)^(-1/5), of which four terms leave
/// 0.07 h^4: 5e-5 the first time, less than rounding the second.
template <class R> [[gnu::always_inline]] inline R inverse_fifth_root(const R &x) {
  // added to an integer below it, it shows that integer in its lower bits
  constexpr double shift = 4503599627370496.0; // 2^52
  constexpr std::uint64_t shift_bits = 0x4330000000000000ULL;
  constexpr double of_one = 1287166886.0; // 6/5 of the upper bits of 1, less what makes both bounds above equal
  const R upper = number_of<R>((bits(x) >> 32) | shift_bits) - shift;
  R y = number_of<R>(bits((of_one - 0.2 * upper) + shift) << 32);
  for (int k = 0; k < 2; ++k) {
    const R square = y * y;
    const R h = 1.0 - x * y * (square * square);
    y = y + y * (h * (0.2 + h * (0.12 + h * 0.088)));
  }
  return y;
}

} // namespace cfpm
