// SPDX-License-Identifier: GPL-2.0-or-later
// The Hertz-Mindlin law and its prediction: against closed forms and against an independent integrator.
#include "core/law/hertz_mindlin_law.h"
#include "core/method/forces/integrated_prediction.h"
#include "core/predict/predictor.h"

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace cfpm::testing {
namespace {

namespace odeint = boost::numeric::odeint;

using Tsuji = HertzMindlinLaw<DampingExponent::quarter>;
using PerArea = HertzMindlinLaw<DampingExponent::half>;

TEST(HertzMindlinLaw, GrowsWithTheOverlap) { // (2), (6): d^(1/2) = 1/4 and d^(1/4) = 1/2, exactly
  const LinearLaw tsuji = Tsuji{8.0, 3.0, 5.0, 2.0, 0.4}.at(1.0 / 16.0);
  EXPECT_EQ(tsuji.normal_force(1.0 / 16.0, 1.0), 8.0 / 64.0 + 3.0 / 2.0);
  EXPECT_EQ(tsuji.tangential_stiffness, 5.0 / 4.0);
  EXPECT_EQ(tsuji.tangential_damping, 2.0 / 2.0);
  EXPECT_EQ(tsuji.friction, 0.4);
  const LinearLaw per_area = PerArea{8.0, 3.0, 5.0, 2.0, 0.4}.at(1.0 / 16.0);
  EXPECT_EQ(per_area.normal_force(1.0 / 16.0, 1.0), 8.0 / 64.0 + 3.0 / 4.0);
  EXPECT_EQ(per_area.tangential_stiffness, 5.0 / 4.0);
  EXPECT_EQ(per_area.tangential_damping, 2.0 / 4.0);
}

TEST(HertzMindlinLaw, BodiesApartFeelNothing) {
  for (const double overlap : {0.0, -1e-300, -0.3}) {
    const LinearLaw law = Tsuji{8.0, 3.0, 5.0, 2.0, 0.4}.at(overlap);
    EXPECT_EQ(law.normal_force(overlap, -2.0), 0.0) << overlap;
    EXPECT_EQ(law.tangential_stiffness, 0.0) << overlap;
    EXPECT_EQ(law.tangential_damping, 0.0) << overlap;
  }
}

struct Collision {
  double duration;
  double restitution;
};

/// A collision of unit mass, stiffness and impact speed with the law's own force, up to where that
/// vanishes: fine steps of odeint, the last one cut by the secant. Its damping is alpha.
Collision collide(double alpha) {
  using State = std::array<double, 2>; // d, u
  const Tsuji law{1.0, alpha, 0.0, 0.0, 0.0};
  const auto force = [&](const State &s) { return law.at(s[0]).normal_force(s[0], s[1]); };
  const auto derivative = [&](const State &s, State &rate, double) { rate = {s[1], -force(s)}; };
  odeint::runge_kutta_fehlberg78<State> stepper;
  const double dt = 1e-4;
  State s{0.0, 1.0};
  double t = 0.0;
  State before = s;
  do {
    before = s;
    stepper.do_step(derivative, s, t, dt);
    t += dt;
  } while (force(s) > 0.0);
  const double rest = force(s) / (force(s) - force(before)); // of the last step, behind the release
  return {t - rest * dt, -(s[1] - rest * (s[1] - before[1]))};
}

/// Damping that grows as d^(1/4) makes collisions of all speeds alike; with s = u/d^(5/4) their
/// equation integrates to e = exp[-(alpha/W)(pi/2 - theta)], W = sqrt(5 - alpha^2),
/// theta = atan2(5 s + 2 alpha, 2 W) at the release s = -1/alpha.
double closed_restitution(double alpha) {
  const double w = std::sqrt(5.0 - alpha * alpha);
  const double release = std::atan((2.0 * alpha - 5.0 / alpha) / (2.0 * w));
  return std::exp(-alpha / w * (0.5 * pi - release));
}

/// The start is not smooth (d^(1/4)), so the first step of 1e-4 leaves an error of about alpha dt^(5/4)
/// = 1e-5 alpha of the impact speed; the secant, 1e-8.
TEST(Collision, RestitutionOfTheClosedForm) {
  for (const double alpha : {0.07, 0.3, 0.6, 1.0, 1.9})
    EXPECT_NEAR(collide(alpha).restitution, closed_restitution(alpha), 1e-5 * alpha) << alpha;
  const auto four_digits = 0.5e-4;
  EXPECT_NEAR(closed_restitution(0.07), 0.9081, four_digits);
  EXPECT_NEAR(closed_restitution(0.3), 0.6778, four_digits);
  EXPECT_NEAR(closed_restitution(1.0), 0.3305, four_digits);
}

TEST(Collision, Duration) {
  const double four_digits = 0.5e-3;
  EXPECT_NEAR(hertz_contact_time_unit(), 3.218, four_digits);
  EXPECT_NEAR(collide(0.0).duration, hertz_contact_time_unit(), 1e-4); // no secant at d = 0: known to a step
  EXPECT_NEAR(collide(0.6).duration, 2.809, four_digits);
  EXPECT_NEAR(collide(1.9).duration, 2.372, four_digits);
}

TEST(Collision, DurationScales) { // (m/k)^(2/5) u^(-1/5)
  EXPECT_DOUBLE_EQ(hertz_contact_time(1.0, 1.0, 1.0), hertz_contact_time_unit());
  EXPECT_DOUBLE_EQ(hertz_contact_time(2.0, 64.0, 1.0), 4.0 * hertz_contact_time_unit());
  EXPECT_DOUBLE_EQ(hertz_contact_time(1.0, 1.0, 32.0), 0.5 * hertz_contact_time_unit());
}

TEST(Collision, IsStiffestAtItsLargestOverlap) { // u^2/2 = (2/5) d^(5/2), stiffness (3/2) d^(1/2)
  const double overlap = std::pow(1.25, 0.4);
  EXPECT_NEAR(0.4 * std::pow(overlap, 2.5), 0.5, 1e-15);
  EXPECT_NEAR(stiffest_hertz_contact_time() * hertz_contact_time_unit(), contact_time(1.5 * std::sqrt(overlap), 1.0),
              1e-15);
}

/// One contact in plain variables for odeint: overlap, closing speed, two components of the spring and
/// of the slip velocity, written from Eqs. 2 and 6 once more.
using Coupled = std::array<double, 6>; // d, u, xi_x, xi_y, w_x, w_y

struct CoupledContact {
  double kn, hn, ks, hs, mass, tangential_mass, exponent;

  void operator()(const Coupled &s, Coupled &rate, double) const {
    const auto [fn, fx, fy] = forces(s);
    rate = {s[1], -fn / mass, s[4], s[5], fx / tangential_mass, fy / tangential_mass};
  }
  std::array<double, 3> forces(const Coupled &s) const {
    const double damping = std::pow(s[0], exponent);
    return {kn * std::pow(s[0], 1.5) + hn * damping * s[1], -ks * std::pow(s[0], 0.5) * s[2] - hs * damping * s[4],
            -ks * std::pow(s[0], 0.5) * s[3] - hs * damping * s[5]};
  }
};

/// Predicts as the plugin does and returns the state and the forces that follow from one step; repeated
/// with the predicted state, the prediction is an integrator whose order can be measured.
template <class Law, class Predictor>
Coupled integrate(const CoupledContact &c, const Coupled &start, double t, int n) {
  using Contact = IntegratedPrediction<Law>;
  using Directions = typename Contact::Directions;
  const Contact contact({c.kn, c.hn, c.ks, c.hs, 0.0}, c.mass, c.tangential_mass, t / n);
  Coupled s = start;
  for (int k = 0; k < n; ++k) {
    const auto [d, u] =
        Predictor::advance(contact, RelativeState<Directions>{{s[0], 1.0, 0.0}, {s[1], 0.0, 1.0}}, t / n);
    s = {d.normal,
         u.normal,
         d.from_spring * s[2] + d.from_slip * s[4],
         d.from_spring * s[3] + d.from_slip * s[5],
         u.from_spring * s[2] + u.from_slip * s[4],
         u.from_spring * s[3] + u.from_slip * s[5]};
  }
  return s;
}

Coupled odeint_solution(const CoupledContact &c, const Coupled &start, double t) {
  odeint::runge_kutta_fehlberg78<Coupled> stepper;
  Coupled s = start;
  const int n = 2000; // of order 8: exact to rounding
  for (int k = 0; k < n; ++k) stepper.do_step(c, s, k * (t / n), t / n);
  return s;
}

double distance(const Coupled &a, const Coupled &b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

/// All of order 1; about a third of a collision, from an overlap above zero, where the law is smooth.
constexpr CoupledContact smooth_contact(double exponent) { return {1.3, 0.4, 1.1, 0.3, 0.9, 0.9 / 3.5, exponent}; }
constexpr Coupled inside{0.3, 0.8, 0.05, -0.02, 0.3, 0.4};

/// Halving the step divides the error by 2^p (1 + O(h)); h = 1/64 of the interval, frequencies about 2,
/// so the observed order is within some h of p, and the errors, 1e-9 for rk4, are above rounding.
template <class Law, class Predictor> double observed_order(double exponent) {
  const CoupledContact c = smooth_contact(exponent);
  const Coupled exact = odeint_solution(c, inside, 1.0);
  const double coarse = distance(integrate<Law, Predictor>(c, inside, 1.0, 64), exact);
  const double fine = distance(integrate<Law, Predictor>(c, inside, 1.0, 128), exact);
  return std::log2(coarse / fine);
}

TEST(IntegratedPrediction, ConvergesToTheSolutionAtTheOrderOfThePredictor) {
  const double tolerance = 4.0 / 64.0;
  EXPECT_NEAR((observed_order<Tsuji, RungeKutta2>(0.25)), 2.0, tolerance);
  EXPECT_NEAR((observed_order<Tsuji, RungeKutta4>(0.25)), 4.0, tolerance);
  EXPECT_NEAR((observed_order<PerArea, RungeKutta2>(0.5)), 2.0, tolerance);
  EXPECT_NEAR((observed_order<PerArea, RungeKutta4>(0.5)), 4.0, tolerance);
}

/// The step itself: forces at t, and those predicted, against odeint's state a step later. An error of
/// dt^3 for rk2 and dt^5 for rk4 times derivatives of order 10 at frequencies of about 2.
template <class Law, class Predictor> void expect_predicted_forces(double exponent, double tolerance, double dt) {
  const CoupledContact c = smooth_contact(exponent);
  const IntegratedPrediction<Law> contact({c.kn, c.hn, c.ks, c.hs, 0.7}, c.mass, c.tangential_mass, dt);
  const PredictedLaw step = contact.template at<Predictor>(inside[0], inside[1]);
  EXPECT_EQ(step.dt, dt);
  EXPECT_EQ(step.law.friction, 0.7);
  const auto [fn, fx, fy] = c.forces(inside);
  EXPECT_NEAR(step.law.normal_force(inside[0], inside[1]), fn, 1e-15);
  EXPECT_NEAR(-step.law.tangential_stiffness * inside[3] - step.law.tangential_damping * inside[5], fy, 1e-15);
  const auto [gn, gx, gy] = c.forces(odeint_solution(c, inside, dt));
  EXPECT_NEAR(step.predicted_normal_force, gn, tolerance);
  const auto predicted = [&](double spring, double slip) {
    return -step.predicted_tangential_stiffness * spring - step.predicted_tangential_damping * slip;
  };
  EXPECT_NEAR(predicted(inside[2], inside[4]), gx, tolerance);
  EXPECT_NEAR(predicted(inside[3], inside[5]), gy, tolerance);
  EXPECT_GT(std::fabs(gn - fn), 10.0 * tolerance); // it is a prediction, not a copy
}

TEST(IntegratedPrediction, PredictsTheForces) {
  const double dt = 0.01;
  expect_predicted_forces<Tsuji, RungeKutta2>(0.25, 10.0 * std::pow(dt, 3.0), dt);
  expect_predicted_forces<Tsuji, RungeKutta4>(0.25, 10.0 * std::pow(dt, 5.0), dt);
  expect_predicted_forces<PerArea, RungeKutta2>(0.5, 10.0 * std::pow(dt, 3.0), dt);
  expect_predicted_forces<PerArea, RungeKutta4>(0.5, 10.0 * std::pow(dt, 5.0), dt);
}

/// Calls f(contact, step_of) for both laws with both predictors, of random materials and steps up to three
/// contact times: beyond every limit, but not beyond any deck.
class RandomHertz : public ::testing::Test {
protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double decades(double a, double b) { return std::pow(10.0, uniform(a, b)); }

  struct Sample {
    double overlap, closing_speed, friction;
    std::function<PredictedLaw(double dt)> step; ///< at this overlap and speed
    double mass, contact_time;
  };

  template <class Law, class Predictor> Sample sample_of() {
    const double mass = decades(-9, 3);
    const double kn = decades(3, 12);
    const double speed = uniform(-10.0, 10.0);
    const double tc = hertz_contact_time(kn, mass, 10.0);
    const double overlap = decades(-6, 0) * tc * 10.0;
    // from none to overdamped, and a tangential spring from none to as stiff as the normal one
    const double unit = std::sqrt(mass * kn);
    const Law law{kn, random_() % 4 == 0 ? 0.0 : unit * uniform(0.0, 4.0),
                  random_() % 4 == 0 ? 0.0 : kn * uniform(0, 1), random_() % 4 == 0 ? 0.0 : unit * uniform(0.0, 4.0),
                  random_() % 8 == 0 ? 0.0 : uniform(0.0, 2.0)};
    const auto step = [=](double dt) {
      return IntegratedPrediction<Law>(law, mass, mass / 3.5, dt).template at<Predictor>(overlap, speed);
    };
    return {overlap, speed, law.friction, step, mass, tc};
  }

  Sample sample() {
    switch (random_() % 4) {
    case 0:
      return sample_of<Tsuji, RungeKutta2>();
    case 1:
      return sample_of<Tsuji, RungeKutta4>();
    case 2:
      return sample_of<PerArea, RungeKutta2>();
    default:
      return sample_of<PerArea, RungeKutta4>();
    }
  }

  std::mt19937_64 random_{20050101};
};

TEST_F(RandomHertz, NoNaNNoTensionAndCoulomb) {
  int clamped = 0;
  int sliding = 0;
  for (int n = 0; n < 100000; ++n) {
    const Sample s = sample();
    const PredictedLaw step = s.step(uniform(0.0, 3.0) * s.contact_time);
    const NormalAction normal = predict_normal(step, {{0.0, 0.0, 1.0}, s.overlap, s.closing_speed, {}, 0.0, 0.0});
    ASSERT_TRUE(std::isfinite(normal.force) && std::isfinite(normal.predicted));
    ASSERT_GE(normal.force, 0.0);
    ASSERT_GE(normal.predicted, 0.0);
    ASSERT_GE(normal.separation_time, 0.0);
    clamped += step.predicted_normal_force < 0.0;
    const Vec3 spring{uniform(-1.0, 1.0) * s.overlap, uniform(-1.0, 1.0) * s.overlap, 0.0};
    const Vec3 slip{uniform(-5.0, 5.0), uniform(-5.0, 5.0), 0.0};
    const TangentialAction t =
        predict_tangential<Friction::limited_together>(step, spring, slip, normal.force, normal.predicted);
    ASSERT_TRUE(std::isfinite(norm(t.force)) && std::isfinite(norm(t.predicted)));
    const Vec3 with_unlimited_dashpot =
        predict_tangential<Friction::spring_and_dashpot>(step, spring, slip, normal.force, normal.predicted).mean();
    ASSERT_TRUE(std::isfinite(norm(with_unlimited_dashpot)));
    const double slack = 1.0 + 8.0 * std::numeric_limits<double>::epsilon(); // roundings of the shortened length
    ASSERT_LE(norm(t.force), slack * s.friction * normal.force);
    ASSERT_LE(norm(t.predicted), slack * s.friction * normal.predicted);
    sliding += normal.force > 0.0 && norm(t.force) > 0.999 * s.friction * normal.force;
  }
  EXPECT_GT(clamped, 1000); // the samples reach the cases they are about
  EXPECT_GT(sliding, 1000);
}

/// f*(dt) - f(0) is proportional to dt to first order: a thousandth of the step brings a thousandth of the
/// change. With steps that are 1e-6 of the shortest time of the contact (of its overlap, its dashpot and its
/// spring), the second order is some 1e-12 of the forces and a rounding 1e-16.
TEST_F(RandomHertz, PredictionTendsToTheForceOfNow) {
  for (int n = 0; n < 10000; ++n) {
    const Sample s = sample();
    const LinearLaw law = s.step(0.0).law;
    const double rate =
        std::fabs(s.closing_speed) / s.overlap + law.normal_damping / s.mass + std::sqrt(law.normal_stiffness / s.mass);
    const double scale = law.normal_stiffness * s.overlap + law.normal_damping * std::fabs(s.closing_speed);
    const auto change = [&](double dt) {
      return s.step(dt).predicted_normal_force - law.normal_force(s.overlap, s.closing_speed);
    };
    const double large = change(1e-6 / rate);
    ASSERT_NEAR(change(1e-9 / rate), 1e-3 * large, (10.0 * 1e-3 * 1e-12 + 4e-15) * scale);
    ASSERT_LE(std::fabs(large), 10.0 * 1e-6 * scale);
    ASSERT_EQ(change(0.0), 0.0);
  }
}

} // namespace
} // namespace cfpm::testing
