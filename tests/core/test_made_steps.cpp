// SPDX-License-Identifier: GPL-2.0-or-later
// The numbers of contacts of any sizes, made by series, are those of the closed forms: to the last bit where both have
// the same arithmetic, else to some roundings. What packs make of them is compared in test_packed_pairs.cpp.
#include "core/method/made_steps.h"
#include "core/numbers/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace cfpm::testing {
namespace {

constexpr double rounding = 2.2e-16;

TEST(Series, AreTheFunctions) {
  for (double x = -690.0; x <= 0.0; x += 0.00713) // the library's is right to one rounding
    ASSERT_NEAR(exponential(x), std::exp(x), 2.0 * rounding * std::exp(x)) << x;
  ASSERT_EQ(exponential(0.0), 1.0);
  for (double cosine = 0.0; cosine < 1.0; cosine += 0.000113) {
    const long double angle = std::acos(static_cast<long double>(cosine));
    // two roots, whose sums are below 2, a sum of twelve terms that is near 1, a product and a quotient
    ASSERT_NEAR(angle_over_sine(cosine), static_cast<double>(angle / std::sin(angle)), 4.0 * rounding) << cosine;
  }
  EXPECT_EQ(angle_over_sine(1.0), 1.0);
}

struct Case {
  LinearLaw law;
  double mass;
  double dt;

  double tangential_mass() const { return mass / 3.5; }
  double rate() const { return std::sqrt(law.normal_stiffness / mass); }
  double slip_rate() const { return std::sqrt(law.tangential_stiffness / tangential_mass()); }
};

/// From no damping to beyond what is critical, with and without tension, steps from much shorter to longer than
/// contacts.
std::vector<Case> cases(double most_damping) {
  std::vector<Case> all;
  for (const double least_force : {without_tension, with_tension})
    for (const double zeta : {0.0, 0.04, 0.3, 0.6, 0.79, 0.81, 0.89, 0.91, 1.0, 1.7})
      for (const double nt : {0.4, 1.1, 3.0, 7.0, 30.0, 300.0})
        for (const double mass : {0.003, 0.017}) {
          const double k = 3e4;
          const double h = 2.0 * zeta * std::sqrt(k * mass);
          if (zeta <= most_damping)
            all.push_back({{k, h, 0.7 * k, 0.4 * h, 0.3, least_force}, mass, pi * std::sqrt(mass / k) / nt});
        }
  return all;
}

/// See FlowBySeries.IsTheExactFlow.
double of_flow(double rate, const Case &c) { return 10.0 * rounding * std::max(1.0, 8.0 * rate * c.dt); }

TEST(MadeSteps, PredictWithTheBitsOfKeptOnes) {
  for (const Case &c : cases(2.0))
    for (const char *const name : {"trapezoid", "rk2", "rk4"}) {
      const Predictor &predictor = *find_predictor(name);
      const LinearPrediction kept(c.law, c.mass, c.tangential_mass(), predictor, c.dt);
      const auto made = linear_step(c.law, c.mass, c.tangential_mass(), predictor, c.dt);
      ASSERT_EQ(std::memcmp(&made, &kept.step(), sizeof made), 0) << name;
    }
}

TEST(MadeSteps, PredictExactlyToSomeRoundings) {
  for (const Case &c : cases(2.0)) {
    const LinearPrediction kept(c.law, c.mass, c.tangential_mass(), *find_predictor("exact"), c.dt);
    const auto expected = kept.step();
    const auto made = linear_step(c.law, c.mass, c.tangential_mass(), *find_predictor("exact"), c.dt);
    // the force of a unit overlap and of a unit speed, of spring and dashpot together
    const double normal = c.law.normal_stiffness + c.law.normal_damping * c.rate();
    const double tangential = c.law.tangential_stiffness + c.law.tangential_damping * c.slip_rate();
    const double of_normal = of_flow(c.rate(), c) * normal;
    const double of_slip = of_flow(c.slip_rate(), c) * tangential;
    EXPECT_NEAR(made.end.normal.stiffness, expected.end.normal.stiffness, of_normal);
    EXPECT_NEAR(made.end.normal.damping, expected.end.normal.damping, of_normal / c.rate());
    EXPECT_NEAR(made.end.tangential.stiffness, expected.end.tangential.stiffness, of_slip);
    EXPECT_NEAR(made.end.tangential.damping, expected.end.tangential.damping, of_slip / c.slip_rate());
    EXPECT_NEAR(made.end.of_overlap.from_overlap, expected.end.of_overlap.from_overlap, of_flow(c.rate(), c));
    EXPECT_NEAR(made.end.of_overlap.from_speed, expected.end.of_overlap.from_speed, of_flow(c.rate(), c) / c.rate());
    EXPECT_EQ(made.dt, c.dt);
  }
}

/// Impulses of any state, over the mass and the speed that the state has or would get from its overlap. Besides the
/// flow they hold the polynomials of what is released, whose factors are at most some ten: with as many operations
/// each.
TEST(MadeSteps, GiveImpulsesToSomeRoundings) {
  int kept_count = 0;
  for (const Case &c : cases(2.0)) {
    const LinearImpulse kept(c.law, c.mass, c.tangential_mass(), c.dt);
    const auto made = linear_crowd_step(c.law, c.mass, c.tangential_mass(), c.dt);
    ASSERT_EQ(made.fits, kept.crowd_step() != nullptr);
    const LinearImpulse with_made(kept, made);
    ASSERT_EQ(with_made.crowd_step() != nullptr, made.fits);
    if (!made.fits) continue;
    ++kept_count;
    ASSERT_EQ(std::memcmp(with_made.crowd_step(), &made.step, sizeof made.step), 0);
    const double tolerance = of_flow(c.rate(), c) + 200.0 * rounding;
    for (const double angle : {-1.5, -1.0, -0.6, -0.2, 0.0, 0.2, 0.6, 1.0, 1.5})
      for (const double crowding : {1.0, 4.0}) {
        const double overlap = 1e-4 * std::cos(angle);
        const double speed = 1e-4 * c.rate() * std::sin(angle);
        const auto expected = kept.crowd_step()->normal_in_crowd(overlap, speed, crowding);
        const auto found = made.step.normal_in_crowd(overlap, speed, crowding);
        EXPECT_NEAR(found.impulse, expected.impulse, tolerance * c.mass * 1e-4 * c.rate()) << angle;
        EXPECT_EQ(found.contact_time, expected.contact_time);
      }
    const auto slip = made.step.slip;
    const auto expected = kept.crowd_step()->slip;
    const double of_slip = of_flow(c.slip_rate(), c);
    EXPECT_NEAR(slip.rate_from_displacement, expected.rate_from_displacement, of_slip * c.slip_rate());
    EXPECT_NEAR(slip.rate_from_rate, expected.rate_from_rate, of_slip);
    // over a short step the rate of a displacement and 1 - D are small, and their inverses as much less exact
    EXPECT_NEAR(1.0 / slip.most, 1.0 / expected.most, of_slip);
    EXPECT_NEAR(slip.softening, expected.softening, 2.0 * of_slip);
  }
  EXPECT_GT(kept_count, 100);
}

/// Also where friction has no spring, or nothing at all.
TEST(MadeSteps, GiveImpulsesWithoutSpring) {
  for (const double ht : {0.0, 3.0}) {
    const LinearLaw law{3e4, 2.0, 0.0, ht, 0.3};
    const double mass = 0.01;
    const double dt = 2e-4;
    const LinearImpulse kept(law, mass, mass / 3.5, dt);
    const auto made = linear_crowd_step(law, mass, mass / 3.5, dt);
    EXPECT_TRUE(made.fits);
    EXPECT_EQ(made.step.slip.rate_from_displacement, 0.0);
    EXPECT_NEAR(made.step.slip.rate_from_rate, kept.crowd_step()->slip.rate_from_rate, 10.0 * rounding);
    EXPECT_EQ(made.step.slip.softening, 1.0);
  }
}

} // namespace
} // namespace cfpm::testing
