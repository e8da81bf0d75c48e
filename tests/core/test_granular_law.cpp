// SPDX-License-Identifier: GPL-2.0-or-later
// Stiffness and damping as sums of powers of the overlap, of one number and of packs.
#include "core/law/granular_law.h"
#include "core/numbers/pack.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cfpm::testing {
namespace {

const GranularLaw all_terms{3e4, 2e6, 5.0, 40.0, 300.0, 1e4, 7e5, 0.4, 0.3, with_tension};

TEST(GranularLaw, IsASumOfPowersOfTheOverlap) {
  for (const double d : {1e-9, 1e-5, 3e-3}) {
    const LinearLaw law = all_terms.at(d);
    const double quarter = std::pow(d, 0.25);
    const double half = std::sqrt(d);
    // a root, a product and two sums of positive terms each lose at most half of a last place
    const double rounding = 4 * 2.3e-16;
    const double damping = 5.0 + 40.0 * quarter + 300.0 * half;
    EXPECT_NEAR(law.normal_stiffness, 3e4 + 2e6 * half, rounding * law.normal_stiffness);
    EXPECT_NEAR(law.normal_damping, damping, rounding * damping);
    EXPECT_NEAR(law.tangential_stiffness, 1e4 + 7e5 * half, rounding * law.tangential_stiffness);
    EXPECT_NEAR(law.tangential_damping, 0.4 * damping, 2 * rounding * damping);
    EXPECT_EQ(law.friction, 0.3);
    EXPECT_EQ(law.least_force, with_tension);
  }
}

TEST(GranularLaw, DoesNothingWhereTheBodiesAreApart) {
  for (const double d : {0.0, -1e-9, -1.0}) {
    const LinearLaw law = all_terms.at(d);
    EXPECT_EQ(law.normal_stiffness, 0.0);
    EXPECT_EQ(law.normal_damping, 0.0);
    EXPECT_EQ(law.tangential_stiffness, 0.0);
    EXPECT_EQ(law.tangential_damping, 0.0);
  }
}

TEST(GranularLaw, OfPacksIsThatOfEachLane) {
  BasicGranularLaw<Pack<2>> packed{3e4, 2e6, 5.0, 40.0, 300.0, 1e4, 7e5, 0.4, 0.3, with_tension};
  const double overlaps[] = {-1e-6, 2e-5};
  const BasicLinearLaw<Pack<2>> law = packed.at(Pack<2>::load(overlaps));
  for (int lane = 0; lane < 2; ++lane) {
    const LinearLaw one = all_terms.at(overlaps[lane]);
    EXPECT_EQ(law.normal_stiffness.values[lane], one.normal_stiffness);
    EXPECT_EQ(law.normal_damping.values[lane], one.normal_damping);
    EXPECT_EQ(law.tangential_stiffness.values[lane], one.tangential_stiffness);
    EXPECT_EQ(law.tangential_damping.values[lane], one.tangential_damping);
  }
}

void expect_equal(const LinearLaw &a, const LinearLaw &b) {
  EXPECT_EQ(a.normal_stiffness, b.normal_stiffness);
  EXPECT_EQ(a.normal_damping, b.normal_damping);
  EXPECT_EQ(a.tangential_stiffness, b.tangential_stiffness);
  EXPECT_NEAR(a.tangential_damping, b.tangential_damping, 4.5e-16 * a.tangential_damping); // a product more or less
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.least_force, b.least_force);
}

TEST(GranularLaw, IsLinearWhereNothingGrows) {
  const GranularLaw law{3e4, 0.0, 5.0, 0.0, 0.0, 1e4, 0.0, 0.4, 0.3, without_tension};
  expect_equal(law.at(2e-5), as_linear(law));
}

TEST(GranularLaw, IsTheLawOfTsujiWhereAllGrows) {
  const GranularLaw law{0.0, 2e6, 0.0, 40.0, 0.0, 0.0, 7e5, 0.4, 0.3, without_tension};
  expect_equal(law.at(2e-5), as_self_similar(law).at(2e-5));
}

/// One term of stiffness and damping each, of the sub-models of pair_style granular.
TEST(GranularLaw, OfTwoBodiesGoesWithTheirSizes) {
  const double mass = 2e-3;
  const double r = 0.004 * 0.006 / (0.004 + 0.006);
  const double d = 3e-5;
  const double area = std::sqrt(r * d);
  const PairSizes<double> sizes{0.004, 0.006, mass};
  constexpr double rounding = 16 * 2.3e-16; // of some ten operations
  const auto check = [&](const GranularMaterial<double> &material, double kn, double hn, double ks) {
    const LinearLaw law = granular_law(material, sizes).at(d);
    EXPECT_NEAR(law.normal_stiffness, kn, rounding * kn);
    EXPECT_NEAR(law.normal_damping, hn, rounding * hn);
    EXPECT_NEAR(law.tangential_stiffness, ks, rounding * ks);
    EXPECT_NEAR(law.tangential_damping, 0.7 * hn, rounding * hn);
    EXPECT_EQ(law.friction, 0.5);
    EXPECT_EQ(law.least_force, with_tension);
  };
  check({2e4, 0.0, 3.0, 0.0, 0.0, 0.0, 8e3, 0.0, 0.7, 0.5, with_tension}, 2e4, 3.0, 8e3);
  check({2e4, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0, 6e6, 0.7, 0.5, with_tension}, 2e4, 100.0 * mass, 6e6 * area);
  check({0.0, 1e7, 0.0, 0.0, 5e4, 0.0, 8e3, 0.0, 0.7, 0.5, with_tension}, 1e7 * area, 5e4 * mass * area, 8e3);
  check({0.0, 1e7, 0.0, 0.0, 0.0, 0.3, 0.0, 6e6, 0.7, 0.5, with_tension}, 1e7 * area,
        0.3 * std::sqrt(mass * 1e7 * area), 6e6 * area);
  check({2e4, 0.0, 0.0, 0.0, 0.0, 0.3, 8e3, 0.0, 0.7, 0.5, with_tension}, 2e4, 0.3 * std::sqrt(mass * 2e4), 8e3);
}

} // namespace
} // namespace cfpm::testing
