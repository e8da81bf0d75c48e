// SPDX-License-Identifier: GPL-2.0-or-later
// The exact impulse of an isolated contact: from touch to release, whatever the steps.
#include "core/method/contact_solver.h"
#include "core/method/impulses/impulse_friction.h"
#include "core/step/add_pair_forces.h"
#include "head_on.h"

#include <gtest/gtest.h>

#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <array>
#include <cmath>
#include <random>

namespace cfpm::testing {
namespace {

using HertzLaw = HertzImpulse::Law;

/// By an integrator of high order in steps that are finer at both ends, where Hertz' law is not smooth; force(d, u)
/// acts all the time.
template <class Force> State integrated(const Force &force, double mass, State s, double time) {
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
  const auto derivative = [&](const State &at, State &rate, double) {
    rate = {at[1], -force(std::max(0.0, at[0]), at[1]) / mass};
  };
  constexpr int steps = 800;
  double t = 0.0;
  for (int k = 1; k <= steps; ++k) {
    const double sine = std::sin(0.5 * pi * k / steps);
    const double next = time * sine * sine * sine * sine * (3.0 - 2.0 * sine * sine); // 0 to time, flat at both
    stepper.do_step(derivative, s, t, next - t);
    t = next;
  }
  return s;
}

TEST(FifthRoot, OfAnySize) {
  for (double x = 1e-300; x < 1e300; x *= 1.7) {
    const double y = inverse_fifth_root(x);
    EXPECT_NEAR(x * y * (y * y * y * y), 1.0, 1e-14) << x;
  }
  EXPECT_TRUE(std::isfinite(inverse_fifth_root(0.0)));
}

/// alpha, and whether the contact has tension.
class Trajectory : public ::testing::TestWithParam<std::tuple<double, bool>> {};

TEST_P(Trajectory, HasTheRestitutionOfItsClosedForm) {
  const auto [alpha, tension] = GetParam();
  const HertzTrajectory t(alpha, tension);
  const double root = std::sqrt(5.0 - alpha * alpha);
  const bool earlier = alpha > 0.0 && !tension; // than where the bodies part
  const double theta = earlier ? std::atan((2.0 * alpha - 5.0 / alpha) / (2.0 * root)) : -0.5 * pi;
  EXPECT_NEAR(-t.tables().release()[1], std::exp(-alpha / root * (0.5 * pi - theta)), 1e-14);
}

TEST_P(Trajectory, IsWhatAnIntegratorFinds) {
  const auto [damping, tension] = GetParam();
  const double alpha = damping;
  const HertzTrajectory t(alpha, tension);
  const auto force = [&](double d, double u) { return std::pow(d, 1.5) + alpha * std::pow(d, 0.25) * u; };
  double largest = 0.0;
  for (int k = 1; k < 20; ++k) {
    const double phase = t.tables().duration * k / 20.0;
    const State s = integrated(force, 1.0, {0.0, 1.0}, phase);
    const auto [d, u] = t.tables().state(phase);
    largest = std::max({largest, std::fabs(d - s[0]), std::fabs(u - s[1])});
    const double p = std::pow(1.0 + std::fabs(u) / std::pow(d, 1.25), -0.2);
    EXPECT_NEAR(t.tables().place(p, u >= 0.0).phase, phase, 1e-8) << phase;
    EXPECT_NEAR(t.tables().place(p, u >= 0.0).scale, std::pow(std::fabs(u) + std::pow(d, 1.25), -0.2), 1e-9) << phase;
  }
  EXPECT_LT(largest, 1e-9);
  const State end = integrated(force, 1.0, {0.0, 1.0}, t.tables().duration);
  EXPECT_NEAR(end[0], t.tables().release()[0], 1e-9);
  EXPECT_NEAR(end[1], t.tables().release()[1], 1e-9);
}

INSTANTIATE_TEST_SUITE_P(WithoutTension, Trajectory,
                         ::testing::Combine(::testing::Values(0.0, 1e-3, 0.07, 0.3, 0.6, 1.0, 1.3, 1.9, 2.2),
                                            ::testing::Values(false)));
// 1.3: restitution 0.1; beyond, the tables become less accurate as the contact ends later and later
INSTANTIATE_TEST_SUITE_P(WithTension, Trajectory,
                         ::testing::Combine(::testing::Values(0.0, 1e-3, 0.07, 0.3, 0.6, 1.0, 1.3),
                                            ::testing::Values(true)));

TEST(Trajectory, LastsAsLongAsHertzSays) { // method.md: 3.218, 2.809, 2.372
  EXPECT_NEAR(HertzTrajectory(0.0, false).tables().duration, hertz_contact_time_unit(), 1e-12);
}

TEST(LinearImpulse, RestitutionIsThatOfTheClosedFormAtAnyStep) {
  const double mass = 0.02;
  const double stiffness = 2e4;
  const double tc = contact_time(stiffness, mass);
  std::mt19937 random(7);
  for (const double zeta : {0.0, 0.1, 0.7, 1.0, 1.2}) {
    const double damping = 2.0 * zeta * std::sqrt(stiffness * mass);
    const Oscillator o{stiffness, damping, mass};
    const double release = LinearRelease(o, false).time({0.0, 1.0});
    const double restitution = -Exact::advance(o, {0.0, 1.0}, release).rate;
    for (const double t_star : {0.05, 0.1, 0.33, 1.0, 2.0, 3.0}) {
      const LinearImpulse kind({stiffness, damping, 0.0, 0.0, 0.0}, mass, mass / 3.5, t_star * tc);
      for (int k = 0; k < 50; ++k) {
        const double gap = std::uniform_real_distribution<>(0.0, t_star * tc * 2.0)(random);
        EXPECT_NEAR(-collide(kind, mass, 2.0, gap)[1] / 2.0, restitution, 1e-12) << zeta << " " << t_star;
      }
    }
  }
}

TEST(LinearImpulse, WithTensionTheRestitutionIsThatOfTheOscillator) { // e = exp(-pi zeta/sqrt(1 - zeta^2)), at d = 0
  const double mass = 0.02;
  const double stiffness = 2e4;
  const double tc = contact_time(stiffness, mass);
  std::mt19937 random(9);
  for (const double zeta : {0.0, 0.1, 0.6, 0.83}) {
    const LinearLaw law{stiffness, 2.0 * zeta * std::sqrt(stiffness * mass), 0.0, 0.0, 0.0, with_tension};
    for (const double t_star : {0.05, 0.1, 0.33, 1.0, 2.0, 3.0}) {
      const LinearImpulse kind(law, mass, mass / 3.5, t_star * tc);
      for (int k = 0; k < 50; ++k) {
        const double gap = std::uniform_real_distribution<>(0.0, t_star * tc * 2.0)(random);
        EXPECT_NEAR(-collide(kind, mass, 2.0, gap)[1] / 2.0, std::exp(-pi * zeta / std::sqrt(1.0 - zeta * zeta)), 1e-12)
            << zeta << " " << t_star;
      }
    }
  }
}

TEST(LinearImpulse, WithTensionAnOverdampedContactNeverParts) {
  const double mass = 0.02;
  const LinearLaw law{2e4, 2.4 * std::sqrt(2e4 * mass), 0.0, 0.0, 0.0, with_tension};
  const LinearImpulse kind(law, mass, mass / 3.5, 1.0);
  const NormalImpulse n = kind.normal(0.0, 2.0, 1.0);
  EXPECT_EQ(n.contact_time, 1.0);
  EXPECT_NEAR(n.impulse, mass * 2.0, 1e-15);
}

TEST(LinearImpulse, WithTensionPullsUntilTheBodiesPart) {
  const double mass = 0.02;
  const LinearLaw law{2e4, 15.0, 0.0, 0.0, 0.0, with_tension};
  const double overlap = 1e-4;
  for (const double speed : {-0.2, -1.0}) {
    const double span = 2e-5; // the bodies are together all the time
    const LinearImpulse kind(law, mass, mass / 3.5, 1e-3);
    const State s =
        integrated([&](double d, double u) { return law.normal_force(d, u); }, mass, {overlap, speed}, span);
    ASSERT_GT(s[0], 0.0);
    ASSERT_LT(law.normal_force(overlap, speed), 0.0);
    const NormalImpulse n = kind.normal(overlap, speed, span);
    EXPECT_LT(n.impulse, 0.0);
    EXPECT_NEAR(n.impulse, mass * (speed - s[1]), 1e-14);
    EXPECT_EQ(n.force, law.normal_force(overlap, speed));
    const NormalImpulse whole = kind.normal(overlap, speed, 1e-3); // and free from where they part
    EXPECT_LT(whole.contact_time, 1e-3);
    const OscillatorState parted =
        Exact::advance({law.normal_stiffness, law.normal_damping, mass}, {overlap, speed}, whole.contact_time);
    EXPECT_NEAR(parted.displacement, 0.0, 1e-15);
    EXPECT_NEAR(whole.impulse, mass * (speed - parted.rate), 1e-15);
  }
}

TEST(LinearImpulse, IsWhatAnIntegratorFinds) {
  const double mass = 0.02;
  const LinearLaw law{2e4, 15.0, 0.0, 0.0, 0.0};
  for (const double span : {1e-4, 1e-3, 2e-3}) {
    const LinearImpulse kind(law, mass, mass / 3.5, 2e-3);
    const State s = integrated([&](double d, double u) { return law.normal_force(d, u); }, mass, {1e-4, 0.5}, span);
    const NormalImpulse n = kind.normal(1e-4, 0.5, span);
    EXPECT_NEAR(n.impulse, mass * (0.5 - s[1]), 1e-12);
    EXPECT_NEAR(n.time_moment, mass * (1e-4 + 0.5 * span - s[0]), 1e-14);
  }
}

TEST(LinearImpulse, OfAReleasedContactIsNothing) {
  const LinearImpulse kind({2e4, 15.0, 8e3, 3.0, 0.3}, 0.02, 0.02 / 3.5, 1e-3);
  const NormalImpulse n = kind.normal(1e-4, -0.2, 1e-3);
  EXPECT_EQ(n.impulse, 0.0);
  EXPECT_EQ(n.time_moment, 0.0);
  EXPECT_EQ(n.contact_time, 0.0);
}

HertzTables tables_of(const HertzLaw &law, double mass) {
  const auto response_to = [](const Oscillator &o) {
    return std::make_shared<CrowdResponseTable>(CrowdResponseTable::damping_ratio(o));
  };
  return {std::make_shared<HertzTrajectory>(HertzImpulse::alpha(law, mass), law.tension()),
          response_to(HertzImpulse::normal_at(law, mass, 1.0)),
          response_to(HertzImpulse::slip_at(law, mass / 3.5, 1.0))};
}

TEST(HertzImpulse, RestitutionIsThatOfTheClosedFormAtAnyStep) {
  const double mass = 0.02;
  const double stiffness = 3e6;
  std::mt19937 random(8);
  for (const auto &[alpha, tension] : {std::pair{0.0, without_tension},
                                       {0.07, without_tension},
                                       {0.3, without_tension},
                                       {1.0, without_tension},
                                       {1.5, without_tension},
                                       {0.3, with_tension},
                                       {1.3, with_tension},
                                       {1.7, with_tension}}) {
    const double tolerance = tension < 0.0 ? 1e-6 : 3e-9; // what the docs promise; the tables are better
    const HertzLaw law{stiffness, alpha * std::sqrt(stiffness * mass), 0.0, 0.0, 0.0, tension};
    const HertzTables tables = tables_of(law, mass);
    for (const double speed : {0.01, 2.0}) {
      const double tc = hertz_contact_time(stiffness, mass, speed);
      for (const double t_star : {0.05, 0.1, 0.33, 1.0, 2.0, 3.0}) {
        const HertzImpulse kind(law, tables, mass, mass / 3.5, t_star * tc);
        for (int k = 0; k < 50; ++k) {
          const double gap = std::uniform_real_distribution<>(0.0, speed * t_star * tc)(random);
          EXPECT_NEAR(-collide(kind, mass, speed, gap)[1] / speed, -tables.trajectory->tables().release()[1], tolerance)
              << alpha << " " << t_star;
        }
      }
    }
  }
}

TEST(HertzPrediction, IsTheForceAtTheEnd) {
  const double mass = 0.02;
  const double alpha = 0.3;
  const double stiffness = 3e6;
  const HertzLaw law{stiffness, alpha * std::sqrt(stiffness * mass), 0.0, 0.0, 0.0};
  const HertzPrediction kind(law, tables_of(law, mass).trajectory, mass, mass / 3.5, 1e-4);
  const State s = integrated([&](double d, double u) { return law.at(d).normal_force(d, u); }, mass, {1e-5, 0.3}, 1e-4);
  const double expected = law.at(s[0]).normal_force(s[0], s[1]);
  EXPECT_NEAR(kind.at(1e-5, 0.3).predicted_normal_force / expected, 1.0, 1e-8);
}

struct Outcome {
  MeanForce mean;
  Vec3 next; ///< what the spring is carried on as
};

constexpr double isolated = 1.0; // see crowding()
constexpr double crowded = 1.25;

/// A contact along z that has a spring along x.
template <Friction friction = Friction::spring_and_dashpot>
Outcome act(const LinearImpulse &kind, double overlap, const Vec3 &spring, const Vec3 &slip, double felt) {
  double values[3] = {spring.x - 0.5 * kind.dt() * slip.x, spring.y - 0.5 * kind.dt() * slip.y, 0.0};
  double now[3] = {};
  const ContactGeometry g{{0.0, 0.0, 1.0}, overlap, 0.0, slip, 0.01, 0.01, {}};
  const NormalImpulse normal = felt == isolated ? kind.normal(g.overlap, g.closing_speed, kind.dt())
                                                : kind.normal_in_crowd(g.overlap, g.closing_speed, kind.dt(), felt);
  const StoredSpring stored{values, kind.dt(), true, now};
  return {mean_force_of_impulse<friction>(kind, normal, g, kind.dt(), felt, stored, 0.0), vec3(values)};
}

/// Per m (|u| + w d), over states from where the force vanishes through rest to the touch.
TEST(ReleasedImpulse, IsThatOfTheIsolatedContact) {
  const double mass = 0.02;
  const double stiffness = 2e4;
  const double rate = std::sqrt(stiffness / mass);
  for (const double zeta : {0.0, 0.1, 0.3, 0.6, 0.9}) {
    const Oscillator o{stiffness, 2.0 * zeta * std::sqrt(stiffness * mass), mass};
    const LinearRelease release(o, false);
    const ReleasedImpulse impulse(o, release, false);
    const double last = -1.0 / (1.0 + 2.0 * zeta);
    for (int k = 0; k <= 100; ++k) {
      const double p = last + (1.0 - last) * k / 100.0;
      const OscillatorState start{(1.0 - std::fabs(p)) / rate, p};
      const double exact = p > last ? mass * (p - release.fly(start, 10.0).end.rate) : 0.0;
      EXPECT_NEAR(impulse(start.displacement, start.rate), exact, 0.045 * mass) << zeta << " " << p;
    }
    const double small = 1e-4; // around rest and the touch the slopes are right too
    for (const OscillatorState &start : {OscillatorState{1.0 / rate, small}, OscillatorState{1.0 / rate, -small},
                                         OscillatorState{small / rate, 1.0}, OscillatorState{0.0, 1.0}})
      EXPECT_NEAR(impulse(start.displacement, start.rate), mass * (start.rate - release.fly(start, 10.0).end.rate),
                  20.0 * small * small * mass)
          << zeta;
    EXPECT_NEAR(impulse(0.0, 1.0), mass * (1.0 + release.restitution()), 1e-15);
    for (const double before : {1e-2, 1e-3}) { // just before the release right by its first two terms
      const double p = last + before;
      const OscillatorState start{(1.0 + p) / rate, p};
      const double exact = mass * (p - release.fly(start, 10.0).end.rate);
      EXPECT_NEAR(impulse(start.displacement, start.rate) / exact, 1.0, 100.0 * before * before) << zeta;
    }
  }
}

/// The same to where the bodies part.
TEST(ReleasedImpulse, WithTensionIsThatOfTheIsolatedContact) {
  const double mass = 0.02;
  const double stiffness = 2e4;
  const double rate = std::sqrt(stiffness / mass);
  for (const double zeta : {0.0, 0.1, 0.3, 0.6, 0.8}) {
    const Oscillator o{stiffness, 2.0 * zeta * std::sqrt(stiffness * mass), mass};
    const LinearRelease release(o, true);
    const ReleasedImpulse impulse(o, release, true);
    ASSERT_TRUE(impulse.fits());
    const auto exact = [&](double p) {
      const OscillatorState start{(1.0 - std::fabs(p)) / rate, p};
      return mass * (p - release.fly(start, 10.0).end.rate);
    };
    const auto found = [&](double p) { return impulse((1.0 - std::fabs(p)) / rate, p); };
    for (int k = 1; k <= 100; ++k) {
      const double p = -1.0 + 2.0 * k / 100.0;
      EXPECT_NEAR(found(p), exact(p), 0.045 * mass) << zeta << " " << p;
    }
    for (const double p : {1e-4, -1e-4, 1.0 - 1e-4, 1.0}) EXPECT_NEAR(found(p), exact(p), 20.0 * 1e-8 * mass) << zeta;
    for (const double before : {1e-2, 1e-3}) // just before the bodies part right by two terms
      EXPECT_NEAR(found(-1.0 + before), exact(-1.0 + before), 10.0 * before * before * before * mass) << zeta;
  }
  const Oscillator stronger{stiffness, 2.0 * 0.85 * std::sqrt(stiffness * mass), mass};
  EXPECT_FALSE(ReleasedImpulse(stronger, LinearRelease(stronger, true), true).fits());
  EXPECT_TRUE(ReleasedImpulse(stronger, LinearRelease(stronger, false), false).fits());
}

TEST(LinearImpulse, InACrowdIsTheIsolatedOneRelaxed) {
  const double mass = 0.02;
  const double stiffness = 2e4;
  const double rate = std::sqrt(stiffness / mass);
  const double overlap = 1e-3;
  for (const double zeta : {0.0, 0.1, 0.4, 0.9, 0.95, 1.0, 1.2, 5.0}) {
    const Oscillator o{stiffness, 2.0 * zeta * std::sqrt(stiffness * mass), mass};
    const LinearLaw law{o.stiffness, o.damping, 8e3, 3.0, 0.3};
    for (const double t_star : {0.02, 0.2, 0.9, 1.5, 10.0}) {
      const LinearImpulse kind(law, mass, mass / 3.5, t_star * contact_time(stiffness, mass));
      const CrowdResponse r =
          crowd_response(make_propagator<Exact>(o, std::min(kind.dt(), time_of_largest_impulse(o))), kind.dt());
      for (const double felt : {1.25, 4.0})
        for (const double speed : {0.0, 0.4, -0.05, -0.4}) {
          const NormalImpulse alone = kind.normal(r.softening * overlap, speed, kind.dt());
          const NormalImpulse held = kind.normal_in_crowd(overlap, speed, kind.dt(), felt);
          // released inside the step it is what ReleasedImpulse makes of it
          const bool released = alone.contact_time < kind.dt() && zeta <= 0.9;
          const double error = released ? 0.045 * mass * (std::fabs(speed) + rate * overlap) : 1e-15;
          EXPECT_NEAR(held.impulse, alone.impulse * r.relaxation(felt), error) << zeta << " " << t_star << " " << speed;
          EXPECT_GE(held.impulse, 0.0) << zeta << " " << t_star << " " << speed;
          EXPECT_EQ(held.contact_time, alone.contact_time > 0.0 ? kind.dt() : 0.0);
        }
    }
  }
}

TEST(CrowdResponseTable, IsTheResponseOfEachContact) {
  const double dt = 1e-3;
  for (const Oscillator &o : {Oscillator{2e4, 0.0, 0.02}, Oscillator{2e4, 10.0, 0.02}, Oscillator{2e4, 60.0, 0.02},
                              Oscillator{0.0, 60.0, 0.02}}) {
    const CrowdResponseTable table(CrowdResponseTable::damping_ratio(o));
    const double rate = CrowdResponseTable::rate(o);
    for (const double span : {0.0, 1e-5, 3e-4, 8e-4, 1e-3}) {
      const CrowdResponse r = table.at(rate, span, dt);
      const CrowdResponse exact =
          crowd_response(make_propagator<Exact>(o, std::min(span, time_of_largest_impulse(o))), dt);
      EXPECT_NEAR(r.rate_from_displacement, exact.rate_from_displacement, 1e-6 * rate) << o.damping << " " << span;
      EXPECT_NEAR(r.rate_from_rate, exact.rate_from_rate, 1e-6) << o.damping << " " << span;
      EXPECT_NEAR(r.softening, exact.softening, 1e-6) << o.stiffness << " " << o.damping << " " << span;
    }
  }
}

TEST(HertzImpulse, InACrowdIsTheIsolatedOneRelaxed) {
  const double mass = 0.02;
  const double stiffness = 3e6;
  const HertzLaw law{stiffness, 0.3 * std::sqrt(stiffness * mass), 0.5 * stiffness, 0.0, 0.3};
  const double overlap = 1e-4;
  const Oscillator tangent = HertzImpulse::normal_at(law, mass, overlap);
  const double tc = contact_time(tangent.stiffness, mass);
  for (const double t_star : {0.02, 0.2, 1.0, 3.0}) {
    const HertzImpulse kind(law, tables_of(law, mass), mass, mass / 3.5, t_star * tc);
    const CrowdResponse r = crowd_response(
        make_propagator<Exact>(tangent, std::min(kind.dt(), time_of_largest_impulse(tangent))), kind.dt());
    for (const double felt : {1.25, 6.0}) {
      const NormalImpulse held = kind.normal_in_crowd(overlap, 0.0, kind.dt(), felt);
      const double alone = kind.normal(r.softening * overlap, 0.0, kind.dt()).impulse;
      EXPECT_NEAR(held.impulse / (alone * r.relaxation(felt)), 1.0, 1e-6) << t_star << " " << felt;
      EXPECT_EQ(held.contact_time, kind.dt());
      EXPECT_EQ(held.mean_overlap, overlap);
    }
    EXPECT_EQ(kind.normal_in_crowd(overlap, -10.0, kind.dt(), 2.0).contact_time, 0.0); // would pull
    EXPECT_EQ(kind.normal_in_crowd(0.0, 0.0, kind.dt(), 2.0).contact_time, 0.0);
  }
}

TEST(ExactImpulse, OfBodiesThatOnlyGrazeIsNothing) {
  const LinearImpulse kind({2e4, 15.0, 8e3, 3.0, 0.3}, 0.02, 0.02 / 3.5, 1e-3);
  const auto kind_of = [&](const ContactPartners &) -> const LinearImpulse & { return kind; };
  const ExactImpulse method(kind_of, kind.dt());
  const ContactGeometry grazing =
      touching_spheres({0.0, 0.01, 0.0}, 0.01, 0.005, 0.005, {{2.0, 0.0, 0.0}, {}}, {{}, {}});
  const auto normal = method.normal(kind, grazing, kind.dt(), 0.0);
  EXPECT_FALSE(normal.in_contact());
  EXPECT_EQ(normal.action.impulse, 0.0);
  EXPECT_EQ(normal.action.force, 0.0);
}

TEST(MeanForceOfImpulse, CrowdedContactAtRestKeepsItsSpringAndItsPlace) {
  for (const double dt : {1e-3, 1e-2}) { // over the longer one it is released if alone
    const LinearImpulse kind({2e4, 15.0, 8e3, 3.0, 0.3}, 0.02, 0.02 / 3.5, dt);
    const Vec3 spring{1e-5, 0.0, 0.0};
    const Outcome held = act(kind, 1e-4, spring, {}, crowded);
    EXPECT_EQ(held.next, spring) << dt;
    EXPECT_EQ(held.mean.shift, Vec3{});
    const Outcome alone = act(kind, 1e-4, spring, {}, isolated);
    EXPECT_FALSE(alone.next == spring);
    EXPECT_NE(alone.mean.shift.z, 0.0);
  }
}

TEST(MeanForceOfImpulse, CrowdIsWhatOthersAddToTheMass) {
  const double counts[] = {1.0, 4.0};
  const Crowd crowd{counts, 0.0};
  EXPECT_EQ(crowd.others(0, 0.5), 0.0);
  EXPECT_EQ(crowd.others(1, 0.5), 6.0);
  EXPECT_EQ(crowding(0.0, 0.25), 1.0);
  EXPECT_EQ(crowding(6.0, 0.25), 1.75); // a pair: three others, each half of m*/m = 1/2
}

/// A mode of a network in which contacts act together, so many times as strong as one of them alone, comes to rest if
/// the eigenvalues of its step are not outside of the unit circle.
TEST(CrowdResponse, NetworksComeToRestAtAnyStep) {
  const double mass = 0.02;
  const double stiffness = 2e4;
  for (const double zeta : {0.0, 0.1, 0.7, 1.0, 1.2})
    for (const double t_star : {0.01, 0.1, 0.33, 0.5, 1.0, 3.0, 30.0})
      for (const double felt : {1.0, 1.25, 3.0, 6.0}) {
        const Oscillator o{stiffness, 2.0 * zeta * std::sqrt(stiffness * mass), mass};
        const double dt = t_star * contact_time(stiffness, mass);
        const CrowdResponse r = crowd_response(make_propagator<Exact>(o, std::min(dt, time_of_largest_impulse(o))), dt);
        const double c_dt = -r.softening * r.rate_from_displacement * dt;
        const double d = 1.0 - r.rate_from_rate;
        for (const double strength : {0.05, 1.0, felt, 1.99 * felt}) {
          const double l = strength * r.relaxation(felt);
          const double trace = 2.0 - l * (d + 0.5 * c_dt);
          const double determinant = 1.0 - l * (d - 0.5 * c_dt);
          EXPECT_LT(std::fabs(determinant), 1.0 + 1e-13) << zeta << " " << t_star << " " << felt << " " << strength;
          EXPECT_LT(std::fabs(trace), 1.0 + determinant + 1e-13) << zeta << " " << t_star << " " << felt;
        }
      }
}

TEST(MeanForceOfImpulse, FrictionIsLimitedByTheNormalImpulse) {
  const LinearImpulse kind({2e4, 15.0, 8e3, 3.0, 0.3}, 0.02, 0.02 / 3.5, 1e-3);
  for (const double felt : {isolated, crowded}) {
    const MeanForce mean = act<Friction::limited_together>(kind, 1e-4, {}, {5.0, 0.0, 0.0}, felt).mean;
    EXPECT_NEAR(mean.force.x, -0.3 * mean.force.z, 1e-12 * mean.force.z) << felt;
    EXPECT_EQ(mean.force.y, 0.0);
  }
}

TEST(MeanForceOfImpulse, CrowdedBodiesThatStickDoNotSwingBack) {
  const Oscillator slip{8e3, 0.0, 0.02 / 3.5};
  const double quarter = time_of_largest_impulse(slip);
  EXPECT_DOUBLE_EQ(quarter, 0.5 * pi * std::sqrt(slip.mass / slip.stiffness));
  const LinearImpulse kind({2e3, 15.0, 8e3, 0.0, 1e3}, 0.02, slip.mass, 3.0 * quarter);
  const Vec3 at_rest = act(kind, 1e-4, {1e-5, 0.0, 0.0}, {}, crowded).mean.force;
  const double most = 1e-5 * std::sqrt(slip.stiffness * slip.mass); // that the spring gives; softened by steps, shared
  EXPECT_NEAR(at_rest.x * kind.dt(), -most / 3.0 / crowded, 1e-16);
}

TEST(LargestApproach, IsThatOfTheTwoFastest) {
  const double slow[] = {0.0, 1.0, 0.0};
  const double fast[] = {3.0, 0.0, -4.0};
  const double *const v[] = {slow, fast};
  EXPECT_DOUBLE_EQ(largest_approach(v, 2, 0.1), 1.0); // each 5 m/s, head-on
  EXPECT_EQ(largest_approach(v, 0, 0.1), 0.0);
}

TEST(TimeToTouch, OfSpheresAndPlanes) {
  const double t = time_to_touch({3.0, 0.5, 0.0}, {-2.0, 0.0, 0.0}, 1.0, 2.0);
  EXPECT_DOUBLE_EQ(norm(Vec3{3.0 - 2.0 * t, 0.5, 0.0}), 1.0);
  EXPECT_EQ(time_to_touch({3.0, 0.5, 0.0}, {-2.0, 0.0, 0.0}, 1.0, 1.01 * t), t);
  EXPECT_TRUE(std::isinf(time_to_touch({3.0, 1.5, 0.0}, {-2.0, 0.0, 0.0}, 1.0, 2.0)));
  EXPECT_TRUE(std::isinf(time_to_touch({3.0, 0.5, 0.0}, {2.0, 0.0, 0.0}, 1.0, 2.0)));
  EXPECT_DOUBLE_EQ(time_to_touch_plane({0.0, 0.0, 1.0}, {5.0, 0.0, -2.0}, 0.5), 0.25);
  EXPECT_TRUE(std::isinf(time_to_touch_plane({0.0, 0.0, 1.0}, {5.0, 0.0, 2.0}, 0.5)));
}

} // namespace
} // namespace cfpm::testing
