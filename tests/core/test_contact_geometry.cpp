// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/contact/contact_geometry.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace cfpm::testing {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2.0;

TEST(TouchingSpheres, WorkedByHand) {
  // radii 2 and 1: overlap 0.25, levers 1.875 and 0.875, nothing of it rounds
  const ContactGeometry g = touching_spheres({0.0, 0.0, 2.75}, 2.75, 2.0, 1.0, {{1.0, 0.0, -5.0}, {0.0, 8.0, 3.0}},
                                             {{0.0, 2.0, 1.0}, {16.0, 0.0, 7.0}});
  EXPECT_TRUE(g.normal == (Vec3{0.0, 0.0, 1.0}));
  EXPECT_EQ(g.overlap, 0.25);
  EXPECT_EQ(g.closing_speed, 6.0);
  EXPECT_EQ(g.lever_i, 1.875);
  EXPECT_EQ(g.lever_j, 0.875);
  // at the contact point i moves with v + omega x (-1.875 z), j with v + omega x (0.875 z)
  EXPECT_EQ(g.slip_velocity.x, (1.0 - 15.0) - 0.0);
  EXPECT_EQ(g.slip_velocity.y, 0.0 - (2.0 - 14.0));
  EXPECT_EQ(g.slip_velocity.z, 0.0);
}

TEST(TouchingWall, WorkedByHand) {
  // radius 2 at 1.75 above a wall that moves: overlap 0.25, lever 1.875
  const ContactGeometry g =
      touching_wall({0.0, 0.0, 1.0}, 1.75, 2.0, {{1.0, 2.0, -5.0}, {16.0, 8.0, 3.0}}, {0.5, 0.0, 1.0});
  EXPECT_TRUE(g.normal == (Vec3{0.0, 0.0, 1.0}));
  EXPECT_EQ(g.overlap, 0.25);
  EXPECT_EQ(g.closing_speed, 6.0);
  EXPECT_EQ(g.lever_i, 1.875);
  EXPECT_EQ(g.lever_j, 0.0);
  // the lowest point moves with v + omega x (-1.875 z)
  EXPECT_EQ(g.slip_velocity.x, 1.0 - 15.0 - 0.5);
  EXPECT_EQ(g.slip_velocity.y, 2.0 + 30.0);
  EXPECT_EQ(g.slip_velocity.z, 0.0);
}

class RandomSpheres : public ::testing::Test {
protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  Vec3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  std::mt19937_64 random_{20050101};
};

/// The bodies of a pair are interchangeable: the other sees the same contact from the other side, to the
/// last bit, or ranks that compute a shared contact each for itself would not conserve momentum.
TEST_F(RandomSpheres, BothSeeTheSameContact) {
  for (int n = 0; n < 1000; ++n) {
    const Vec3 separation = vector(1.0);
    const Motion i{vector(1.0), vector(50.0)};
    const Motion j{vector(1.0), vector(50.0)};
    const double distance = norm(separation);
    const double ri = uniform(0.4, 0.6) * distance;
    const double rj = uniform(0.6, 0.7) * distance;
    const ContactGeometry one = touching_spheres(separation, distance, ri, rj, i, j);
    const ContactGeometry other = touching_spheres(-separation, distance, rj, ri, j, i);
    ASSERT_TRUE(one.normal == -other.normal);
    ASSERT_EQ(one.overlap, other.overlap);
    ASSERT_EQ(one.closing_speed, other.closing_speed);
    ASSERT_TRUE(one.slip_velocity == -other.slip_velocity);
    ASSERT_EQ(one.lever_i, other.lever_j);
    ASSERT_EQ(one.lever_j, other.lever_i);
  }
}

/// A pair that turns and travels as one rigid body neither closes nor slips: the levers add up to the
/// distance of the centres. Each of the terms that cancel rounds by a few u of itself.
TEST_F(RandomSpheres, RigidMotionIsNoSlip) {
  for (int n = 0; n < 1000; ++n) {
    const Vec3 xi = vector(1.0);
    const Vec3 xj = vector(1.0);
    const Vec3 velocity = vector(3.0);
    const Vec3 spin = vector(50.0);
    const double distance = norm(xi - xj);
    const ContactGeometry g =
        touching_spheres(xi - xj, distance, uniform(0.4, 0.6) * distance, uniform(0.6, 0.7) * distance,
                         {velocity + cross(spin, xi), spin}, {velocity + cross(spin, xj), spin});
    const double tolerance = 20.0 * unit_roundoff * (norm(velocity) + norm(spin) * (norm(xi) + norm(xj)));
    ASSERT_NEAR(g.closing_speed, 0.0, tolerance);
    ASSERT_LE(norm(g.slip_velocity), tolerance);
    ASSERT_NEAR(g.lever_i + g.lever_j, distance, 4.0 * unit_roundoff * distance);
  }
}

} // namespace
} // namespace cfpm::testing
