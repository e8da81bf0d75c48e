// SPDX-License-Identifier: GPL-2.0-or-later
// One contact over one step: Eqs. 2, 6, 10 and 35-40.
#include "core/method/forces/linear_prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cfpm::testing {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2.0;

constexpr LinearLaw law{2.0e4, 6.0, 8.0e3, 3.0, 0.4};
constexpr double reduced_mass = 0.02;
constexpr double tangential_mass = reduced_mass / 3.5;

LinearPrediction contact_of(const char *predictor, double dt, const LinearLaw &of = law) {
  return {of, reduced_mass, tangential_mass, *find_predictor(predictor), dt};
}

NormalAction normal_action(const LinearPrediction &contact, double overlap, double closing_speed) {
  return predict_normal(contact.at(overlap, closing_speed), {{0.0, 0.0, 1.0}, overlap, closing_speed, {}, 0.0, 0.0});
}

/// The force of an oscillator in the state a predictor gives for t + dt, and the sum of the moduli of
/// its terms: whatever the order of the operations, they round by no more than some u of that.
struct Prediction {
  double force;
  double terms;

  double tolerance() const { return 10.0 * unit_roundoff * terms; }
};

Prediction end_force(const Predictor &predictor, const Oscillator &o, double dt, const OscillatorState &s) {
  const Propagator map = predictor.propagator(o, dt);
  const OscillatorState end = map(s);
  const double d = std::fabs(s.displacement);
  const double u = std::fabs(s.rate);
  return {o.stiffness * end.displacement + o.damping * end.rate,
          o.stiffness *
                  (std::fabs(map.displacement_from_displacement) * d + std::fabs(map.displacement_from_rate) * u) +
              o.damping * (std::fabs(map.rate_from_displacement) * d + std::fabs(map.rate_from_rate) * u)};
}

Prediction normal_end(const char *predictor, double dt, double overlap, double closing, const LinearLaw &of = law) {
  return end_force(*find_predictor(predictor), {of.normal_stiffness, of.normal_damping, reduced_mass}, dt,
                   {overlap, closing});
}

TEST(ContactTime, OfEquation17) {
  EXPECT_DOUBLE_EQ(contact_time(4.0, 1.0), pi / 2.0);
  EXPECT_DOUBLE_EQ(contact_time(2.3e6, 2.0 * 2.3e6), pi * std::sqrt(2.0));
}

TEST(PredictNormal, PushesButNeverPulls) { // (2)
  const LinearPrediction contact = contact_of("exact", 1e-6);
  EXPECT_DOUBLE_EQ(normal_action(contact, 1e-4, 0.05).force, 2.0e4 * 1e-4 + 6.0 * 0.05);
  EXPECT_EQ(normal_action(contact, 1e-4, -1.0).force, 0.0); // 2 N of spring, -6 N of dashpot
}

TEST(PredictNormal, IsTheForceOfThePredictedState) { // (35)
  for (const Predictor &p : predictors) {
    const double dt = 3e-4;
    const NormalAction action = normal_action(contact_of(p.name, dt), 1e-3, 0.2);
    const Prediction end = normal_end(p.name, dt, 1e-3, 0.2);
    ASSERT_GT(end.force, 0.0);
    EXPECT_DOUBLE_EQ(action.force, 2.0e4 * 1e-3 + 6.0 * 0.2);
    EXPECT_NEAR(action.predicted, end.force, end.tolerance());
    EXPECT_EQ(action.separation_time, dt);
    EXPECT_DOUBLE_EQ(action.mean(), 0.5 * (action.force + action.predicted)); // (20)
  }
}

TEST(PredictNormal, ClampsAndTimesTheSeparation) { // (36), (39)
  const double dt = 1e-3;
  const double overlap = 2e-4;
  const double closing = -0.3; // separating: spring 4 N, dashpot -1.8 N
  const Prediction end = normal_end("exact", dt, overlap, closing);
  ASSERT_LT(end.force, -end.tolerance());
  const NormalAction action = normal_action(contact_of("exact", dt), overlap, closing);
  EXPECT_DOUBLE_EQ(action.force, 2.0e4 * overlap + 6.0 * closing);
  EXPECT_EQ(action.predicted, 0.0);
  const double expected = dt * action.force / (action.force - end.force);
  EXPECT_NEAR(action.separation_time, expected, expected * 2.0 * end.tolerance() / -end.force);
  EXPECT_GT(action.separation_time, 0.0);
  EXPECT_LT(action.separation_time, dt);
}

TEST(PredictNormal, ContactThatAlreadyPullsHasEnded) {
  const NormalAction action = normal_action(contact_of("exact", 1e-4), 1e-5, -1.0);
  ASSERT_LT(normal_end("exact", 1e-4, 1e-5, -1.0).force, 0.0);
  EXPECT_EQ(action.force, 0.0);
  EXPECT_EQ(action.predicted, 0.0);
  EXPECT_EQ(action.separation_time, 0.0);
}

/// Eq. 39 is where the straight line between the two forces crosses zero, so it tends to the true end
/// of the contact as the step does: undamped, f = k d, separation at d = 0.
/// With tension it ends where the bodies have parted.
TEST(PredictNormal, PullsWithTensionUntilTheBodiesPart) {
  const double dt = 1e-4;
  LinearLaw pulling = law;
  pulling.least_force = with_tension;
  for (const Predictor &p : predictors) {
    const LinearPrediction contact = contact_of(p.name, dt, pulling);
    for (const double speed :
         {0.3, -0.5, -2.0}) { // at t it pushes, then it pulls all the time, or until the bodies part
      const NormalAction normal = normal_action(contact, 1e-4, speed);
      EXPECT_EQ(normal.force, law.normal_force(1e-4, speed)) << p.name;
      const Prediction end = normal_end(p.name, dt, 1e-4, speed);
      EXPECT_NEAR(normal.predicted, speed > -1.0 ? end.force : 0.0, end.tolerance()) << p.name << " " << speed;
    }
    EXPECT_LT(normal_end(p.name, dt, 1e-4, -0.5).force, 0.0);
  }
}

TEST(PredictNormal, SeparationTimeConverges) {
  LinearLaw undamped = law;
  undamped.normal_damping = 0.0;
  for (const double dt : {1e-4, 1e-5, 1e-6}) {
    const double speed = 0.5;
    const double end = 0.4 * dt;
    const double omega = std::sqrt(law.normal_stiffness / reduced_mass);
    const double overlap = speed / omega * std::sin(omega * end); // of the half sine that ends at 0.4 dt
    const NormalAction action =
        normal_action(contact_of("exact", dt, undamped), overlap, -speed * std::cos(omega * end));
    // chord of a sine through its zero: relative error of order (omega dt)^2
    EXPECT_NEAR(action.separation_time, end, dt * std::pow(omega * dt, 2.0));
  }
}

/// |f* - f| <= dt max|df/dt|, and df/dt = k u - (h/m)(k d + h u) changes by O(dt) over the step: twice
/// its first value bounds it once (omega dt) and (h/m) dt are small; here (h/m) dt <= 0.03.
TEST(PredictNormal, PredictionTendsToTheForceNow) {
  const double d = 1e-3;
  const double u = 0.1;
  const double slope = law.normal_stiffness * u -
                       law.normal_damping / reduced_mass * (law.normal_stiffness * d + law.normal_damping * u);
  for (const Predictor &p : predictors)
    for (const double dt : {1e-4, 1e-6, 1e-8}) {
      const NormalAction action = normal_action(contact_of(p.name, dt), d, u);
      EXPECT_LE(std::fabs(action.predicted - action.force), 2.0 * dt * std::fabs(slope) + 1e-15 * action.force)
          << p.name << ' ' << dt;
      EXPECT_NE(action.predicted, action.force) << p.name; // it is a prediction, not a copy
    }
}

/// Below Coulomb's limit the prediction is the stick flow: each component an oscillator of mass mt.
TEST(PredictTangential, FollowsTheStickFlow) {
  const double dt = 2e-4;
  const Vec3 spring{1e-5, -3e-5, 2e-5};
  const Vec3 slip{0.02, 0.01, -0.04};
  const double plenty = 1e9;
  for (const Predictor &p : predictors) {
    const TangentialAction action = predict_tangential<Friction::limited_together>(contact_of(p.name, dt).at(0.0, 0.0),
                                                                                   spring, slip, plenty, plenty);
    const auto expect = [&](double force, double predicted, double x, double w) {
      const Prediction start{-(law.tangential_stiffness * x + law.tangential_damping * w),
                             law.tangential_stiffness * std::fabs(x) + law.tangential_damping * std::fabs(w)};
      const Prediction end =
          end_force(p, {law.tangential_stiffness, law.tangential_damping, tangential_mass}, dt, {x, w});
      EXPECT_NEAR(force, start.force, start.tolerance()) << p.name;  // (6)
      EXPECT_NEAR(predicted, -end.force, end.tolerance()) << p.name; // (37)
    };
    expect(action.force.x, action.predicted.x, spring.x, slip.x);
    expect(action.force.y, action.predicted.y, spring.y, slip.y);
    expect(action.force.z, action.predicted.z, spring.z, slip.z);
    EXPECT_DOUBLE_EQ(action.mean().z, 0.5 * (action.force.z + action.predicted.z)); // (20)
  }
}

/// a and b point the same way: |a x b| is rounding of |a||b|.
void expect_parallel(const Vec3 &a, const Vec3 &b) {
  EXPECT_LE(norm(cross(a, b)), 8.0 * unit_roundoff * norm(a) * norm(b));
  EXPECT_GT(dot(a, b), 0.0);
}

TEST(PredictTangential, CoulombActsAtBothTimesAndKeepsTheDirection) { // (10), (40)
  const double dt = 2e-4;
  const PredictedLaw contact = contact_of("exact", dt).at(0.0, 0.0);
  const Vec3 spring{1e-4, -3e-4, 2e-4};
  const Vec3 slip{0.2, 0.1, -0.4};
  const double now = 0.5;
  const double later = 0.2;
  const TangentialAction free = predict_tangential<Friction::limited_together>(contact, spring, slip, 1e9, 1e9);
  const TangentialAction action = predict_tangential<Friction::limited_together>(contact, spring, slip, now, later);
  // a length after three roundings of the scaling and three of norm()
  EXPECT_NEAR(norm(action.force), law.friction * now, 8.0 * unit_roundoff * law.friction * now);
  EXPECT_NEAR(norm(action.predicted), law.friction * later, 8.0 * unit_roundoff * law.friction * later);
  expect_parallel(action.force, free.force);
  expect_parallel(action.predicted, free.predicted);

  // each limit on its own
  const TangentialAction first = predict_tangential<Friction::limited_together>(contact, spring, slip, now, 1e9);
  EXPECT_TRUE(first.force == action.force && first.predicted == free.predicted);
  const TangentialAction second = predict_tangential<Friction::limited_together>(contact, spring, slip, 1e9, later);
  EXPECT_TRUE(second.force == free.force && second.predicted == action.predicted);
}

/// Where the limit holds the spring alone: the dashpot acts beside one that is below, and not beside one that is there.
TEST(PredictTangential, ALimitOfTheSpringTakesTheDashpotWithIt) {
  const double dt = 2e-4;
  const PredictedLaw contact = contact_of("exact", dt).at(0.0, 0.0);
  const auto predict = [&](const Vec3 &spring, const Vec3 &slip, double now, double later) {
    return predict_tangential<Friction::spring_and_dashpot>(contact, spring, slip, now, later);
  };
  const Vec3 spring{1e-4, -3e-4, 2e-4};
  const Vec3 slip{0.2, 0.1, -0.4};
  const TangentialAction free = predict_tangential<Friction::limited_together>(contact, spring, slip, 1e9, 1e9);
  const TangentialAction below = predict(spring, slip, 1e9, 1e9);
  EXPECT_TRUE(below.force == free.force && below.predicted == free.predicted);

  const Vec3 pull = -law.tangential_stiffness * spring;
  const double limit = norm(pull) / law.friction;
  EXPECT_TRUE(predict(spring, slip, limit, 1e9).force == pull); // slackened to it
  EXPECT_TRUE(predict(spring, slip, 1.01 * limit, 1e9).force == free.force);

  // at the end the limit of the spring of then counts, however strong the dashpot is
  const double later = 0.2;
  const TangentialAction slides = predict(spring, slip, 1e9, later);
  EXPECT_NEAR(norm(slides.predicted), law.friction * later, 8.0 * unit_roundoff * law.friction * later);
  const Vec3 end_pull = -contact.predicted_spring_stiffness * spring - contact.predicted_spring_damping * slip;
  expect_parallel(slides.predicted, end_pull);
  const double end_limit = norm(end_pull) / law.friction;
  EXPECT_TRUE(predict(spring, slip, 1e9, 1.01 * end_limit).predicted == free.predicted);
  EXPECT_LT(norm(predict(spring, slip, 1e9, 0.99 * end_limit).predicted), norm(end_pull));
  EXPECT_EQ(predict({}, {}, 0.0, 0.0).mean(), Vec3{});
}

TEST(PredictTangential, VanishesWithTheClampedNormalForce) { // (36) with (40), read literally
  const LinearPrediction contact = contact_of("exact", 1e-3);
  const NormalAction normal = normal_action(contact, 2e-4, -0.3);
  ASSERT_EQ(normal.predicted, 0.0);
  const TangentialAction action = predict_tangential<Friction::limited_together>(
      contact.at(2e-4, -0.3), {1e-4, 0.0, 0.0}, {0.1, 0.2, 0.0}, normal.force, 0.0);
  EXPECT_TRUE(action.predicted == Vec3{});
  EXPECT_GT(norm(action.force), 0.0);
}

TEST(PredictTangential, WithoutSpringADashpotUnderCoulomb) {
  LinearLaw no_spring = law;
  no_spring.tangential_stiffness = 0.0;
  const double dt = 2e-4;
  const Vec3 slip{0.02, 0.0, 0.0};
  const TangentialAction action = predict_tangential<Friction::limited_together>(
      contact_of("exact", dt, no_spring).at(0.0, 0.0), {}, slip, 1e9, 1e9);
  EXPECT_DOUBLE_EQ(action.force.x, -law.tangential_damping * 0.02);
  // w(t) = w0 exp(-h t/mt): a handful of roundings
  EXPECT_NEAR(action.predicted.x,
              -law.tangential_damping * 0.02 * std::exp(-law.tangential_damping / tangential_mass * dt),
              20.0 * unit_roundoff * law.tangential_damping * 0.02);
}

/// Any law, mass, step and state: finite, no tension, Coulomb.
TEST(Property, NoNaNNoTensionAndCoulomb) {
  std::mt19937_64 random(20050101);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const auto decades = [&](double a, double b) { return std::pow(10.0, uniform(a, b)); };
  int clamped = 0;
  int sliding = 0;
  for (int n = 0; n < 100000; ++n) {
    const LinearLaw any{decades(0, 9), random() % 4 == 0 ? 0.0 : decades(-3, 6),
                        random() % 4 == 0 ? 0.0 : decades(0, 9), random() % 4 == 0 ? 0.0 : decades(-3, 6),
                        random() % 8 == 0 ? 0.0 : uniform(0.0, 2.0)};
    const double mass = decades(-9, 3);
    const Predictor &predictor = predictors[random() % predictors.size()];
    // up to three times the undamped contact time: beyond every limit but not beyond any deck
    const double dt = uniform(0.0, 3.0) * contact_time(any.normal_stiffness, mass);
    const LinearPrediction contact(any, mass, mass / 3.5, predictor, dt);
    const double overlap = decades(-9, -2);
    const double closing = uniform(-10.0, 10.0);
    const NormalAction normal = normal_action(contact, overlap, closing);
    ASSERT_TRUE(std::isfinite(normal.force) && std::isfinite(normal.predicted));
    ASSERT_GE(normal.force, 0.0);
    ASSERT_GE(normal.predicted, 0.0);
    ASSERT_GE(normal.separation_time, 0.0);
    ASSERT_LE(normal.separation_time, dt * (1.0 + 4.0 * unit_roundoff)); // product, difference, quotient
    const Prediction end =
        end_force(predictor, {any.normal_stiffness, any.normal_damping, mass}, dt, {overlap, closing});
    const bool ends = end.force < -end.tolerance();
    if (ends) {
      ASSERT_EQ(normal.predicted, 0.0);
    } else {
      ASSERT_NEAR(normal.predicted, std::fmax(0.0, end.force), end.tolerance());
    }
    if (end.force > end.tolerance()) {
      ASSERT_EQ(normal.separation_time, dt);
    }
    clamped += ends;

    const Vec3 spring{uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3), 0.0};
    const Vec3 slip{uniform(-5.0, 5.0), uniform(-5.0, 5.0), 0.0};
    const TangentialAction t = predict_tangential<Friction::limited_together>(contact.at(overlap, closing), spring,
                                                                              slip, normal.force, normal.predicted);
    ASSERT_TRUE(std::isfinite(norm(t.force)) && std::isfinite(norm(t.predicted)));
    const double slack = 1.0 + 8.0 * unit_roundoff; // roundings of the shortened length
    ASSERT_LE(norm(t.force), slack * any.friction * normal.force);
    ASSERT_LE(norm(t.predicted), slack * any.friction * normal.predicted);
    sliding += any.friction > 0.0 && norm(t.force) > 0.999 * any.friction * normal.force && normal.force > 0.0;
  }
  EXPECT_GT(clamped, 1000); // the samples reach the cases they are about
  EXPECT_GT(sliding, 1000);
}

} // namespace
} // namespace cfpm::testing
