// SPDX-License-Identifier: GPL-2.0-or-later
// Results do not depend on the units of a deck. With units that differ by powers of two (of 16 for the
// length, whose fourth root is taken) every operation scales without rounding, so the results agree to
// the last bit.
#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/hertz_mindlin_law.h"
#include "core/method/forces/integrated_prediction.h"
#include "core/method/forces/linear_prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cfpm::testing {
namespace {

struct Units {
  double length, mass, time;

  double speed() const { return length / time; }
  double force() const { return mass * length / (time * time); }
};

/// A contact in SI units; stiffness and damping are those of an overlap of 1 m.
struct Contact {
  LinearLaw law;
  double mass, dt, overlap, closing_speed;
  Vec3 spring, slip_velocity;
};

/// length_power: of the length in the denominator of the stiffness, and of the damping.
Contact in(const Units &u, const Contact &c, double stiffness_power, double damping_power) {
  const double k = u.mass / (u.time * u.time) / std::pow(u.length, stiffness_power);
  const double h = u.mass / u.time / std::pow(u.length, damping_power);
  return {{k * c.law.normal_stiffness, h * c.law.normal_damping, k * c.law.tangential_stiffness,
           h * c.law.tangential_damping, c.law.friction, c.law.least_force},
          u.mass * c.mass,
          u.time * c.dt,
          u.length * c.overlap,
          u.speed() * c.closing_speed,
          u.length * c.spring,
          u.speed() * c.slip_velocity};
}

struct Result {
  double normal;
  double separation_time;
  Vec3 friction;
  Vec3 stored;
};

Result result_of(const PredictedLaw &step, const Contact &c) {
  const Vec3 n{0.0, 0.0, 1.0};
  const NormalAction normal = predict_normal(step, {n, c.overlap, c.closing_speed, c.slip_velocity, 0.0, 0.0});
  MidStepSpring spring(c.spring, c.dt);
  const double presses = std::fabs(normal.force);
  const Vec3 now = spring.advance(step.law, c.slip_velocity, n, step.law.friction * presses);
  const TangentialAction tangential = predict_tangential<Friction::spring_and_dashpot>(
      step, now, c.slip_velocity, presses, std::fabs(normal.predicted));
  return {normal.mean(), normal.separation_time, tangential.mean(), spring.stored()};
}

void expect_scaled(const Result &scaled, const Result &si, const Units &u) {
  EXPECT_EQ(scaled.normal, u.force() * si.normal);
  EXPECT_EQ(scaled.separation_time, u.time * si.separation_time);
  EXPECT_TRUE(scaled.friction == u.force() * si.friction);
  EXPECT_TRUE(scaled.stored == u.length * si.stored);
}

class UnitScaling : public ::testing::Test {
protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }

  Contact contact() {
    const double k = uniform(0.5, 2.0) * 1e5;
    const double least_force = random_() % 2 == 0 ? without_tension : with_tension;
    return {{k, uniform(0.0, 30.0), uniform(0.0, 1.0) * k, uniform(0.0, 30.0), uniform(0.0, 1.0), least_force},
            uniform(0.01, 0.03),
            uniform(0.0, 1e-3),
            uniform(1e-6, 1e-3),
            uniform(-1.0, 1.0),
            {uniform(-1e-4, 1e-4), uniform(-1e-4, 1e-4), 0.0},
            {uniform(-1.0, 1.0), uniform(-1.0, 1.0), 0.0}};
  }

  std::mt19937_64 random_{20050101};
  const Units units_[3]{{256.0, 1.0 / 1024.0, 1.0}, {1.0 / 65536.0, 8.0, 512.0}, {16.0, 4.0, 1.0 / 32.0}};
};

TEST_F(UnitScaling, LeavesLinearContactsUnchanged) {
  for (int n = 0; n < 2000; ++n) {
    const Contact si = contact();
    for (const Units &u : units_)
      for (const Predictor &predictor : predictors) {
        const auto result = [&](const Contact &c) {
          const LinearPrediction kind(c.law, c.mass, c.mass / 3.5, predictor, c.dt);
          return result_of(kind.at(c.overlap, c.closing_speed), c);
        };
        expect_scaled(result(in(u, si, 0.0, 0.0)), result(si), u);
      }
  }
}

TEST_F(UnitScaling, LeavesHertzContactsUnchanged) {
  const auto expect = [&](auto law_type, auto predictor, double damping_power) {
    using Law = decltype(law_type);
    const Contact si = contact();
    const auto result = [](const Contact &c) {
      const auto &[kn, hn, ks, hs, mu, least] = c.law;
      const IntegratedPrediction<Law> kind({kn, hn, ks, hs, mu, least}, c.mass, c.mass / 3.5, c.dt);
      return result_of(kind.template at<decltype(predictor)>(c.overlap, c.closing_speed), c);
    };
    for (const Units &u : units_) expect_scaled(result(in(u, si, 0.5, damping_power)), result(si), u);
  };
  for (int n = 0; n < 2000; ++n) {
    expect(HertzMindlinLaw<DampingExponent::quarter>{}, RungeKutta2{}, 0.25);
    expect(HertzMindlinLaw<DampingExponent::quarter>{}, RungeKutta4{}, 0.25);
    expect(HertzMindlinLaw<DampingExponent::half>{}, RungeKutta2{}, 0.5);
    expect(HertzMindlinLaw<DampingExponent::half>{}, RungeKutta4{}, 0.5);
  }
}

} // namespace
} // namespace cfpm::testing
