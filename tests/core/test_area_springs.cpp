// SPDX-License-Identifier: GPL-2.0-or-later
// Springs in the tangent plane that follow the area of contact: what they keep, how a step is predicted, and how the
// spring that a host keeps follows from step to step.
#include "core/law/granular_law.h"
#include "core/method/forces/follow_area.h"
#include "core/method/forces/integrated_prediction.h"
#include "core/predict/rk2.h"
#include "core/predict/rk4.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cfpm::testing {
namespace {

using Spring = BasicAreaSpring<double>;
constexpr Spring of_length{0.0, 0.0};
constexpr Spring of_force{1.0, 0.0};
constexpr Spring of_length_rescaled{0.0, 1.0};
constexpr Spring of_force_rescaled{1.0, 1.0};
constexpr Spring all[] = {of_length, of_force, of_length_rescaled, of_force_rescaled};

TEST(AreaSpring, KeepsWhatItsModelSays) {
  EXPECT_EQ(of_length.kept(2.0, 3.0), 3.0);
  EXPECT_EQ(of_length.kept(2.0, 1.0), 1.0);
  EXPECT_EQ(of_force.kept(2.0, 3.0), 2.0);
  EXPECT_EQ(of_force.kept(2.0, 1.0), 2.0);
  EXPECT_EQ(of_length_rescaled.kept(2.0, 3.0), 3.0);
  EXPECT_EQ(of_length_rescaled.kept(2.0, 1.0), 0.5); // the length halved, at half of the stiffness
  EXPECT_EQ(of_force_rescaled.kept(2.0, 3.0), 2.0);
  EXPECT_EQ(of_force_rescaled.kept(2.0, 1.0), 1.0);
  for (const Spring &spring : all) {
    EXPECT_EQ(spring.stretch(2.0, 2.0), 1.0);
    EXPECT_EQ(spring.stretch(2.0, 0.0), 1.0);
    EXPECT_EQ(spring.stretch(0.0, 0.0), 1.0);
    EXPECT_EQ(spring.any_follows(), spring.keeps_force + spring.rescales > 0.0);
  }
}

GranularLaw law_with(const Spring &spring) {
  return {0.0, 2e6, 0.0, 0.0, 300.0, 0.0, 3e6, 0.4, 0.3, with_tension, spring};
}

constexpr double mass = 1e-3;
constexpr double slip_mass = 3e-4;

/// The tangential force after a time, by the equations of motion in so many parts.
double force_after(int parts, const Spring &spring, double time, double overlap, double closing_speed, double length,
                   double slip_speed) {
  const GranularLaw law = law_with(spring);
  const double dt = time / parts;
  double d = overlap;
  double u = closing_speed;
  double x = length;
  double s = slip_speed;
  double force = 0.0;
  for (int k = 0; k <= parts; ++k) {
    const LinearLaw now = law.at(d);
    force = now.tangential_stiffness * x + now.tangential_damping * s;
    const double before = std::sqrt(d);
    u -= dt / mass * now.normal_force(d, u);
    s -= dt / slip_mass * force;
    d += dt * u;
    x = spring.stretch(before, std::sqrt(d)) * x + dt * s;
  }
  return force;
}

/// Without the error of first order that this leaves.
double force_after(const Spring &spring, double time, double overlap, double closing_speed, double length,
                   double slip_speed) {
  const auto in_parts = [&](int n) { return force_after(n, spring, time, overlap, closing_speed, length, slip_speed); };
  return 2.0 * in_parts(20000) - in_parts(10000);
}

/// With the error of the third order in the time that the method leaves, or smaller: it falls to an eighth.
TEST(AreaSpring, IsPredictedToSecondOrder) {
  for (const Spring &spring : all)
    for (const double closing_speed : {0.3, -0.2}) {
      double before = 0.0;
      for (const double time : {1e-5, 5e-6}) {
        const IntegratedPrediction<GranularLaw> prediction(law_with(spring), mass, slip_mass, time);
        const PredictedLaw end = prediction.at<RungeKutta4>(1e-4, closing_speed);
        const double found = end.predicted_tangential_stiffness * 2e-6 + end.predicted_tangential_damping * 0.1;
        const double error = std::fabs(found - force_after(spring, time, 1e-4, closing_speed, 2e-6, 0.1));
        if (before > 0.0) {
          EXPECT_LT(error, before / 7.0) << spring.keeps_force << spring.rescales << ' ' << closing_speed;
        }
        before = error;
      }
      EXPECT_LT(before, 1e-3 * 3e6 * 1e-2 * 2e-6);
    }
}

TEST(AreaSpring, IsStretchedBetweenSteps) {
  for (const Spring &spring : all) {
    double values[WiderHistory::size] = {1e-6, -2e-6, 3e-6, 0.5, 0.1, 0.2, 0.3, -1e-2}; // as listed the other way round
    const StoredSpring stored{values, 1e-5, true};
    follow_area(law_with(spring), 2.5e-5, stored);
    const double expected = spring.any_follows() ? spring.stretch(1e-2, 5e-3) : 1.0;
    EXPECT_DOUBLE_EQ(values[0], expected * 1e-6);
    EXPECT_DOUBLE_EQ(values[2], expected * 3e-6);
    EXPECT_EQ(values[3], 0.5);
    EXPECT_EQ(values[WiderHistory::area], spring.any_follows() ? 5e-3 : -1e-2);
  }
}

} // namespace
} // namespace cfpm::testing
