// SPDX-License-Identifier: GPL-2.0-or-later
// The step of a sphere, with numbers that do not round.
#include "core/contact/inertia.h"
#include "core/step/move_sphere.h"

#include <gtest/gtest.h>

namespace cfpm::testing {
namespace {

struct Sphere {
  double x[3] = {1.0, 2.0, 3.0};
  double v[3] = {4.0, 0.0, -4.0};
  double omega[3] = {0.0, 8.0, 0.0};
};

constexpr double mass = 2.0;
constexpr double radius = 0.5;
constexpr double dt = 0.5;
constexpr double f[] = {16.0, 0.0, -8.0};
constexpr double torque[] = {1.0, -0.5, 0.0};

TEST(SphereStep, MovesByTheTrapezoidOfTheVelocities) {
  Sphere s;
  move_sphere(dt, mass, radius, 0.5, f, torque, nullptr, s.x, s.v, s.omega);
  const double v[] = {8.0, 0.0, -6.0};                               // v + dt f/m
  const double x[] = {1.0 + 0.5 * 6.0, 2.0, 3.0 + 0.5 * -5.0};       // x + dt (v + v')/2
  const double omega[] = {0.0 + 0.5 / 0.25, 8.0 - 0.25 / 0.25, 0.0}; // I = m r^2/2 = 1/4
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(s.v[k], v[k]);
    EXPECT_EQ(s.x[k], x[k]);
    EXPECT_EQ(s.omega[k], omega[k]);
  }
}

TEST(SphereStep, ShiftMovesTheSphereAndNothingElse) {
  Sphere s;
  Sphere plain;
  const double shift[] = {4.0, -2.0, 1.0};
  move_sphere(dt, mass, radius, 0.5, f, torque, shift, s.x, s.v, s.omega);
  move_sphere(dt, mass, radius, 0.5, f, torque, nullptr, plain.x, plain.v, plain.omega);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(s.x[k], plain.x[k] + shift[k] / mass);
    EXPECT_EQ(s.v[k], plain.v[k]);
    EXPECT_EQ(s.omega[k], plain.omega[k]);
  }
}

TEST(SphereStep, InertiaIsThatOfASolidSphereOrADisc) {
  EXPECT_EQ(inertia_factor(3), 0.4);
  EXPECT_EQ(inertia_factor(2), 0.5);
  EXPECT_DOUBLE_EQ(tangential_reduced_mass(7.0, 3), 2.0); // 1/mt = (1 + 5/2)/m*
  EXPECT_DOUBLE_EQ(tangential_reduced_mass(6.0, 2), 2.0); // 1/mt = (1 + 2)/m*
}

} // namespace
} // namespace cfpm::testing
