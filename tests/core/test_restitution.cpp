// SPDX-License-Identifier: GPL-2.0-or-later
// The restitution that is printed at the start of a run is that of the impulses, which collide without error.
#include "core/motion/hertz_trajectory.h"
#include "core/motion/restitution.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cfpm::testing {
namespace {

constexpr double mass = 0.02;

TEST(Restitution, OfLinearContacts) {
  for (const double zeta : {0.0, 0.1, 0.6}) {
    LinearLaw law{2e4, 2.0 * zeta * std::sqrt(2e4 * mass), 0.0, 0.0, 0.0, with_tension};
    const double expected = std::exp(-pi * zeta / std::sqrt(1.0 - zeta * zeta));
    EXPECT_NEAR(restitution(law, mass).found, expected, 1e-15);
    EXPECT_NEAR(restitution(law, mass).with_tension, expected, 1e-15);
    law.least_force = without_tension;
    EXPECT_NEAR(restitution(law, mass).with_tension, expected, 1e-15);
    if (zeta > 0.0) {
      EXPECT_GT(restitution(law, mass).found, expected + 0.01);
    }
  }
  EXPECT_NEAR(restitution(LinearLaw{1.0, 2.0 * std::sqrt(0.5), 0.0, 0.0, 0.0}, 1.0).found, std::exp(-0.5 * pi), 1e-15);
}

TEST(Restitution, OfHertzContactsIsThatOfTheirTrajectory) {
  using Law = HertzMindlinLaw<DampingExponent::quarter>;
  for (const double alpha : {0.0, 0.3, 1.5}) {
    Law law{3e6, alpha * std::sqrt(3e6 * mass), 0.0, 0.0, 0.0};
    EXPECT_NEAR(restitution(law, mass).found, -HertzTrajectory(alpha, false).tables().release()[1], 1e-13);
    EXPECT_NEAR(restitution(law, mass).with_tension, -HertzTrajectory(alpha, true).tables().release()[1], 1e-13);
    law.least_force = with_tension;
    EXPECT_EQ(restitution(law, mass).found, restitution(law, mass).with_tension);
  }
  EXPECT_TRUE(std::isnan(restitution(Law{3e6, 2.3 * std::sqrt(3e6 * mass), 0.0, 0.0, 0.0}, mass).found));
  EXPECT_TRUE(std::isnan(restitution(HertzMindlinLaw<DampingExponent::half>{3e6, 1.0, 0.0, 0.0, 0.0}, mass).found));
}

} // namespace
} // namespace cfpm::testing
