// SPDX-License-Identifier: GPL-2.0-or-later
// When a contact begins inside a step, and what a wall does to a sphere, without a host.
#include "core/contact/inertia.h"
#include "core/method/contact_solver.h"
#include "core/step/add_wall_forces.h"
#include "core/step/touch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cfpm {
namespace {

constexpr double radius = 0.01;
constexpr double dt = 1e-3;
const Vec3 up{0.0, 0.0, 1.0};

TEST(TouchWall, OfASphereThatOverlapsLastsTheWholeStep) {
  const auto touch = touch_wall(up, 0.009, radius, {{0.1, 0.0, -0.2}, {}}, {}, dt);
  ASSERT_TRUE(touch);
  EXPECT_EQ(touch->span, dt);
  EXPECT_NEAR(touch->geometry.overlap, 0.001, 1e-17);
  EXPECT_EQ(touch->geometry.closing_speed, 0.2);
}

/// A gap of 0.1 mm at 0.2 m/s against a wall that comes at 0.3 m/s: after a fifth of the step.
TEST(TouchWall, BeginsWhereTheGapIsClosed) {
  const auto touch = touch_wall(up, radius + 1e-4, radius, {{0.1, 0.0, -0.2}, {}}, {0.0, 0.0, 0.3}, dt);
  ASSERT_TRUE(touch);
  EXPECT_NEAR(touch->span, 0.8 * dt, 1e-15);
  EXPECT_EQ(touch->geometry.overlap, 0.0);
  EXPECT_EQ(touch->geometry.slip_velocity.x, 0.1);
}

TEST(TouchWall, IsNoneWithoutOneInThisStep) {
  EXPECT_FALSE(touch_wall(up, radius + 1e-4, radius, {{0.0, 0.0, -0.05}, {}}, {}, dt));
  EXPECT_FALSE(touch_wall(up, radius + 1e-4, radius, {{0.0, 0.0, 0.2}, {}}, {}, dt));
}

TEST(MoveToTouch, LeavesSpheresThatDoNotMeet) {
  Meeting away{{0.03, 0.0, 0.0}, 9e-4, dt};
  EXPECT_FALSE(move_to_touch(away, {-1.0, 0.0, 0.0}, 0.02));
  EXPECT_EQ(away.separation.x, 0.03);
  EXPECT_EQ(away.span, dt);
  Meeting meets{{0.03, 0.0, 0.0}, 9e-4, dt};
  ASSERT_TRUE(move_to_touch(meets, {-20.0, 0.0, 0.0}, 0.02));
  EXPECT_NEAR(meets.separation.x, 0.02, 1e-17);
  EXPECT_NEAR(meets.span, 0.5 * dt, 1e-17);
}

/// The paper's step at a wall by hand: a sphere without spin and friction, force now and predicted.
TEST(AddWallForces, AddsTheMeanForceAndCounts) {
  const LinearLaw law{2e4, 15.0, 0.0, 0.0, 0.0};
  const double mass = 0.02;
  ContactSolver<LinearLaw> solver([&](const ContactPartners &) { return law; });
  solver.reset(*find_method("exact"), 3, false);
  double f[3] = {1.0, 0.0, 0.0};
  double torque[3] = {};
  double counts[1] = {};
  Particles particles;
  particles.f = VectorRows(f);
  particles.torque = VectorRows(torque);
  StepState step;
  step.begin(dt, 1, nullptr, 0);
  step.contact_counts = counts;
  double contact_force[3] = {};
  step.contact_force = VectorRows(contact_force);
  double spring[3] = {};
  const auto touch = touch_wall(up, 0.0099, radius, {{0.0, 0.0, -0.3}, {}}, {}, dt);
  const std::vector<WallContact> contacts{
      {0, {1, 0, radius, 0.0, mass}, {touch->geometry, touch->span, 0.0, {spring, dt, true}}}};
  solver.with_method(dt, [&](const auto &method) {
    add_wall_forces<Friction::spring_and_dashpot>(contacts, particles, step, method);
  });
  const Oscillator o{law.normal_stiffness, law.normal_damping, mass};
  const OscillatorState end = exact_flow(o, dt)({1e-4, 0.3});
  EXPECT_EQ(f[0], 1.0);
  EXPECT_NEAR(f[2], 0.5 * (o.force(1e-4, 0.3) + o.force(end.displacement, end.rate)), 1e-12);
  EXPECT_EQ(counts[0], 1.0);
  EXPECT_EQ(contact_force[2], f[2]); // of what else acts nothing
  EXPECT_EQ(contact_force[0], 0.0);
  EXPECT_EQ(step.evaluations, 1);
}

/// What a step leaves to the next: counts become those of the step before unless a state is evaluated again.
TEST(StepState, CountsOfTheStepBefore) {
  double v[6] = {3.0, 0.0, 4.0, 0.0, 0.0, 0.0};
  double *rows[2] = {v, v + 3};
  double counts[2] = {2.0, 5.0};
  double before[2] = {7.0, 7.0};
  StepState step;
  step.prepare(true, true, 0.5);
  step.begin(dt, 1, rows, 2);
  const auto to_neighbours = [&] { before[1] = before[0]; };
  step.begin_impulses(2, counts, before, false, to_neighbours);
  EXPECT_EQ(before[0], 2.0);
  EXPECT_EQ(before[1], 2.0);
  EXPECT_EQ(counts[0], 0.0);
  EXPECT_EQ(counts[1], 0.0);
  EXPECT_EQ(step.ahead, 2.0 * dt * 5.0);
  EXPECT_EQ(step.shift[1][2], 0.0);
  counts[0] = 4.0;
  step.begin_impulses(2, counts, before, true, to_neighbours);
  EXPECT_EQ(before[0], 2.0);
  step.prepare(true, false, 0.0);
  step.begin(dt, 1, rows, 2);
  EXPECT_EQ(step.ahead, 0.0);
}

/// A load that a single contact carries counts as a second one: from half of its force on, if it is not new.
TEST(StepState, CountsALoad) {
  double v[3] = {};
  double *rows[1] = {v};
  const double pushed[3] = {0.0, 0.3, 4.0};
  double pushes[3] = {pushed[0], pushed[1], pushed[2]};
  double *forces[1] = {pushes};
  const auto count_after = [&](double contacts_before, double contacts, const Vec3 &load) {
    StepState step;
    step.prepare(true, true, 0.0);
    step.begin(dt, 1, rows, 1);
    double counts[2] = {contacts_before}; // two, as g++ 14 takes a copy of one number for one of more
    double before[2] = {};
    step.begin_impulses(1, counts, before, false, [] {});
    counts[0] = contacts;
    step.take_pair_forces(forces, 1);
    const double all[3] = {pushed[0] + load.x, pushed[1] + load.y, pushed[2] + load.z};
    step.count_load(0, all);
    return counts[0];
  };
  const double half = 0.5 * (0.3 * 0.3 + 4.0 * 4.0) / 4.0; // of the contact's force along itself
  EXPECT_EQ(count_after(1.0, 1.0, {0.0, 0.0, -1.001 * half}), 2.0);
  EXPECT_EQ(count_after(2.0, 1.0, {0.0, 0.0, -1.001 * half}), 2.0); // counted already in the step before
  EXPECT_EQ(count_after(1.0, 1.0, {0.0, 0.0, -0.999 * half}), 1.0);
  EXPECT_EQ(count_after(1.0, 1.0, {0.0, 0.0, 9.0}), 1.0);
  EXPECT_EQ(count_after(1.0, 1.0, {50.0, 0.0, 0.0}), 1.0); // across it
  EXPECT_EQ(count_after(0.0, 1.0, {0.0, 0.0, -4.0}), 1.0);
  EXPECT_EQ(count_after(1.0, 3.0, {0.0, 0.0, -4.0}), 3.0);
  EXPECT_EQ(count_after(1.0, 0.0, {0.0, 0.0, -4.0}), 0.0);
}

} // namespace
} // namespace cfpm
