// SPDX-License-Identifier: GPL-2.0-or-later
// The whole step (Eqs. 20, 27) of an undamped contact with each prediction. The contact is two-sided
// and not clamped, so the step is linear: with theta = omega dt, f/m = omega^2 d and a prediction
// d* = A d + B u,
//   u' = u - (dt/2)(omega^2 d + omega^2 d*),  d' = d + (dt/2)(u + u').
// In scaled coordinates (omega d, u) its matrix has
//   trace = 2 - (theta^2/4)(1 + A) - (theta/2)(omega B) and det = 1 - (theta/2)(omega B) + (theta^2/4)(1 + A).
//   exact      A = cos, omega B = sin:  det = 1 - theta^4/24 + theta^6/160 - ..., = 1 at theta = pi, then > 1
//   rk4        A = 1 - theta^2/2 + theta^4/24, omega B = theta - theta^3/6: det = 1 - theta^4/24 + theta^6/96,
//              = 1 at theta = 2
//   rk2        A = 1 - theta^2/2, omega B = theta - theta^3/4: det = 1, trace = 2 - theta^2 + theta^4/4, = 2 at
//              theta = 2
//   trapezoid  the step repeats the prediction: a rotation at any theta.
#include "core/law/linear_law.h"
#include "core/predict/predictor.h"
#include "matrix2.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cfpm::testing {
namespace {

constexpr double omega = 5.0; // not 1, so that a wrong power of it shows

/// The matrix of the step, built by stepping the two unit states through Eqs. 20 and 27.
Matrix2 whole_step(const Predictor &predictor, double theta) {
  const double dt = theta / omega;
  const Oscillator o{0.7 * omega * omega, 0.0, 0.7};
  const Propagator predict = predictor.propagator(o, dt);
  const auto step = [&](OscillatorState s) {
    const OscillatorState end = predict(s);
    const double force = o.force(s.displacement, s.rate);
    const double predicted = o.force(end.displacement, end.rate);
    const double u = s.rate - dt / (2.0 * o.mass) * (force + predicted);
    return OscillatorState{s.displacement + dt / 2.0 * (s.rate + u), u};
  };
  const OscillatorState from_d = step({1.0, 0.0});
  const OscillatorState from_u = step({0.0, 1.0});
  return scaled({from_d.displacement, from_u.displacement, from_d.rate, from_u.rate}, omega);
}

double radius(const Predictor &p, double t_star) { return whole_step(p, pi * t_star).spectral_radius(); }

/// Where the limit is a double root of the characteristic polynomial, rounding of its coefficients,
/// about 10 u (1 + theta^4), shows as its square root in the radius: 1e-7 covers theta <= pi.
constexpr double rounding = 1e-7;

TEST(WholeStep, LimitsAreThoseOfThePaperReadAgain) {
  EXPECT_DOUBLE_EQ(Exact::stable_below, 1.0);
  EXPECT_DOUBLE_EQ(RungeKutta2::stable_below, 2.0 / pi);
  EXPECT_DOUBLE_EQ(RungeKutta4::stable_below, 2.0 / pi);
  EXPECT_TRUE(std::isinf(Trapezoid::stable_below));
}

TEST(WholeStep, StableBelowItsLimit) {
  for (const Predictor &p : predictors) {
    const double limit = std::fmin(p.stable_below, 1000.0);
    for (int n = 1; n < 1000; ++n) {
      const double t_star = n / 1000.0 * limit;
      // the trapezoid's entries stay below 1, but the forces that cancel in them grow like theta^2
      const double cancellation = std::sqrt(1e-15 * (1.0 + std::pow(pi * t_star, 2.0)));
      ASSERT_LE(radius(p, t_star), 1.0 + std::fmax(rounding, cancellation)) << p.name << ' ' << t_star;
    }
  }
}

/// Just above, with eps = t*/limit - 1 small: sqrt(det) = 1 + pi^2 eps/4 for exact and 1 + 2 eps/3 for
/// rk4; for rk2 trace/2 = 1 + 4 eps, so the radius is 1 + 4 eps + sqrt(8 eps + 16 eps^2). All to first
/// order of the trace and determinant in eps, so within a few eps of themselves.
TEST(WholeStep, UnstableAboveItsLimit) {
  const double eps = 1e-3;
  const auto expect = [eps](const char *name, double growth) {
    const Predictor &p = *find_predictor(name);
    EXPECT_NEAR(radius(p, (1.0 + eps) * p.stable_below) - 1.0, growth, 0.01 * growth) << name;
    EXPECT_LE(radius(p, (1.0 - eps) * p.stable_below), 1.0 + rounding) << name;
  };
  expect("exact", pi * pi / 4.0 * eps);
  expect("rk4", 2.0 / 3.0 * eps);
  expect("rk2", 4.0 * eps + std::sqrt(8.0 * eps + 16.0 * eps * eps));
}

TEST(WholeStep, DeterminantIsTheEnergyChange) {
  for (const double theta : {0.02, 0.1, 0.3, 0.6}) {
    const double t4 = std::pow(theta, 4.0);
    const double t6 = t4 * theta * theta;
    const double u = 1e-15; // of a determinant of entries near 1
    const auto change = [&](const char *name) { return whole_step(*find_predictor(name), theta).determinant() - 1.0; };
    EXPECT_NEAR(change("exact"), -t4 / 24.0 + t6 / 160.0, t6 * theta * theta / 1000.0 + u) << theta;
    EXPECT_NEAR(change("rk4"), -t4 / 24.0 + t6 / 96.0, u) << theta;
    EXPECT_NEAR(change("rk2"), 0.0, u) << theta;
    EXPECT_NEAR(change("trapezoid"), 0.0, u) << theta;
  }
}

/// The same by running it: over N steps the energy falls by the factor det^N, apart from the ripple of
/// an orbit that is an ellipse rather than a circle, of relative size theta^2/2 at both ends.
TEST(WholeStep, EnergyOverManySteps) {
  const double theta = 0.3;
  constexpr int steps = 2000;
  const auto log_gain = [&](const char *name) {
    const Matrix2 m = whole_step(*find_predictor(name), theta);
    double d = 0.6;
    double u = 0.8;
    for (int n = 0; n < steps; ++n) {
      const double next = m.a * d + m.b * u;
      u = m.c * d + m.d * u;
      d = next;
    }
    return std::log(d * d + u * u);
  };
  const double ripple = theta * theta;
  const double t4 = std::pow(theta, 4.0);
  EXPECT_NEAR(log_gain("exact"), steps * std::log1p(-t4 / 24.0 + t4 * theta * theta / 160.0), ripple);
  EXPECT_NEAR(log_gain("rk4"), steps * std::log1p(-t4 / 24.0 + t4 * theta * theta / 96.0), ripple);
  EXPECT_NEAR(log_gain("rk2"), 0.0, ripple);
  EXPECT_NEAR(log_gain("trapezoid"), 0.0, 1e-12); // a rotation: 2000 roundings
}

/// "The whole step repeats the prediction" (predictors/trapezoid.h).
TEST(WholeStep, TrapezoidIsItsOwnPrediction) {
  for (const double theta : {0.1, 1.0, 10.0}) {
    const Predictor &p = *find_predictor("trapezoid");
    const Oscillator o{0.7 * omega * omega, 0.0, 0.7};
    const Matrix2 prediction = scaled(p.propagator(o, theta / omega), omega);
    EXPECT_LE(largest(whole_step(p, theta) - prediction), 1e-15 * (1.0 + theta * theta)) << theta;
  }
}

} // namespace
} // namespace cfpm::testing
