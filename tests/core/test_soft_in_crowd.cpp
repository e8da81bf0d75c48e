// SPDX-License-Identifier: GPL-2.0-or-later
// What crowds do between a run of large steps and one of smaller ones.
#include "core/deck/method_and_step.h"
#include "core/method/impulses/linear_impulse.h"
#include "core/method/impulses/soft_in_crowd.h"
#include "core/step/crowd_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cfpm::testing {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const LinearLaw law{1e5, 3.0, 4e4, 2.0, 0.5, with_tension};
constexpr double mass = 1e-3;
const double tc = contact_time(law.normal_stiffness, mass);

LinearImpulse over(double dt) { return {law, mass, mass / 3.5, dt}; }

TEST(SoftInCrowd, GivesItsPartOfTheLargerStep) {
  const LinearImpulse before = over(tc / 2.0);
  const LinearImpulse now = over(tc / 30.0);
  const SoftInCrowd<LinearImpulse> soft(now, before);
  for (const double crowding : {1.5, 3.0})
    for (const double speed : {0.0, 0.02, -0.01}) {
      const NormalImpulse a = soft.normal_in_crowd(1e-5, speed, now.dt(), crowding);
      const NormalImpulse b = before.normal_in_crowd(1e-5, speed, before.dt(), crowding);
      EXPECT_DOUBLE_EQ(a.impulse / now.dt(), b.impulse / before.dt());
      EXPECT_DOUBLE_EQ(a.contact_time, now.dt());
      const CrowdResponse part = soft.slip_in_crowd(a);
      const CrowdResponse whole = before.slip_in_crowd(b);
      EXPECT_DOUBLE_EQ(part.rate_from_displacement / now.dt(), whole.rate_from_displacement / before.dt());
      EXPECT_NEAR((1.0 - part.rate_from_rate) / now.dt(), (1.0 - whole.rate_from_rate) / before.dt(), 1e-9 / tc);
      EXPECT_EQ(part.relaxation(crowding), whole.relaxation(crowding));
    }
}

/// The part of the larger step, times that step, may be rounded to another number than the step.
TEST(SoftInCrowd, KeepsItsSpringAtAnyStep) {
  const LinearImpulse now = over(tc / 30.0);
  int rounded = 0;
  for (int k = 0; k < 100; ++k) {
    const double before = now.dt() * (1.0 + 0.1 * k);
    if (before * (now.dt() / before) != now.dt()) ++rounded;
    const SoftInCrowd<LinearImpulse> soft(now, over(before));
    EXPECT_EQ(soft.normal_in_crowd(1e-5, 0.0, now.dt(), 1.5).contact_time, now.dt()) << before;
  }
  EXPECT_GT(rounded, 0);
}

TEST(SoftInCrowd, IsAsEverAloneAndInTheStepOfTheTouch) {
  const LinearImpulse now = over(tc / 30.0);
  const SoftInCrowd<LinearImpulse> soft(now, over(tc / 2.0));
  EXPECT_EQ(soft.normal(1e-5, 0.02, now.dt()).impulse, now.normal(1e-5, 0.02, now.dt()).impulse);
  const double span = 0.3 * now.dt();
  const NormalImpulse a = soft.normal_in_crowd(0.0, 0.02, span, 2.0);
  const NormalImpulse b = now.normal_in_crowd(0.0, 0.02, span, 2.0);
  EXPECT_EQ(a.impulse, b.impulse);
  EXPECT_EQ(soft.slip_in_crowd(a).rate_from_rate, now.slip_in_crowd(b).rate_from_rate);
  EXPECT_EQ(soft.dt(), now.dt());
}

TEST(CrowdStep, GoesFromOneToTheOtherOver400ContactTimes) {
  CrowdStep step;
  EXPECT_EQ(step.next(0.1), 0.1);
  step.soften(1.0, 0.1, 2.0);
  double last = 1.0;
  EXPECT_DOUBLE_EQ(step.next(0.1), 1.0);
  for (int n = 1; n < 8000; ++n) {
    const double next = step.next(0.1);
    EXPECT_LE(next, last);
    EXPECT_GT(next, 0.1);
    if (n == 4000) {
      EXPECT_NEAR(next, std::sqrt(0.1), 1e-12);
    }
    last = next;
  }
  EXPECT_LT(last, 0.101);
  for (int n = 0; n < 100; ++n) EXPECT_EQ(step.next(0.1), 0.1);
  step.soften(1.0, 0.1, 2.0);
  step.end();
  EXPECT_EQ(step.next(0.1), 0.1);
}

TEST(CrowdStep, BeginsWithARunOfSmallerStepsUnderImpulses) {
  const Method *const impulse = find_method("impulse");
  const Method *const exact = find_method("exact");
  const auto begun = [](const MethodAndStep &before, const MethodAndStep &now, double contact_time = 1.0) {
    CrowdStep step;
    begin_run(step, before, now, contact_time);
    return step.next(now.dt) > now.dt;
  };
  EXPECT_TRUE(begun({impulse, 0.3}, {impulse, 0.1}));
  EXPECT_FALSE(begun({impulse, 0.3}, {impulse, 0.1}, infinity));
  EXPECT_FALSE(begun({impulse, 0.1}, {impulse, 0.3}));
  EXPECT_FALSE(begun({impulse, 0.3}, {exact, 0.1}));
  EXPECT_FALSE(begun({exact, 0.3}, {impulse, 0.1}));
  EXPECT_FALSE(begun({}, {impulse, 0.1}));

  CrowdStep step;
  begin_run(step, {impulse, 0.3}, {impulse, 0.1}, 1.0);
  begin_run(step, {impulse, 0.1}, {impulse, 0.1}, 1.0); // what is on its way goes on
  EXPECT_GT(step.next(0.1), 0.1);
  begin_run(step, {impulse, 0.1}, {impulse, 0.2}, 1.0);
  EXPECT_EQ(step.next(0.2), 0.2);
}

} // namespace
} // namespace cfpm::testing
