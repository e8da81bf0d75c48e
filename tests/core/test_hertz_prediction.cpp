// SPDX-License-Identifier: GPL-2.0-or-later
// The exact prediction of Hertz contacts and what it reads it from: series and tables, of one number or of packs.
#include "core/method/forces/hertz_prediction.h"
#include "core/method/impulses/hertz_impulse.h"
#include "core/motion/exact_flow.h"
#include "core/motion/flow_by_series.h"
#include "core/numbers/hermite_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace cfpm::testing {
namespace {

constexpr double rounding = 2.2e-16;

/// Of the displacement over the start's, and of the rate over the largest that the start can give.
double distance(const Propagator &a, const Propagator &b, double rate) {
  return std::max({std::fabs(a.displacement_from_displacement - b.displacement_from_displacement),
                   std::fabs(a.displacement_from_rate - b.displacement_from_rate) * rate,
                   std::fabs(a.rate_from_displacement - b.rate_from_displacement) / rate,
                   std::fabs(a.rate_from_rate - b.rate_from_rate)});
}

/// A time that is halved n times has the error of each part 2^n times, and of its series some ten roundings.
TEST(FlowBySeries, IsTheExactFlow) {
  std::mt19937 random(7);
  const auto any_of = [&](double low, double high) {
    return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(random));
  };
  for (int k = 0; k < 20000; ++k) {
    const double rate = any_of(1e2, 1e6);
    const double zeta = k % 5 == 0 ? 0.0 : any_of(1e-3, 1e2);
    const double time = any_of(1e-4, 1e2) / rate;
    const Oscillator o{rate * rate, 2.0 * zeta * rate, 1.0};
    const double parts = std::max(1.0, 4.0 * rate * time * std::max(1.0, zeta));
    EXPECT_LT(distance(flow_by_series(rate * rate, zeta * rate, time), exact_flow(o, time), rate),
              10.0 * rounding * parts)
        << zeta << " " << rate * time;
  }
}

TEST(FlowBySeries, WithoutASpringOrAtCriticalDamping) {
  for (const double time : {0.0, 0.01, 0.3, 3.0}) {
    EXPECT_LT(distance(flow_by_series(0.0, 1.0, time), exact_flow({0.0, 2.0, 1.0}, time), 1.0), 1e-14);
    EXPECT_LT(distance(flow_by_series(1.0, 1.0, time), exact_flow({1.0, 2.0, 1.0}, time), 1.0), 1e-14);
    const Propagator at_rest = flow_by_series(0.0, 0.0, time);
    EXPECT_EQ(at_rest.displacement_from_displacement, 1.0);
    EXPECT_EQ(at_rest.displacement_from_rate, time);
    EXPECT_EQ(at_rest.rate_from_displacement, 0.0);
    EXPECT_EQ(at_rest.rate_from_rate, 1.0);
  }
}

constexpr double mass = 0.02;

HertzPrediction prediction(double alpha, double least_force, double step) {
  const double kn = 3e6;
  const HertzPrediction::Law law{kn, alpha * std::sqrt(kn * mass), 0.8 * kn, 900.0, 0.3, least_force};
  return {law, std::make_shared<HertzTrajectory>(alpha, law.tension()), mass, mass / 3.5, step};
}

/// With what the tangent plane has by exp, sin and cos.
TEST(HertzPrediction, SlipsAsTheExactFlowOfTheMeanOverlap) {
  for (const double step : {2e-5, 2e-4, 2e-3}) {
    const HertzPrediction kind = prediction(0.3, without_tension, step);
    const auto &law = kind.step().law;
    for (const double overlap : {1e-6, 1e-5, 1e-4})
      for (const double speed : {-1e-4, 0.0, 0.5}) {
        const PredictedLaw predicted = kind.at(overlap, speed);
        const BasicHertzFlight<double> flight = kind.step().motion.fly(overlap, fourth_root(overlap), speed, step);
        const LinearLaw end = law.at(flight.overlap);
        const Oscillator o = HertzImpulse::slip_at(law, mass / 3.5, flight.mean_overlap);
        const Propagator slip = exact_flow(o, step);
        const double kt = end.tangential_stiffness;
        const double ht = end.tangential_damping;
        const double rate = std::sqrt(o.stiffness / o.mass);
        const double error = 10.0 * rounding * std::max(1.0, 4.0 * rate * step); // see FlowBySeries
        EXPECT_NEAR(predicted.predicted_tangential_stiffness,
                    kt * slip.displacement_from_displacement + ht * slip.rate_from_displacement,
                    error * (kt + ht * rate));
        EXPECT_NEAR(predicted.predicted_tangential_damping, kt * slip.displacement_from_rate + ht * slip.rate_from_rate,
                    error * (kt / rate + ht));
      }
  }
}

TEST(HertzPrediction, OfBodiesThatPartIsNothing) {
  for (const double least_force : {without_tension, with_tension}) {
    const HertzPrediction kind = prediction(0.3, least_force, 1e-4);
    for (const double overlap : {-1e-5, 0.0}) {
      const PredictedLaw predicted = kind.at(overlap, -0.1);
      EXPECT_EQ(predicted.predicted_normal_force, 0.0);
      EXPECT_EQ(predicted.predicted_tangential_stiffness, 0.0);
      EXPECT_EQ(predicted.predicted_tangential_damping, 0.0);
      EXPECT_EQ(kind.while_touching(overlap, -0.1, 1e-4).contact_time, 0.0);
    }
    EXPECT_GT(kind.at(0.0, 0.1).predicted_normal_force, 0.0);
  }
}

/// Each lane in a table of its own, in a cell of its own.
TEST(HermiteCells, OfAPackAreThoseOfItsLanes) {
  const HermiteTable<1> sine(0.0, 3.0, 7, [](double x) { return HermiteTable<1>::Node{{std::sin(x)}, {std::cos(x)}}; });
  const HermiteTable<1> root(1.0, 2.0, 3, [](double x) {
    return HermiteTable<1>::Node{{std::sqrt(x)}, {0.5 / std::sqrt(x)}};
  });
  std::vector<double> numbers(12, -1.0); // of others
  const HermiteCells<double> first = sine.join(numbers);
  const HermiteCells<double> second = root.join(numbers);
  std::vector<double> elsewhere;
  const HermiteCells<double> third = root.join(elsewhere);
  using Four = Pack<4>;
  const HermiteCells<Four> all{
      Four::Values{first.first, second.first, third.first, first.first},
      Four::Values{first.per_spacing, second.per_spacing, third.per_spacing, first.per_spacing},
      Four::Values{first.count, second.count, third.count, first.count},
      Four::Values{first.behind, second.behind, third.behind, first.behind}};
  TableNumbers<Four> tables;
  for (const double **table : {&tables.first[0], &tables.first[1], &tables.first[3]}) *table = numbers.data();
  tables.first[2] = elsewhere.data();
  const Four found = all.interpolate<1>(tables, Four::Values{1.3, 1.7, 1.1, 3.0 + 1e-15})[0];
  EXPECT_EQ(found.values[0], sine(1.3)[0]);
  EXPECT_EQ(found.values[1], root(1.7)[0]);
  EXPECT_EQ(found.values[2], root(1.1)[0]);
  EXPECT_NEAR(found.values[3], std::sin(3.0), 1e-14);
  EXPECT_NEAR(root(1.7)[0], std::sqrt(1.7), 1e-4); // spacing^4/384 times 15/16
}

} // namespace
} // namespace cfpm::testing
