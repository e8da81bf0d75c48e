// SPDX-License-Identifier: GPL-2.0-or-later
// What a contact gives in a crowd, where other contacts hold its bodies: not an exact solution but a formula, and here
// written a second time from what crowd.h, crowd_response.h and friction_in_crowd.h say of it. A weak damping is taken,
// for which the motion over a time is a decaying sine.
#include "core/method/contact_solver.h"
#include "isolated_contact.h"

#include <gtest/gtest.h>

#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace cfpm::testing {
namespace {

/// A contact that swings: m x'' + h x' + k x = 0, less than critically damped.
struct Swing {
  double k, h, m;
  double decay() const { return h / (2.0 * m); }
  double frequency() const { return std::sqrt(k / m - decay() * decay()); }
  /// The rate after a time, from unit displacement and from unit rate.
  double rate_from_displacement(double t) const {
    return -k / m * std::exp(-decay() * t) * std::sin(frequency() * t) / frequency();
  }
  double rate_from_rate(double t) const {
    return std::exp(-decay() * t) * (std::cos(frequency() * t) - decay() / frequency() * std::sin(frequency() * t));
  }
  /// When a spring that is released at rest has given most: the rate has its extremum, tan(W t) = W/b.
  double of_largest_impulse() const { return std::atan2(frequency(), decay()) / frequency(); }
};

struct Friction2 {
  Vec3 impulse;
  Vec3 next;
};

/// The contact sticks, over the time in contact but no longer than until the largest impulse, and gives
/// m (C s + (D - 1) w), C softened so that -C dt is at most pi/2, all of it divided among those that act together
/// where crowding times 1 - D is above 1. If that is more than Coulomb allows, it slides; without "together" that holds
/// of what is not the dashpot's h times the way of w, which acts until the spring's force is at the limit, if that
/// grows on a straight line. The spring is shortened to what without slip would stick at the limit, and carried by half
/// a step of the slip velocity less. Where the limit holds both together, the spring is shortened as one that is longer
/// by h/k w.
Friction2 crowded_friction(const Swing &slip, double friction, double normal_impulse, double contact_time,
                           double cohesive, double crowding, const Vec3 &spring, const Vec3 &w, double span, double dt,
                           bool together) {
  const double t = std::min(contact_time, std::min(dt, slip.of_largest_impulse()));
  const double d = 1.0 - slip.rate_from_rate(t);
  double c = -slip.rate_from_displacement(t);
  if (c * dt > 0.5 * pi) c = 0.5 * pi / dt;
  const double m = crowding * d > 1.0 ? slip.m / (crowding * d) : slip.m;
  const double limit = friction * (normal_impulse + cohesive * contact_time);
  Friction2 f{-m * c * spring - m * d * w, {}};
  if (together) {
    if (norm(f.impulse) > limit) f.impulse = (limit / norm(f.impulse)) * f.impulse;
  } else { // of a unit of slip the way is minus the rate that a unit of displacement gives, over k/m
    const Vec3 of_dashpot = m * slip.h / slip.k * slip.rate_from_displacement(t) * w;
    const Vec3 of_spring = f.impulse - of_dashpot;
    const double first = m * c * norm(spring);
    const double last = 2.0 * norm(of_spring) - first;
    const double below = last <= limit ? 1.0 : first < limit ? (limit - first) / (last - first) : 0.0;
    f.impulse = std::min(1.0, limit / norm(of_spring)) * of_spring + below * of_dashpot;
  }
  if (contact_time == span) {
    const Vec3 longer = together ? slip.h / slip.k * w : Vec3{};
    const double pull = m * c * norm(spring + longer);
    f.next = (pull > limit ? limit / pull : 1.0) * (spring + longer) - longer + 0.5 * (2.0 * span - dt) * w;
  }
  return f;
}

struct Case {
  double friction;
  double cohesive;
  double spring; ///< [m]
  double slip;   ///< [m/s]
  bool begins;   ///< inside the step
};

/// Sticks; slides by its slip; slides by its spring; and each with cohesion; then a contact that begins.
const std::vector<Case> cases = {{1e3, 0.0, 1e-5, 0.02, false}, {0.3, 0.0, 1e-6, 2.0, false},
                                 {0.3, 0.0, 1e-3, 0.01, false}, {0.3, 5.0, 1e-6, 2.0, false},
                                 {0.3, 5.0, 1e-3, 0.01, false}, {1e3, 0.0, 0.0, 0.02, true},
                                 {0.3, 5.0, 0.0, 2.0, true}};
constexpr double felt = 1.7;
constexpr double mass = 0.02;
constexpr double tangential_mass = mass / 3.5;
constexpr double dt = 1e-3;

/// Compares a contact along z. slip: the swing of its tangent plane.
template <Friction friction = Friction::spring_and_dashpot, class Kind>
void expect_formula(const Kind &kind, const Case &c, const Swing &slip, double tolerance) {
  const double span = c.begins ? 0.6 * dt : dt;
  const Vec3 w{c.slip, 0.5 * c.slip, 0.0};
  const Vec3 spring = c.spring * Vec3{-0.6, 0.8, 0.0};
  const double last_dt = 0.7 * dt;
  double values[3];
  double now[3] = {};
  set(spring - 0.5 * last_dt * w, values);
  const ContactGeometry g{{0.0, 0.0, 1.0}, c.begins ? 0.0 : 1e-4, 0.1, w, 0.01, 0.01, {}};
  const NormalImpulse normal = kind.normal_in_crowd(g.overlap, g.closing_speed, span, felt);
  ASSERT_GT(normal.impulse, 0.0);
  const MeanForce mean =
      mean_force_of_impulse<friction>(kind, normal, g, span, felt, {values, last_dt, true, now}, c.cohesive);
  const Friction2 f = crowded_friction(slip, kind.friction(), normal.impulse, normal.contact_time, c.cohesive, felt,
                                       spring, w, span, dt, friction == Friction::limited_together);
  const Vec3 expected = (1.0 / dt) * (f.impulse + normal.impulse * g.normal);
  EXPECT_LE(norm(mean.force - expected), tolerance * norm(expected)) << c.friction << ' ' << c.spring;
  EXPECT_LE(norm(mean.torque_per_lever - (1.0 / dt) * cross(g.normal, f.impulse)), tolerance * norm(expected));
  EXPECT_EQ(mean.shift, Vec3{}); // positions move by the mean force
  EXPECT_LE(norm(vec3(values) - f.next), tolerance * (norm(f.next) + c.spring + dt * c.slip))
      << c.friction << ' ' << c.spring;
  EXPECT_LE(norm(vec3(now) - spring), 1e-15 * (c.spring + dt * c.slip));
}

TEST(CrowdedImpulse, OfTheLinearContactIsItsFormula) {
  for (const Case &c : cases)
    for (const double ks : {8e3, 4e5}) { // the second swings several times in a step
      const LinearImpulse kind({2e4, 15.0, ks, 3.0, c.friction}, mass, tangential_mass, dt);
      expect_formula(kind, c, {ks, 3.0, tangential_mass}, 1e-13); // some hundred roundings
      expect_formula<Friction::limited_together>(kind, c, {ks, 3.0, tangential_mass}, 1e-13);
    }
}

HertzImpulse hertz(const HertzImpulse::Law &law, double step) {
  const auto response_to = [](const Oscillator &o) {
    return std::make_shared<CrowdResponseTable>(CrowdResponseTable::damping_ratio(o));
  };
  return {law,
          {std::make_shared<HertzTrajectory>(HertzImpulse::alpha(law, mass), law.tension()),
           response_to(HertzImpulse::normal_at(law, mass, 1.0)),
           response_to(HertzImpulse::slip_at(law, tangential_mass, 1.0))},
          mass,
          tangential_mass,
          step};
}

/// Overlap and closing speed of m d'' = -kn d^(3/2) - hn d^(1/4) d' from a state in contact, in many steps; the middle
/// is the mean overlap on the way by the same integrator.
struct Integrated {
  double overlap;
  double mean;
};
Integrated integrated(const HertzImpulse::Law &law, double overlap, double closing_speed, double time) {
  using State = std::array<double, 3>;
  boost::numeric::odeint::runge_kutta4<State> stepper;
  State s{overlap, closing_speed, 0.0};
  constexpr int steps = 4000;
  for (int k = 0; k < steps; ++k)
    stepper.do_step(
        [&](const State &at, State &rate, double) {
          const double root = std::sqrt(std::max(0.0, at[0]));
          rate = {at[1], -(law.normal_stiffness * root * at[0] + law.normal_damping * std::sqrt(root) * at[1]) / mass,
                  at[0]};
        },
        s, 0.0, time / steps);
  return {s[0], s[2] / time};
}

const HertzImpulse::Law hertz_law{3e6, 0.3 * std::sqrt(3e6 * mass), 2e6, 20.0, 0.3};

/// The tangential stiffness is that of the mean overlap: of the beginning and the end of the step, or of the beginning
/// where that is more.
TEST(CrowdedImpulse, OfTheHertzContactIsItsFormula) {
  for (const Case &c : cases) {
    if (c.begins) continue;
    HertzImpulse::Law law = hertz_law;
    law.friction = c.friction;
    const double mean = std::max(1e-4, 0.5 * (1e-4 + integrated(law, 1e-4, 0.1, dt).overlap));
    const LinearLaw at = law.at(mean);
    const Swing slip{at.tangential_stiffness, at.tangential_damping, tangential_mass};
    expect_formula(hertz(law, dt), c, slip, 1e-6); // tables
    expect_formula<Friction::limited_together>(hertz(law, dt), c, slip, 1e-6);
  }
}

/// In steps too short for anything to be softened: of bodies that approach, that come to rest and that part.
TEST(CrowdedImpulse, HoldsTheHertzContactAtLeastWhereItIs) {
  const double overlap = 1e-4;
  for (const auto &[speed, step] : {std::pair(0.3, 3e-4), {0.1, 1e-3}, {-0.05, 1e-3}}) {
    const double end = integrated(hertz_law, overlap, speed, step).overlap;
    const double mean = std::max(overlap, 0.5 * (overlap + end));
    EXPECT_EQ(end > overlap, speed > 0.2);
    EXPECT_NEAR(hertz(hertz_law, step).normal_in_crowd(overlap, speed, step, felt).mean_overlap / mean, 1.0, 1e-8);
  }
}

/// The mean overlap of a contact alone is by Simpson's rule from its beginning, middle and end: its error falls with
/// the fourth power of the span. (Half the span is measured from the same state.)
TEST(HertzImpulse, MeanOverlapIsBySimpsonsRule) {
  const HertzImpulse kind = hertz(hertz_law, dt);
  const auto error = [&](double span) {
    return std::fabs(kind.normal(2e-4, 0.3, span).mean_overlap - integrated(hertz_law, 2e-4, 0.3, span).mean);
  };
  EXPECT_GT(std::log2(error(6e-4) / error(1.5e-4)) / 2.0, 3.5); // rounds to 4
}

TEST(Crowd, CountsTheOthersOfAParticle) {
  const double counts[] = {0.0, 1.0, 4.0};
  const Crowd crowd{counts, 0.5};
  EXPECT_EQ(crowd.others(0, 0.5), 0.0); // not less than none
  EXPECT_EQ(crowd.others(1, 0.5), 0.0);
  EXPECT_EQ(crowd.others(2, 0.5), 6.0);
  EXPECT_EQ(crowd.share(0, 0.5), 0.5);
  EXPECT_EQ(crowd.share(1, 0.5), 0.5);
  EXPECT_EQ(crowd.share(2, 0.5), 0.2); // over 1 + (4 - 1)/2
  const Crowd whole{counts, 0.0};
  EXPECT_EQ(whole.share(2, 0.5), 0.5);
  EXPECT_EQ(whole.others(2, 0.5), 6.0);
  const Crowd nobody{nullptr, 0.5};
  EXPECT_EQ(nobody.share(2, 0.5), 0.5);
  EXPECT_EQ(nobody.others(2, 0.5), 0.0);
}

} // namespace
} // namespace cfpm::testing
