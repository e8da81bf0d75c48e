// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of the paper's predictors that begin and end inside a step, "onset on": what is predicted over a part of a
// step, what the mean over the step makes of it, and what becomes of a collision.
#include "core/contact/inertia.h"
#include "core/method/contact_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace cfpm::testing {
namespace {

using HertzLaw = HertzImpulse::Law;

constexpr double mass = 0.02;
constexpr double omega = 40.0;
constexpr double kn = mass * omega * omega;
constexpr double dt = 0.3 / omega;

LinearLaw linear(double damping_ratio, double least_force) {
  const double hn = 2.0 * damping_ratio * mass * omega;
  return {kn, hn, 0.4 * kn, 0.3 * hn, 0.25, least_force};
}

LinearPrediction prediction_of(const LinearLaw &law, double step) {
  return {law, mass, tangential_reduced_mass(mass, 3), *find_predictor("exact"), step};
}

/// Over the whole step what the paper's method predicts, over a part of it what it would predict with such a step.
TEST(WhileTouching, PredictsForTheEndOfASpan) {
  const LinearLaw law = linear(0.2, without_tension);
  for (const double span : {dt, 0.4 * dt}) {
    const PredictedTouch touch = prediction_of(law, dt).while_touching(2e-4, 0.3, span);
    const PredictedLaw whole = prediction_of(law, span).at(2e-4, 0.3);
    EXPECT_EQ(touch.contact_time, span);
    EXPECT_EQ(touch.law.dt, span);
    EXPECT_EQ(touch.law.predicted_normal_force, whole.predicted_normal_force);
    EXPECT_EQ(touch.law.predicted_tangential_stiffness, whole.predicted_tangential_stiffness);
    EXPECT_EQ(touch.law.predicted_tangential_damping, whole.predicted_tangential_damping);
  }
}

/// With tension a contact ends where the bodies part, and there the dashpot alone pulls.
TEST(WhileTouching, EndsWhereTheBodiesPart) {
  const LinearLaw law = linear(0.2, with_tension);
  const Oscillator o{law.normal_stiffness, law.normal_damping, mass};
  const double speed = -0.3;
  const double overlap = 0.5 * dt * -speed; // gone after about half a step
  const OscillatorState end = exact_flow(o, dt)({overlap, speed});
  ASSERT_LT(end.displacement, 0.0);
  const PredictedTouch touch = prediction_of(law, dt).while_touching(overlap, speed, dt);
  const double part = overlap / (overlap - end.displacement);
  EXPECT_NEAR(touch.contact_time, part * dt, 1e-14 * dt);
  const double pull = law.normal_damping * ((1.0 - part) * speed + part * end.rate);
  EXPECT_NEAR(touch.law.predicted_normal_force, pull, 1e-12 * std::fabs(pull));
  // along the exact motion the bodies part there to second order: the overlap bends by half of the acceleration
  const double left = exact_flow(o, touch.contact_time)({overlap, speed}).displacement;
  const double acceleration = o.force(overlap, speed) / mass;
  EXPECT_LT(std::fabs(left), 0.125 * dt * dt * std::max(acceleration, o.force(end.displacement, end.rate) / -mass));
}

/// A Hertz contact too, which has no force where its overlap vanishes; that of the exact solution knows when it does.
TEST(WhileTouching, EndsWhereHertzBodiesPart) {
  const HertzLaw law{4e5, 3.0, 2e5, 1.0, 0.3, with_tension};
  const double speed = -0.3;
  const double overlap = 1e-5;
  const double step = 2.0 * overlap / -speed;
  const IntegratedPrediction integrated(law, mass, tangential_reduced_mass(mass, 3), step);
  const PredictedTouch rk4 = integrated.while_touching<RungeKutta4>(overlap, speed, step);
  EXPECT_EQ(rk4.law.predicted_normal_force, 0.0);
  EXPECT_NEAR(rk4.contact_time, 0.5 * step, 0.02 * step); // the speed changes by about as little
  const HertzPrediction exact(law, std::make_shared<HertzTrajectory>(HertzImpulse::alpha(law, mass), true), mass,
                              tangential_reduced_mass(mass, 3), step);
  const PredictedTouch known = exact.while_touching(overlap, speed, step);
  EXPECT_EQ(known.law.predicted_normal_force, 0.0);
  EXPECT_EQ(known.contact_time, exact.step().motion.fly(overlap, fourth_root(overlap), speed, step).contact_time);
  EXPECT_NEAR(rk4.contact_time, known.contact_time, 0.01 * step);
}

/// Where its force vanishes without tension they still overlap, and by the end of the step would pull.
TEST(WhileTouching, EndsWhereTheForceOfHertzDoes) {
  const HertzLaw law{4e5, 30.0, 0.0, 0.0, 0.3, without_tension};
  const double overlap = 5e-4;
  const double speed = -0.1;
  const double step = 2e-3;
  const HertzPrediction exact(law, std::make_shared<HertzTrajectory>(HertzImpulse::alpha(law, mass), false), mass,
                              tangential_reduced_mass(mass, 3), step);
  const BasicHertzFlight<double> end = exact.step().motion.fly(overlap, fourth_root(overlap), speed, step);
  ASSERT_LT(end.contact_time, step);
  ASSERT_GT(end.overlap, 0.0);
  ASSERT_LT(exact.at(overlap, speed).predicted_normal_force, 0.0);
  const PredictedTouch touch = exact.while_touching(overlap, speed, step);
  EXPECT_EQ(touch.law.predicted_normal_force, 0.0);
  EXPECT_EQ(touch.contact_time, end.contact_time);
}

/// Calls use() with the method, for the linear law.
template <class Use> void with(const char *predictor, const LinearLaw &law, double step, bool inside, const Use &use) {
  ContactSolver<LinearLaw> solver([&](const ContactPartners &) { return law; });
  solver.reset(*find_method(predictor), 3, inside);
  solver.with_method(step, use);
}

const ContactPartners partners_of_mass{1, 1, 0.01, 0.01, mass};

ContactGeometry geometry(double overlap, double closing_speed, const Vec3 &slip_velocity) {
  ContactGeometry g{};
  g.normal = {0.0, 0.0, 1.0};
  g.overlap = overlap;
  g.closing_speed = closing_speed;
  g.slip_velocity = slip_velocity;
  return g;
}

/// The means over the step are those over the span times the span over the step, of friction as well; a spring that
/// has slipped over the span leads by the half of a step that it always does.
TEST(MeanWhileTouching, ActsFromTheTouchOn) {
  const LinearLaw law = linear(0.2, without_tension);
  const double span = 0.4 * dt;
  const Vec3 slip{0.01, -0.02, 0.0};
  const ContactGeometry g = geometry(0.0, 0.3, slip);
  with("exact", law, dt, true, [&](const auto &method) {
    const auto &parameters = method.parameters(partners_of_mass);
    const auto normal = method.normal(parameters, g, span, 0.0);
    const PredictedLaw end = prediction_of(law, span).at(0.0, 0.3);
    const double mean = 0.4 * 0.5 * (law.normal_damping * 0.3 + end.predicted_normal_force);
    EXPECT_NEAR(normal.mean(), mean, 1e-14 * mean);
    EXPECT_TRUE(normal.in_contact());
    double spring[3] = {};
    const MeanForce force =
        method.template mean_force<Friction::spring_and_dashpot>(parameters, normal, g, span, {spring, dt, true}, 0.0);
    const Vec3 friction = (-0.4 * 0.5 * (law.tangential_damping + end.predicted_tangential_damping)) * slip;
    EXPECT_LT(norm(force.force - (mean * g.normal + friction)), 1e-14 * mean);
    EXPECT_LT(norm(force.torque_per_lever - cross(g.normal, friction)), 1e-14 * mean);
    EXPECT_EQ(force.shift, Vec3{});
    MidStepSpring next(vec3(spring), dt);
    EXPECT_LT(norm(next.advance(law, slip, g.normal, 1e9) - span * slip), 1e-15 * norm(slip) * dt);
  });
}

/// Eq. 39: without tension the force acts until it vanishes.
TEST(MeanWhileTouching, ActsUntilTheForceVanishes) {
  const LinearLaw law = linear(0.2, without_tension);
  const ContactGeometry g = geometry(1.8e-3, -0.15, {});
  const double force = law.normal_force(g.overlap, g.closing_speed);
  const double end = prediction_of(law, dt).at(g.overlap, g.closing_speed).predicted_normal_force;
  ASSERT_GT(force, 0.0);
  ASSERT_LT(end, 0.0);
  with("exact", law, dt, true, [&](const auto &method) {
    const auto normal = method.normal(method.parameters(partners_of_mass), g, dt, 0.0);
    EXPECT_NEAR(normal.mean(), 0.5 * force * force / (force - end), 1e-14 * force);
  });
}

/// The speed after a collision at speed 1 with that phase: a part of a step passes before the touch.
template <class M> double rebound(const M &method, double step, bool inside, double phase) {
  const auto &parameters = method.parameters(partners_of_mass);
  double d = -phase * step;
  double u = 1.0;
  for (int n = 0; n < 3.5 / omega / step + 4.0; ++n) { // a contact lasts pi/omega, a damped one not much longer
    double mean = 0.0;
    const double wait = d < 0.0 && u > 0.0 ? -d / u : 0.0;
    if (d > 0.0)
      mean = method.normal(parameters, geometry(d, u, {}), step, 0.0).mean();
    else if (inside && u > 0.0 && wait < step)
      mean = method.normal(parameters, geometry(0.0, u, {}), step - wait, 0.0).mean();
    const double next = u - step * mean / mass;
    d += 0.5 * step * (u + next);
    u = next;
  }
  return -u;
}

/// Mean over all phases of use(speed after the collision).
template <class Use>
double mean_over_phases(const char *predictor, const LinearLaw &law, double step, bool inside, const Use &use) {
  constexpr int phases = 200;
  double sum = 0.0;
  with(predictor, law, step, inside, [&](const auto &method) {
    for (int k = 0; k < phases; ++k) sum += use(rebound(method, step, inside, (k + 0.5) / phases));
  });
  return sum / phases;
}

/// Without damping a late contact adds, over m u^2/2, on the average theta^2/3 where it is found and theta^2/6 where
/// it is left, theta = omega dt; a contact that begins and ends inside the step neither. What is left is that of the
/// whole steps, theta^3 pi/24 in a collision with exact and rk4, and of third order too where they begin and end.
TEST(MeanWhileTouching, AddsNoEnergyOfSecondOrder) {
  const LinearLaw law = linear(0.0, with_tension);
  for (const char *const predictor : {"exact", "trapezoid", "rk2", "rk4"})
    for (const double theta : {0.05, 0.1}) {
      const auto gain = [&](bool inside) {
        return mean_over_phases(predictor, law, theta / omega, inside, [](double v) { return v * v - 1.0; });
      };
      EXPECT_NEAR(gain(false), 0.5 * theta * theta, theta * theta * theta) << predictor << theta;
      EXPECT_LT(std::fabs(gain(true)), 0.5 * theta * theta * theta) << predictor << theta;
    }
}

/// With a dashpot, whose force jumps at the touch and with tension where the bodies part, late contacts are of first
/// order in the time step: half of the step gives half of the error. From the touch on and until they part: a quarter.
TEST(MeanWhileTouching, IsOfSecondOrderInCollisions) {
  for (const double least_force : {without_tension, with_tension})
    for (const char *const predictor : {"exact", "trapezoid", "rk2", "rk4"}) {
      const LinearLaw law = linear(0.2, least_force);
      const double e = LinearRelease({law.normal_stiffness, law.normal_damping, mass}, law.tension()).restitution();
      const auto rms = [&](double theta, bool inside) {
        return std::sqrt(
            mean_over_phases(predictor, law, theta / omega, inside, [e](double v) { return (v - e) * (v - e); }));
      };
      const double late = rms(0.1, false) / rms(0.05, false);
      const double inside = rms(0.1, true) / rms(0.05, true);
      EXPECT_NEAR(late, 2.0, 0.5) << predictor;
      EXPECT_NEAR(inside, 4.0, 0.5) << predictor;
      EXPECT_LT(rms(0.1, true), 0.1 * rms(0.1, false)) << predictor;
    }
}

} // namespace
} // namespace cfpm::testing
