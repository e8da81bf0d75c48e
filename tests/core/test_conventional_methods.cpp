// SPDX-License-Identifier: GPL-2.0-or-later
// The methods that the exhibits table2 and table3 run on one contact. Without damping the energy that a
// step adds has a closed form (the expressions of Table 2, with e of Eq. 19, twice the energy); steps with
// a dashpot are compared with the method's equations worked by hand.
#include "adams_bashforth.h"
#include "core/predict/predictor.h"
#include "explicit_euler.h"
#include "leapfrog.h"
#include "prediction_alone.h"
#include "predictor_corrector.h"
#include "whole_step.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cfpm::testing {
namespace {

using namespace cfpm::validation;

constexpr Oscillator undamped{3.0, 0.0, 0.5};
constexpr OscillatorState start{0.2, 1.5};
constexpr double h = 0.1;          // theta = h sqrt(k/m) = 0.24
constexpr double rounding = 1e-14; // of a few dozen operations on numbers near 1

double twice_energy(const OscillatorState &s) {
  return undamped.mass * s.rate * s.rate + undamped.stiffness * s.displacement * s.displacement;
}

/// gain(last, now, next) is the expression of Table 2 for the change from now to next. A contact begins
/// with last = now.
template <class Method, class Gain> void expect_energy_gain(Method method, const Gain &gain) {
  OscillatorState last = start;
  OscillatorState now = start;
  for (int n = 0; n < 5; ++n) {
    method.step();
    const OscillatorState next = method.state();
    EXPECT_NEAR(twice_energy(next) - twice_energy(now), gain(last, now, next), rounding) << "step " << n;
    last = now;
    now = next;
  }
}

constexpr double k = undamped.stiffness;
constexpr double m = undamped.mass;

OscillatorState extrapolated(const OscillatorState &last, const OscillatorState &now) { // (23)
  return {1.5 * now.displacement - 0.5 * last.displacement, 1.5 * now.rate - 0.5 * last.rate};
}

double area(const OscillatorState &last, const OscillatorState &now) {
  return now.rate * last.displacement - last.rate * now.displacement;
}

TEST(ConventionalMethods, EnergyGainOfExplicitEuler) {
  expect_energy_gain(ExplicitEuler(undamped, start, h),
                     [](const OscillatorState &, const OscillatorState &now, const OscillatorState &) {
                       return h * h * k / m * twice_energy(now); // (18)
                     });
}

TEST(ConventionalMethods, EnergyGainOfAdamsBashforth) {
  expect_energy_gain(AdamsBashforth2(undamped, start, h),
                     [](const OscillatorState &last, const OscillatorState &now, const OscillatorState &) {
                       return h * h * k / m * twice_energy(extrapolated(last, now)) + h * k * area(last, now);
                     });
}

TEST(ConventionalMethods, EnergyGainOfLeapfrog) {
  expect_energy_gain(Leapfrog(undamped, start, h), [](const OscillatorState &, const OscillatorState &now,
                                                      const OscillatorState &next) {
    return h * h * k * k / (4.0 * m) * (next.displacement * next.displacement - now.displacement * now.displacement);
  });
}

TEST(ConventionalMethods, EnergyGainOfPredictorCorrector) {
  expect_energy_gain(PredictorCorrector(undamped, start, h),
                     [](const OscillatorState &last, const OscillatorState &now, const OscillatorState &) {
                       const OscillatorState mid = extrapolated(last, now);
                       return h * h * k / m *
                              (twice_energy(now) - m * now.rate * mid.rate - k * now.displacement * mid.displacement +
                               0.5 * h * k * area(last, now) + h * h * k / (4.0 * m) * twice_energy(mid));
                     });
}

/// f = 2 d + u, m = 1/2, so u' = -4 d - 2 u; from d = 1, u = 0 with h = 1/4 every number is a binary fraction.
constexpr Oscillator by_hand{2.0, 1.0, 0.5};
constexpr OscillatorState stretched{1.0, 0.0};

template <class Method>
void expect_two_steps(Method method, const OscillatorState &first, const OscillatorState &second) {
  for (const OscillatorState &expected : {first, second}) {
    method.step();
    EXPECT_DOUBLE_EQ(method.state().displacement, expected.displacement);
    EXPECT_DOUBLE_EQ(method.state().rate, expected.rate);
  }
}

TEST(ConventionalMethods, ExplicitEulerByHand) {
  // u' = -4, then -4 + 2 = -2
  expect_two_steps(ExplicitEuler(by_hand, stretched, 0.25), {1.0, -1.0}, {0.75, -1.5});
}

TEST(ConventionalMethods, AdamsBashforthByHand) {
  // the first step is Euler's; then d += h (-3/2), u += h (3/2 (-2) - 1/2 (-4)) = -h
  expect_two_steps(AdamsBashforth2(by_hand, stretched, 0.25), {1.0, -1.0}, {0.625, -1.25});
}

TEST(ConventionalMethods, PredictorCorrectorByHand) {
  // predicted 1, -1 with slope -1, -2: d += h/2 (0 - 1), u += h/2 (-4 - 2);
  // from 7/8, -3/4 with slope -3/4, -2 predicted d = 7/8 + h (-9/8) = 19/32, u = -3/4 - h = -1 with slope -1, -3/8
  expect_two_steps(PredictorCorrector(by_hand, stretched, 0.25), {0.875, -0.75},
                   {0.875 - 0.125 * 1.75, -0.75 - 0.125 * 2.375});
}

TEST(ConventionalMethods, LeapfrogByHand) {
  // (21) u = -1/2 at h/2, d = 7/8; u' = -7/2 + 1 = -5/2, (22) u = -1/2 - 5/16;
  // u = -1/2 - 5/8 at 3h/2, d = 7/8 - 9/32 = 19/32; u' = -19/8 + 9/4 = -1/8, (22) u = -9/8 - 1/64
  expect_two_steps(Leapfrog(by_hand, stretched, 0.25), {0.875, -0.8125}, {0.59375, -1.140625});
}

/// A contact that is neither linear nor undamped, which the methods know by its acceleration alone.
struct Stiffening {
  double acceleration(double displacement, double rate) const {
    return -displacement * displacement * displacement - rate;
  }
};

/// Halving the step from theta = 1/50 divides the error by 2^order, up to a few hundredths of it.
template <class Start> double order(const Start &begin) {
  const auto end = [&](int steps) {
    auto method = begin(1.0 / steps);
    for (int n = 0; n < steps; ++n) method.step();
    return method.state();
  };
  const auto distance = [](const OscillatorState &p, const OscillatorState &q) {
    return std::hypot(p.displacement - q.displacement, p.rate - q.rate);
  };
  const OscillatorState coarse = end(50);
  const OscillatorState middle = end(100);
  return std::log2(distance(coarse, middle) / distance(middle, end(200)));
}

TEST(ConventionalMethods, OrdersForAnyContact) {
  constexpr Stiffening contact;
  EXPECT_NEAR(order([&](double dt) { return ExplicitEuler(contact, start, dt); }), 1.0, 0.1);
  EXPECT_NEAR(order([&](double dt) { return AdamsBashforth2(contact, start, dt); }), 2.0, 0.1);
  EXPECT_NEAR(order([&](double dt) { return PredictorCorrector(contact, start, dt); }), 2.0, 0.1);
  EXPECT_NEAR(order([&](double dt) { return Leapfrog(contact, start, dt); }), 1.0, 0.1); // second without dashpot
}

/// The trapezoid is implicit: its whole step with its own prediction is itself.
TEST(PredictedMethods, WholeStepAveragesTheForces) {
  const Propagator map = find_predictor("trapezoid")->propagator(by_hand, h);
  const auto predicted_force = [&](const OscillatorState &s) {
    const OscillatorState end = map(s);
    return by_hand.force(end.displacement, end.rate);
  };
  WholeStep whole(by_hand, predicted_force, start, h);
  PredictionAlone alone(map, start);
  for (int n = 0; n < 5; ++n) {
    whole.step();
    alone.step();
    EXPECT_NEAR(whole.state().displacement, alone.state().displacement, rounding) << n;
    EXPECT_NEAR(whole.state().rate, alone.state().rate, rounding) << n;
  }
}

} // namespace
} // namespace cfpm::testing
