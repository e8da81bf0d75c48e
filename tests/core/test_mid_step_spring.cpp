// SPDX-License-Identifier: GPL-2.0-or-later
// The tangential spring that is carried at mid-step (Eq. 7).
#include "core/contact/tangential_spring.h"
#include "core/method/forces/linear_prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cfpm::testing {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2.0;
constexpr double never = std::numeric_limits<double>::infinity(); // a limit that is not reached
constexpr LinearLaw law{2.0e4, 6.0, 8.0e3, 3.0, 0.4};
constexpr Vec3 up{0.0, 0.0, 1.0};
constexpr double dt = 1.0e-4;

class Random {
public:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(generator_); }
  Vec3 vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
  Vec3 direction() {
    const Vec3 a = vector(1.0);
    return (1.0 / norm(a)) * a;
  }

private:
  std::mt19937_64 generator_{20050101};
};

TEST(MidStepSpring, NewContactHasSlippedForHalfAStep) {
  MidStepSpring spring(Vec3{}, dt);
  const Vec3 w{0.3, -0.1, 0.0};
  EXPECT_TRUE(spring.now(w) == Vec3{}); // before it is advanced there is none
  const Vec3 first = spring.advance(law, w, up, never);
  EXPECT_DOUBLE_EQ(first.x, 0.5 * dt * 0.3);
  EXPECT_DOUBLE_EQ(first.y, -0.5 * dt * 0.1);
}

TEST(MidStepSpring, ConstantSlipVelocity) {
  MidStepSpring spring(Vec3{}, dt);
  const Vec3 w{0.3, -0.1, 0.0};
  for (int n = 0; n < 100; ++n) {
    const Vec3 s = spring.advance(law, w, up, never);
    // first half a step, then n whole ones; a few roundings per step
    EXPECT_NEAR(s.x, (n + 0.5) * dt * 0.3, 3.0 * (n + 1) * unit_roundoff * 100.0 * dt * 0.3);
    EXPECT_EQ(s.z, 0.0);
  }
}

TEST(MidStepSpring, VaryingSlipVelocityGivesTheTrapezoid) {
  Random random;
  MidStepSpring spring(Vec3{}, dt);
  Vec3 last{};
  Vec3 sum{};
  for (int n = 0; n < 100; ++n) {
    const Vec3 w = tangential_part(random.vector(0.5), up);
    const Vec3 s = spring.advance(law, w, up, never);
    sum = sum + 0.5 * dt * (last + w); // last = 0 for the new contact: half a step
    last = w;
    const double tolerance = 3.0 * (n + 1) * unit_roundoff * 100.0 * dt * 0.5;
    EXPECT_NEAR(s.x, sum.x, tolerance);
    EXPECT_NEAR(s.y, sum.y, tolerance);
  }
}

/// A host evaluates forces again (at the start of a run, for output) without advancing: it must find
/// the spring it used, to the last bit, from the stored vector alone.
TEST(MidStepSpring, ReadsBackToTheLastBit) {
  Random random;
  Vec3 stored{};
  int slackened = 0;
  for (int n = 0; n < 10000; ++n) {
    const Vec3 normal = random.direction();
    const Vec3 w = tangential_part(random.vector(0.5), normal);
    const double limit = random.uniform(0.0, 2.0); // about half of the springs are longer than it allows
    MidStepSpring spring(stored, dt);
    const Vec3 used = spring.advance(law, w, normal, limit);
    ASSERT_TRUE(spring.now(w) == used) << n;
    slackened += norm(used) > 0.999 * limit / law.tangential_stiffness;
    stored = spring.stored();
    const MidStepSpring again(stored, dt);
    ASSERT_TRUE(again.now(w) == used) << n;
    ASSERT_TRUE(again.stored() == stored);
  }
  EXPECT_GT(slackened, 1000);
  EXPECT_LT(slackened, 9999);
}

TEST(MidStepSpring, StaysInTheTangentPlane) {
  Random random;
  MidStepSpring spring(Vec3{}, dt);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 normal = random.direction();
    const Vec3 w = tangential_part(random.vector(0.5), normal);
    const double before = norm(spring.stored());
    spring.advance(law, w, normal, never);
    // n and w are themselves unit and tangential to rounding: 16 roundings of the vector turned
    ASSERT_LE(std::fabs(dot(spring.now(w), normal)), 16.0 * unit_roundoff * (before + dt * norm(w)));
  }
}

TEST(MidStepSpring, TurnsWithTheNormalWithoutGrowing) {
  MidStepSpring spring(Vec3{1e-4, 2e-4, 0.0}, dt);
  const Vec3 normal{0.6, 0.0, 0.8};
  spring.advance(law, Vec3{}, normal, never);
  const Vec3 expected = tangential_part(Vec3{1e-4, 2e-4, 0.0}, normal);
  EXPECT_TRUE(spring.now(Vec3{}) == expected);
  EXPECT_LT(norm(expected), norm(Vec3{1e-4, 2e-4, 0.0}));
}

TEST(MidStepSpring, SlackensToTheCoulombLimit) {
  Random random;
  for (int n = 0; n < 1000; ++n) {
    const Vec3 w = tangential_part(random.vector(0.5), up);
    const Vec3 start = tangential_part(random.vector(1e-2), up);
    const double limit = random.uniform(0.0, 1.0);
    MidStepSpring spring(start, dt);
    spring.advance(law, w, up, limit);
    const Vec3 unlimited = start + 0.5 * dt * w;
    const double longest = limit / law.tangential_stiffness;
    const Vec3 expected = norm(unlimited) > longest ? (longest / norm(unlimited)) * unlimited : unlimited;
    // adding and taking away dt w/2 costs a rounding of it
    const double tolerance = 8.0 * unit_roundoff * (norm(unlimited) + dt * norm(w));
    ASSERT_LE(norm(spring.now(w) - expected), tolerance);
    ASSERT_LE(norm(spring.now(w)), longest + tolerance);
  }
}

TEST(MidStepSpring, SlackensTogetherWithTheDashpot) {
  Random random;
  const auto pull = [](const Vec3 &spring, const Vec3 &w) {
    return law.tangential_stiffness * spring + law.tangential_damping * w;
  };
  for (int n = 0; n < 1000; ++n) {
    const Vec3 w = tangential_part(random.vector(0.5), up);
    const Vec3 start = tangential_part(random.vector(1e-2), up);
    const double limit = random.uniform(0.0, 1.0);
    MidStepSpring spring(start, dt);
    spring.advance<Friction::limited_together>(law, w, up, limit);
    const Vec3 unlimited = start + 0.5 * dt * w;
    const Vec3 both = pull(unlimited, w);
    const Vec3 expected = norm(both) > limit ? (limit / norm(both)) * both : both;
    const double tolerance = 16.0 * unit_roundoff * (norm(both) + norm(pull({}, w)));
    ASSERT_LE(norm(pull(spring.now(w), w) - expected), tolerance);
  }
}

/// With ks = 0 there is nothing to slacken and nothing to pull: whatever is stored, the force is the
/// dashpot's (no NaN from a limit divided by a stiffness of zero).
TEST(MidStepSpring, ALawWithoutSpringExertsNone) {
  LinearLaw dashpot = law;
  dashpot.tangential_stiffness = 0.0;
  const PredictedLaw contact = LinearPrediction(dashpot, 0.02, 0.02 / 3.5, *find_predictor("exact"), dt).at(0.0, 0.0);
  const Vec3 w{0.1, 0.0, 0.0};
  MidStepSpring spring(Vec3{1e-4, 0.0, 0.0}, dt);
  for (const double limit : {0.0, 1.0}) {
    const TangentialAction with =
        predict_tangential<Friction::spring_and_dashpot>(contact, spring.advance(dashpot, w, up, limit), w, 1.0, 1.0);
    const TangentialAction without = predict_tangential<Friction::spring_and_dashpot>(contact, Vec3{}, w, 1.0, 1.0);
    EXPECT_TRUE(with.force == without.force);
    EXPECT_TRUE(with.predicted == without.predicted);
  }
}

TEST(MidStepSpring, KeepsItsLengthWhenTheStepChanges) {
  const Vec3 w{0.3, -0.1, 0.0};
  MidStepSpring spring(Vec3{1e-4, 2e-4, 0.0}, dt);
  const Vec3 before = spring.advance(law, w, up, never);
  spring.change_step(w, 0.25 * dt);
  // two sums and two differences of lengths up to |stored|
  EXPECT_LE(norm(spring.now(w) - before), 4.0 * unit_roundoff * (norm(before) + dt * norm(w)));
  EXPECT_LE(norm(spring.stored() - (before + 0.125 * dt * w)), 4.0 * unit_roundoff * (norm(before) + dt * norm(w)));

  MidStepSpring none(Vec3{}, dt);
  none.change_step(w, 0.25 * dt);
  EXPECT_TRUE(none.stored() == Vec3{});
}

} // namespace
} // namespace cfpm::testing
