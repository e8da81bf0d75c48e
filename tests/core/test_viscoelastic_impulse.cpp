// SPDX-License-Identifier: GPL-2.0-or-later
// Hertz contacts whose damping grows with the area of contact: the motion by series, against an independent integrator
// of the law in time, and what impulses make of it.
#include "core/method/impulses/viscoelastic_impulse.h"
#include "head_on.h"

#include <gtest/gtest.h>

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace cfpm::testing {
namespace {

using Law = ViscoelasticImpulse::Law;

constexpr double mass = 0.02;
constexpr double stiffness = 3e6;

/// A law whose contacts have this alpha where the state is as large as an impact at that speed [m/s].
Law law_of(double alpha, double speed, double least_force) {
  const double size = std::pow(speed / std::sqrt(stiffness / mass), 0.2);
  const double damping = alpha / size * std::sqrt(stiffness * mass);
  return {stiffness, damping, 0.5 * stiffness, 0.7 * damping, 0.3, least_force};
}

/// Of m d'' = -kn d^(3/2) - hn d^(1/2) d' in time, in steps of odeint that are as fine at the beginning as t^3, where
/// the law is not smooth: up to a time, or to where the contact ends, between two steps by the secant.
struct Integrated {
  State end;
  double time;
  double mean_overlap;
};
Integrated integrated(const Law &law, State start, double time) {
  using Augmented = std::array<double, 3>;
  boost::numeric::odeint::runge_kutta_fehlberg78<Augmented> stepper;
  const auto force = [&](const Augmented &s) {
    const double root = std::sqrt(std::max(0.0, s[0]));
    return root * (law.normal_stiffness * s[0] + law.normal_damping * s[1]);
  };
  // the force over the root of the overlap vanishes steeply
  const auto hold = [&](const Augmented &s) {
    return law.tension() ? s[0] : law.normal_stiffness * s[0] + law.normal_damping * s[1];
  };
  Augmented s{start[0], start[1], 0.0};
  constexpr int steps = 20000;
  double t = 0.0;
  for (int k = 1; k <= steps; ++k) {
    const Augmented before = s;
    const double x = static_cast<double>(k) / steps;
    const double next = time * x * x * x;
    stepper.do_step(
        [&](const Augmented &at, Augmented &rate, double) {
          rate = {at[1], -force(at) / mass, at[0]};
        },
        s, t, next - t);
    if (hold(s) <= 0.0 && s[1] < 0.0) {
      const double part = hold(before) / (hold(before) - hold(s));
      const auto at = [&](std::size_t i) { return before[i] + part * (s[i] - before[i]); };
      const double ended = t + part * (next - t);
      return {{at(0), at(1)}, ended, at(2) / ended};
    }
    t = next;
  }
  return {{s[0], s[1]}, t, s[2] / t};
}

/// alpha of the impact, and whether the contact has tension.
class Viscoelastic : public ::testing::TestWithParam<std::tuple<double, double>> {
protected:
  const double alpha = std::get<0>(GetParam());
  const double least_force = std::get<1>(GetParam());
};

/// What the header promises, and the secant in steps of 2e-4 of the time.
TEST_P(Viscoelastic, CollisionsAreThoseOfTheLaw) {
  for (const double speed : {0.01, 2.0}) {
    const Law law = law_of(alpha, speed, least_force);
    const double tc = hertz_contact_time(stiffness, mass, speed);
    const Integrated expected = integrated(law, {0.0, speed}, 9.0 * tc);
    const ViscoelasticImpulse kind(law, mass, mass / 3.5, tc);
    const NormalImpulse found = kind.normal(0.0, speed, 20.0 * tc);
    EXPECT_NEAR(found.impulse / (mass * speed), 1.0 - expected.end[1] / speed, 3e-6);
    EXPECT_NEAR(found.contact_time / expected.time, 1.0, 1e-5);
    // behind the contact it flies, over 20 tc with the error of its speed
    EXPECT_NEAR(found.time_moment / mass,
                20.0 * tc * speed - expected.end[0] - (20.0 * tc - expected.time) * expected.end[1], 7e-5 * speed * tc);
  }
}

/// Whatever the steps, from touch to release: the error of each is that of the whole.
TEST_P(Viscoelastic, RestitutionIsTheSameAtAnyStep) {
  const double speed = 0.7;
  const Law law = law_of(alpha, speed, least_force);
  const double tc = hertz_contact_time(stiffness, mass, speed);
  const double once = ViscoelasticImpulse(law, mass, mass / 3.5, tc).normal(0.0, speed, 20.0 * tc).impulse;
  std::mt19937 random(8);
  for (const double t_star : {0.01, 0.05, 0.33, 1.0, 3.0}) {
    const ViscoelasticImpulse kind(law, mass, mass / 3.5, t_star * tc);
    for (int k = 0; k < 20; ++k) {
      const double gap = std::uniform_real_distribution<>(0.0, speed * t_star * tc)(random);
      EXPECT_NEAR(collide(kind, mass, speed, gap)[1], speed - once / mass, 3e-6 * speed) << t_star;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfAlpha, Viscoelastic,
                         ::testing::Combine(::testing::Values(0.0, 0.0085, 0.1, 0.5, 1.0, 2.0, 3.0),
                                            ::testing::Values(with_tension, without_tension)));

/// States that no collision comes through as well: others have pulled the bodies apart, or hold them.
TEST(ViscoelasticImpulse, FollowsAnyState) {
  const Law law = law_of(1.0, 1.0, with_tension);
  const double size = std::pow(1.0 / std::sqrt(stiffness / mass), 0.2);
  const double overlap = std::pow(size, 4.0);
  const double tc = hertz_contact_time(stiffness, mass, 1.0);
  for (const double speed : {-4.0, -1.0, 0.0, 0.3, 5.0})
    for (const double span : {0.02, 0.3, 1.0}) {
      const ViscoelasticImpulse kind(law, mass, mass / 3.5, span * tc);
      const Integrated expected = integrated(law, {overlap, speed}, span * tc);
      const NormalImpulse found = kind.normal(overlap, speed, span * tc);
      EXPECT_NEAR(found.impulse / mass, speed - expected.end[1], 5e-6 * (1.0 + std::fabs(speed)))
          << speed << " " << span;
      EXPECT_NEAR(found.contact_time / expected.time, 1.0, 1e-5) << speed << " " << span;
      EXPECT_EQ(found.contact_time == span * tc, expected.time == span * tc);
      if (expected.time < span * tc) continue;
      const double way = overlap + span * tc * speed - found.time_moment / mass - expected.end[0];
      EXPECT_NEAR(way, 0.0, 1e-6 * tc * (1.0 + std::fabs(speed))) << speed << " " << span;
    }
  for (const double speed : {0.0, -0.1}) {
    const ViscoelasticImpulse kind(law, mass, mass / 3.5, tc);
    EXPECT_EQ(kind.normal(0.0, speed, tc).contact_time, 0.0); // nothing holds them
    EXPECT_EQ(kind.normal_in_crowd(0.0, speed, tc, 2.0).impulse, 0.0);
  }
}

/// By the trapezoid and the slopes at both ends: its error falls with the fourth power of the span.
TEST(ViscoelasticImpulse, MeanOverlapIsOfFourthOrder) {
  const Law law = law_of(0.5, 0.3, with_tension);
  const ViscoelasticImpulse kind(law, mass, mass / 3.5, 1e-3);
  const auto error = [&](double span) {
    return std::fabs(kind.normal(2e-4, 0.3, span).mean_overlap - integrated(law, {2e-4, 0.3}, span).mean_overlap);
  };
  EXPECT_GT(std::log2(error(6e-4) / error(1.5e-4)) / 2.0, 3.5); // rounds to 4
}

/// The steps suffice over three contact times, however strong the damping is; bodies creep apart then.
TEST(ViscoelasticImpulse, FollowsOverdampedBodies) {
  const double tc = hertz_contact_time(stiffness, mass, 1.0);
  for (const double alpha : {8.0, 30.0}) {
    const Law law = law_of(alpha, 1.0, with_tension);
    const Integrated expected = integrated(law, {0.0, 1.0}, 3.0 * tc);
    const NormalImpulse found = ViscoelasticImpulse(law, mass, mass / 3.5, tc).normal(0.0, 1.0, 3.0 * tc);
    EXPECT_NEAR(found.impulse / mass, 1.0 - expected.end[1], 3e-6);
    EXPECT_EQ(found.contact_time, 3.0 * tc);
  }
}

/// Parts of a contact add up to it, and each has the spring of its overlap.
TEST(ViscoelasticImpulse, IsTheSumOfItsParts) {
  const Law law = law_of(0.5, 0.3, with_tension);
  const double tc = hertz_contact_time(stiffness, mass, 0.3);
  const ViscoelasticImpulse kind(law, mass, mass / 3.5, tc);
  const NormalImpulse whole = kind.normal(0.0, 0.3, 3.0 * tc);
  double sum = 0.0;
  double last = -1.0;
  int parts = 0;
  kind.in_parts(0.0, 0.3, whole.contact_time, 12, [&](const NormalPart &part, const Propagator &stick) {
    sum += part.impulse;
    const LinearLaw at = law.at(part.overlap);
    const Propagator expected =
        exact_flow({at.tangential_stiffness, at.tangential_damping, mass / 3.5}, whole.contact_time / 12);
    EXPECT_EQ(stick.rate_from_displacement, expected.rate_from_displacement);
    EXPECT_EQ(stick.rate_from_rate, expected.rate_from_rate);
    last = part.end_force;
    ++parts;
  });
  EXPECT_EQ(parts, 12);
  EXPECT_NEAR(sum / whole.impulse, 1.0, 3e-6);
  EXPECT_NEAR(last / (law.at(1e-4).normal_stiffness * 1e-4), 0.0, 1e-2); // where the bodies part
}

/// Of a contact that begins at 0.1 m/s: at the overlap where it would come to rest, nearly.
CrowdResponse response_of_touch(const Law &law, double dt) {
  const LinearLaw secant = law.at(std::pow(0.1 / std::sqrt(stiffness / mass), 0.8));
  const Oscillator tangent{1.5 * secant.normal_stiffness, secant.normal_damping, mass};
  return crowd_response(exact_flow(tangent, std::min(dt, time_of_largest_impulse(tangent))), dt);
}

/// In a crowd the isolated motion from a softened overlap, relaxed, as of the linear contact that touches the law.
TEST(ViscoelasticImpulse, InACrowdIsTheIsolatedOneRelaxed) {
  const Law law = law_of(0.3, 0.1, without_tension);
  const double overlap = 1e-4;
  const LinearLaw secant = law.at(overlap);
  const Oscillator tangent{1.5 * secant.normal_stiffness, secant.normal_damping, mass};
  const Oscillator slip{secant.tangential_stiffness, secant.tangential_damping, mass / 3.5};
  const double tc = contact_time(tangent.stiffness, mass);
  for (const double t_star : {0.02, 0.2, 1.0, 3.0}) {
    const double dt = t_star * tc;
    const ViscoelasticImpulse kind(law, mass, mass / 3.5, dt);
    const auto response = [&](const Oscillator &o) {
      return crowd_response(exact_flow(o, std::min(dt, time_of_largest_impulse(o))), dt);
    };
    const CrowdResponse r = response(tangent);
    for (const double felt : {1.25, 6.0}) {
      const NormalImpulse held = kind.normal_in_crowd(overlap, 0.0, dt, felt);
      const double alone = kind.normal(r.softening * overlap, 0.0, dt).impulse;
      EXPECT_NEAR(held.impulse / (alone * r.relaxation(felt)), 1.0, 1e-12) << t_star << " " << felt;
      EXPECT_EQ(held.contact_time, dt);
      EXPECT_EQ(held.mean_overlap, overlap);
      const CrowdResponse found = kind.slip_in_crowd(held);
      EXPECT_NEAR(found.rate_from_displacement / response(slip).rate_from_displacement, 1.0, 1e-12);
      EXPECT_NEAR(found.rate_from_rate, response(slip).rate_from_rate, 1e-12);
      const NormalImpulse begins = kind.normal_in_crowd(0.0, 0.1, 0.4 * dt, felt);
      EXPECT_NEAR(begins.impulse / kind.normal(0.0, 0.1, 0.4 * dt).impulse, response_of_touch(law, dt).relaxation(felt),
                  1e-12);
    }
    EXPECT_EQ(kind.normal_in_crowd(overlap, -10.0, dt, 2.0).contact_time, 0.0); // would pull
  }
}

} // namespace
} // namespace cfpm::testing
