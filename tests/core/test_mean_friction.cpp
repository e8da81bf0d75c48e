// SPDX-License-Identifier: GPL-2.0-or-later
// How a contact reads the spring that a host keeps for it, and what it leaves there, with either method.
#include "core/method/forces/linear_prediction.h"
#include "core/method/forces/mean_friction.h"
#include "core/method/impulses/impulse_friction.h"
#include "core/method/impulses/linear_impulse.h"
#include "core/predict/predictor.h"

#include <gtest/gtest.h>

namespace cfpm::testing {
namespace {

constexpr double mass = 0.02;
constexpr double dt = 1e-4;
constexpr double last_dt = 4e-4;
constexpr LinearLaw law{2.0e4, 6.0, 8.0e3, 3.0, 1e3}; // sticks
const ContactGeometry geometry{{0.0, 0.0, 1.0}, 1e-4, 0.0, {0.02, -0.01, 0.0}, 0.01, 0.01, {}};
constexpr Vec3 kept{1e-6, 3e-6, 0.0};

const PredictedLaw &contact() {
  static const PredictedLaw c = LinearPrediction(law, mass, mass / 3.5, *find_predictor("exact"), dt)
                                    .at(geometry.overlap, geometry.closing_speed);
  return c;
}

Vec3 friction(StoredSpring stored, double normal_force = 2.0) {
  return mean_friction<Friction::spring_and_dashpot>(contact(), geometry, stored, normal_force, normal_force);
}

/// What the paper's method makes of a spring at the beginning of the step.
Vec3 friction_of(const Vec3 &spring, double normal_force = 2.0) {
  return predict_tangential<Friction::spring_and_dashpot>(contact(), spring, geometry.slip_velocity, normal_force,
                                                          normal_force)
      .mean();
}

constexpr double rounding = 1e-15;

TEST(MeanFriction, AdvancesTheSpringByTheStepBefore) {
  double values[3];
  set(kept, values); // leads by half of the last step
  const Vec3 f = friction({values, last_dt, true});
  const Vec3 spring = kept + 0.5 * last_dt * geometry.slip_velocity;
  EXPECT_LE(norm(f - friction_of(spring)), rounding * norm(f));
  // from now on it leads by half of the new one
  EXPECT_LE(norm(vec3(values) - (spring + 0.5 * dt * geometry.slip_velocity)), rounding * norm(spring));
}

TEST(MeanFriction, ReadsTheSpringAgainWithoutAdvancingIt) {
  double values[3];
  set(kept, values);
  const Vec3 f = friction({values, last_dt, false});
  const Vec3 spring = kept - 0.5 * last_dt * geometry.slip_velocity;
  EXPECT_LE(norm(f - friction_of(spring)), rounding * (norm(f) + law.tangential_stiffness * norm(kept)));

  double again[3];
  set(kept, again);
  friction({again, dt, false}); // the step has not changed
  EXPECT_EQ(vec3(again), kept);
}

TEST(MeanFriction, SlackensTheSpringToCoulombsLimit) {
  double values[3];
  set(1e6 * kept, values);
  friction({values, dt, true}, 2e-3); // a limit of 2 N
  const Vec3 spring = vec3(values) - 0.5 * dt * geometry.slip_velocity;
  EXPECT_NEAR(law.tangential_stiffness * norm(spring), 2.0, 1e-12);
}

TEST(MeanFriction, WithoutSpringIsTheDashpots) {
  const Vec3 f = mean_friction<Friction::dashpot>(contact(), geometry, {nullptr, dt, true}, 2.0, 2.0);
  EXPECT_EQ(f, friction_of({}));
  EXPECT_EQ(mean_friction<Friction::none>(contact(), geometry, {nullptr, dt, true}, 2.0, 2.0), Vec3{});
}

/// What else presses the bodies together counts in the limit, now and at the end.
TEST(MeanFriction, CountsCohesion) {
  LinearLaw weak = law;
  weak.friction = 0.5;
  const PredictedLaw step = LinearPrediction(weak, mass, mass / 3.5, *find_predictor("exact"), dt).at(1e-4, 0.0);
  ContactGeometry fast = geometry;
  fast.slip_velocity = {20.0, 0.0, 0.0}; // slides, by the dashpot alone
  const MeanForce mean = mean_force<Friction::dashpot>(step, fast, {1.0, 2.0, dt}, {nullptr, dt, true}, 3.0);
  EXPECT_NEAR(mean.force.x, -0.5 * 0.5 * (4.0 + 5.0), 1e-12);
  EXPECT_NEAR(dot(mean.force, geometry.normal), 1.5, 1e-12);
  EXPECT_EQ(mean.torque_per_lever, cross(geometry.normal, mean.force - 1.5 * geometry.normal));
}

/// An impulse keeps its spring the other way: what is stored lags by half of the step before it.
TEST(SpringAtStart, AddsHalfOfTheStepBefore) {
  double values[3];
  set(kept + Vec3{0.0, 0.0, 5e-6}, values); // out of the plane of today's contact
  const Vec3 start = spring_at_start({values, last_dt, true, nullptr}, geometry);
  EXPECT_LE(norm(start - (kept + 0.5 * last_dt * geometry.slip_velocity)), rounding * norm(start));
}

TEST(SpringAtStart, IsThatOfTheLastEvaluationIfAskedAgain) {
  double values[] = {1.0, 1.0, 1.0};
  double now[3];
  set(kept, now);
  EXPECT_EQ(spring_at_start({values, last_dt, false, now}, geometry), kept);
}

/// A contact that begins inside the step, or is released, has no old spring.
TEST(SpringAtStart, OfAContactThatBeginsOrIsNoneIsNothing) {
  const LinearImpulse kind(law, mass, mass / 3.5, dt);
  for (const bool begins : {true, false}) {
    double values[3];
    double now[3];
    set(kept, values);
    set(kept, now);
    const double span = begins ? 0.5 * dt : dt;
    const NormalImpulse normal = begins ? kind.normal(0.0, 0.1, span) : kind.normal(1e-4, -10.0, span);
    EXPECT_EQ(normal.contact_time > 0.0, begins);
    mean_force_of_impulse<Friction::spring_and_dashpot>(kind, normal, geometry, span, 1.0, {values, dt, true, now},
                                                        0.0);
    EXPECT_EQ(vec3(now), Vec3{});
    EXPECT_EQ(vec3(values) == Vec3{}, !begins);
  }
}

} // namespace
} // namespace cfpm::testing
