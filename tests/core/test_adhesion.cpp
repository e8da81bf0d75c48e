// SPDX-License-Identifier: GPL-2.0-or-later
// A pull between bodies that touch, beside a Hertz contact: forces, what presses, predicted and while it lasts.
#include "core/law/adhesion.h"
#include "core/law/granular_law.h"
#include "core/method/forces/integrated_prediction.h"
#include "core/method/forces/mean_friction.h"
#include "core/numbers/pack.h"
#include "core/predict/rk2.h"
#include "core/predict/rk4.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace cfpm::testing {
namespace {

constexpr double kn = 2e6, pull = 0.4, mass = 2e-3;

GranularLaw law_with(const BasicAdhesion<double> &adhesion, double damping_half = 0.0) {
  GranularLaw law{0.0, kn, 0.0, 0.0, damping_half, 1e4, 0.0, 0.4, 0.3, with_tension};
  law.adhesion = adhesion;
  return law;
}

/// The overlap at which spring and pull are equal [m].
const double at_rest = std::pow(pull / kn, 2.0 / 3.0);

/// A sum of two terms, each of some products: half of a last place of the larger for each.
double rounding(double hertz) { return 8 * 2.3e-16 * (hertz + pull); }

TEST(Adhesion, PullsAtAnyOverlapTheSame) {
  const GranularLaw law = law_with({pull, 1.0}, 30.0);
  for (const double d : {1e-12, 0.1 * at_rest, at_rest, 1e-3}) {
    const double hertz = kn * d * std::sqrt(d);
    EXPECT_NEAR(law.at(d).normal_force(d, 0.0), hertz - pull, rounding(hertz));
    EXPECT_NEAR(law.pressing_at(d), hertz + pull, rounding(hertz));
    EXPECT_EQ(law.at(d).normal_damping, law_with({}, 30.0).at(d).normal_damping);
  }
}

TEST(Adhesion, EndsWithTheContact) {
  const GranularLaw law = law_with({pull, 1.0});
  for (const double d : {0.0, -1e-9}) {
    EXPECT_EQ(law.at(d).normal_force(d, 1.0), 0.0);
    EXPECT_EQ(law.pressing_at(d), 0.0);
  }
}

TEST(Adhesion, OfMaterialsGoesWithTheReducedRadius) {
  const AdhesiveMaterial<double> material{5.0, 1.0};
  const BasicAdhesion<double> adhesion = material.of({0.004, 0.006, mass});
  EXPECT_NEAR(adhesion.pull, 5.0 * 0.0024, 1e-17);
  EXPECT_EQ(adhesion.presses, 1.0);
}

TEST(Adhesion, OfPacksIsThatOfEachLane) {
  using P = Pack<2>;
  BasicGranularLaw<P> packed{0.0, kn, 0.0, 0.0, 0.0, 1e4, 0.0, 0.4, 0.3, with_tension};
  packed.adhesion = {P(P::Values{pull, 0.0}), P(P::Values{1.0, 0.0})};
  const double overlaps[] = {2.0 * at_rest, 2.0 * at_rest};
  const BasicLinearLaw<P> law = packed.at(P::load(overlaps));
  const GranularLaw each[] = {law_with({pull, 1.0}), law_with({})};
  for (int lane = 0; lane < 2; ++lane) {
    EXPECT_EQ(law.normal_stiffness.values[lane], each[lane].at(overlaps[lane]).normal_stiffness);
    EXPECT_EQ(law.normal_damping.values[lane], each[lane].at(overlaps[lane]).normal_damping);
  }
}

IntegratedPrediction<GranularLaw> prediction_of(const GranularLaw &law, double dt) {
  return {law, mass, mass / 3.5, dt};
}

TEST(Adhesion, HoldsBodiesAtRest) {
  const auto prediction = prediction_of(law_with({pull, 1.0}), 1e-4);
  const double scale = rounding(pull);
  EXPECT_NEAR(prediction.at<RungeKutta4>(at_rest, 0.0).predicted_normal_force, 0.0, 10 * scale);
  EXPECT_NEAR(prediction.at<RungeKutta2>(at_rest, 0.0).predicted_normal_force, 0.0, 10 * scale);
}

/// Without a dashpot what bodies have when they part is what they had when they touched, and where they turn back the
/// spring holds that and what the pull has given.
TEST(Adhesion, KeepsEnergy) {
  const GranularLaw law = law_with({pull, 1.0});
  const auto step = prediction_of(law, 1e-7).step();
  const double speed = 0.5;
  RelativeState<BasicDirections<double>> s{{1e-9, 1.0, 0.0}, {speed, 0.0, 1.0}};
  const double given = 0.5 * mass * speed * speed + law.spring_energy(1e-9);
  double deepest = 0.0;
  while (s.displacement.normal > 1e-9 || s.rate.normal > 0.0) {
    s = RungeKutta4::advance(step, s, 1e-7);
    deepest = std::max(deepest, s.displacement.normal);
    if (s.displacement.normal <= 1e-8) break;
    EXPECT_NEAR(0.5 * mass * s.rate.normal * s.rate.normal + law.spring_energy(s.displacement.normal), given,
                1e-6 * given);
  }
  EXPECT_NEAR(0.4 * kn * std::pow(deepest, 2.5) - pull * deepest, given, 1e-6 * given);
}

/// Coulomb's limit counts what presses, now and at the end, whatever the dashpot does; without adhesion the force.
TEST(Adhesion, LimitsFrictionByWhatPresses) {
  const double d = 4.0 * at_rest, closing = 0.3;
  const ContactGeometry g{{0.0, 0.0, 1.0}, d, closing, {}, 0.01, 0.01};
  for (const double presses : {0.0, 1.0}) {
    const GranularLaw law = law_with({pull, presses}, 9e2);
    const auto predicted = prediction_of(law, 1e-6).at<RungeKutta4>(d, closing);
    const NormalAction normal = predict_normal(predicted, g);
    const BasicLimitForces<double> limit = limit_forces(predicted, normal, 0.0);
    const double end = d + closing * 1e-6; // to second order in a step in which nothing much changes
    EXPECT_NEAR(limit.now, presses != 0.0 ? law.pressing_at(d) : normal.force, 1e-15);
    EXPECT_NEAR(limit.predicted, presses != 0.0 ? law.pressing_at(end) : normal.predicted, 1e-4 * limit.now);
    EXPECT_GT(std::fabs(law.pressing_at(d) - normal.force), 0.1 * normal.force);
  }
}

TEST(Adhesion, PressesNothingWhereBodiesHaveParted) {
  const double d = 0.01 * at_rest;
  const auto predicted = prediction_of(law_with({pull, 1.0}), 1e-3).at<RungeKutta2>(d, -1.0);
  const ContactGeometry g{{0.0, 0.0, 1.0}, d, -1.0, {}, 0.01, 0.01};
  EXPECT_EQ(limit_forces(predicted, predict_normal(predicted, g), 0.0).predicted, 0.0);
  EXPECT_GT(limit_forces(predicted, predict_normal(predicted, g), 0.0).now, pull);
}

} // namespace
} // namespace cfpm::testing
