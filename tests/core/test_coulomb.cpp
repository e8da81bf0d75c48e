// SPDX-License-Identifier: GPL-2.0-or-later
// What is seen from squares agrees to the last bit with what root and quotient say.
#include "core/law/coulomb.h"
#include "core/numbers/pack.h"
#include "core/numbers/two_packs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cfpm {
namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon();

/// Of one contact, in the last lane beside others that stick.
bool surely_sticks(double limit, double squared) {
  using P = TwoPacks<Pack<2>>;
  const auto lanes = [](double others, double last) {
    return Lanes<P>::fill([&](int lane) { return lane == 3 ? last : others; });
  };
  return all_surely_stick(lanes(1.0, limit), lanes(0.25, squared));
}

TEST(Coulomb, FactorIsOneWhereAContactSurelySticks) {
  int sticking = 0;
  for (const double limit : {1.0, 1.1, 1.3, 1.7, 1.9, 3e-100, 7e120})
    for (int k = -200; k <= 200; ++k) {
      const double magnitude = limit * (1.0 - k * ulp / 2);
      const double squared = magnitude * magnitude;
      if (!surely_sticks(limit, squared)) continue;
      ++sticking;
      EXPECT_EQ(coulomb_factor(limit / std::sqrt(squared)), 1.0) << limit << ", " << k;
    }
  EXPECT_GT(sticking, 7 * 100);
}

TEST(Coulomb, NothingIsSureNearTheLimitOrBeyondNumbers) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(surely_sticks(1.0, 0.99));
  EXPECT_TRUE(surely_sticks(1e-100, 0.0));
  EXPECT_FALSE(surely_sticks(1.0, 1.0 - 8 * ulp));
  EXPECT_FALSE(surely_sticks(0.0, 0.0));
  EXPECT_FALSE(surely_sticks(nan, 1.0));
  EXPECT_FALSE(surely_sticks(1.0, nan));
  EXPECT_FALSE(surely_sticks(infinite, infinite));
  EXPECT_FALSE(all_surely_stick(1.0, 0.5)); // of a single one
}

} // namespace
} // namespace cfpm
