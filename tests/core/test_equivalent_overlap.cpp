// SPDX-License-Identifier: GPL-2.0-or-later
// The overlap that whoever reads a contact is shown: at rest the law has there the mean force that acts.
#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"
#include "core/method/contact_solver.h"
#include "core/method/equivalent_overlap.h"
#include "core/step/equivalent_overlaps.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cfpm {
namespace {

using Hertz = HertzMindlinLaw<DampingExponent::quarter>;

constexpr double mass = 0.02;   // reduced [kg]
constexpr double radius = 0.01; // [m]
constexpr LinearLaw linear{2e4, 10.0, 0.0, 0.0, 0.0};
constexpr Hertz hertz{2e6, 40.0, 0.0, 0.0, 0.0};

struct Seen {
  double overlap; ///< [m]
  double mean;    ///< force [N]
};

/// others: that hold the bodies, see Crowd [1/kg]
template <class Law>
Seen seen(const Law &law, const char *name, double dt, double overlap, double closing_speed, double others = 0.0) {
  ContactSolver<Law> solver([&](const ContactPartners &) { return law; });
  solver.reset(*find_method(name), 3, false);
  const ContactGeometry g{{0.0, 0.0, 1.0}, overlap, closing_speed, {}, radius, radius};
  Seen found{};
  solver.with_method(dt, [&](const auto &method) {
    const auto &parameters = method.parameters(ContactPartners{1, 1, radius, radius, mass});
    const auto normal = method.normal(parameters, g, dt, others);
    found = {equivalent_overlap(method, parameters, normal, g), normal.mean()};
  });
  return found;
}

const double tc = contact_time(linear.normal_stiffness, mass);
constexpr double overlap = 1e-4;

TEST(EquivalentOverlap, CarriesTheMeanForceAtRest) {
  for (const double nt : {1.0, 3.0, 6.0, 30.0})
    for (const double others : {0.0, 60.0})
      for (const char *name : {"exact", "trapezoid", "impulse"}) {
        const Seen s = seen(linear, name, tc / nt, overlap, 0.0, others);
        EXPECT_NEAR(s.overlap, s.mean / linear.normal_stiffness, 1e-15 * overlap * 4.0) << name << nt;
        EXPECT_LT(s.overlap, overlap) << name << nt;
      }
  for (const double nt : {1.0, 3.0, 30.0})
    for (const double others : {0.0, 60.0})
      for (const char *name : {"exact", "rk2", "impulse"}) {
        const Seen s = seen(hertz, name, tc / nt, overlap, 0.0, others);
        // a cube root and a square, each within an ulp, then the power of it: a few ulp
        EXPECT_NEAR(hertz.normal_stiffness * std::pow(s.overlap, 1.5), s.mean, 1e-14 * hertz.normal_stiffness * 1e-6)
            << name << nt;
      }
}

/// F differs from f by dt f'/2 at most, and f' = k u + h u'.
TEST(EquivalentOverlap, TendsToTheOverlap) {
  for (const char *name : {"exact", "impulse"})
    for (const double speed : {0.2, -0.1})
      for (const double dt : {1e-3 * tc, 1e-5 * tc}) {
        const double force = linear.normal_force(overlap, speed);
        const double change = std::fabs(linear.normal_stiffness * speed - linear.normal_damping * force / mass);
        const double relative = 0.5 * dt * change / force;
        EXPECT_NEAR(seen(linear, name, dt, overlap, speed).overlap, overlap, 1.1 * relative * overlap) << name << dt;
      }
}

/// While bodies approach, the mean force is that of an overlap that they come to.
TEST(EquivalentOverlap, IsReachedInTheStep) {
  for (const char *name : {"exact", "impulse"})
    for (const double speed : {0.01, 0.1, 1.0}) {
      const double dt = tc / 30.0;
      const double found = seen(linear, name, dt, overlap, speed).overlap;
      EXPECT_LT(found, overlap + 0.5 * speed * dt) << name << speed;
      EXPECT_EQ(found > overlap, speed > 0.05) << name << speed;
    }
}

TEST(EquivalentOverlap, StaysWhereTheLawDoesNotPush) {
  EXPECT_EQ(seen(linear, "exact", tc, overlap, -1.0).overlap, overlap);
  EXPECT_EQ(seen(linear, "impulse", tc, overlap, -1.0).overlap, overlap);
}

/// The same of a list: pairs that overlap, in its order, with the contacts of the step before.
TEST(EquivalentOverlap, OfAListOfPairs) {
  const double dt = tc / 3.0;
  double x[15] = {};
  x[3] = 2.0 * radius - overlap;
  x[6] = 4.1 * radius;
  x[9] = 6.1 * radius - overlap;
  x[12] = 6.1 * radius;
  x[13] = 2.0 * radius; // touches nobody, but is listed
  double still[15] = {};
  double radii[5] = {radius, radius, radius, radius, radius};
  double masses[5] = {2.0 * mass, 2.0 * mass, 2.0 * mass, 2.0 * mass, 2.0 * mass};
  int types[5] = {1, 1, 1, 1, 1};
  int groups[5] = {};
  Particles particles;
  particles.x = VectorRows(x);
  particles.v = particles.omega = VectorRows(still);
  particles.radius = radii;
  particles.mass = masses;
  particles.type = types;
  particles.group = groups;
  int first[3] = {0, 2, 3};
  int of_0[1] = {1}, of_2[1] = {3}, of_3[1] = {4};
  int *neighbors[5] = {of_0, nullptr, of_2, of_3, nullptr};
  int neighbor_counts[5] = {1, 0, 1, 1, 0};
  PairList pairs{};
  pairs.count = 3;
  pairs.first = first;
  pairs.neighbors = neighbors;
  pairs.neighbor_count = neighbor_counts;
  pairs.index_mask = 7;
  const double contacts[5] = {1.0, 1.0, 1.0, 3.0, 0.0};
  StepState step;
  step.begin(dt, 5, nullptr, 0);
  step.crowd = {contacts, 0.0};
  ContactSolver<LinearLaw> solver([](const ContactPartners &) { return linear; });
  for (const char *name : {"exact", "impulse"}) {
    solver.reset(*find_method(name), 3, false);
    std::vector<PairOverlap> found;
    solver.with_method(dt, [&](const auto &method) { found = equivalent_overlaps(particles, pairs, step, method); });
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(found[0].i == 0 && found[0].j == 1 && found[1].i == 2 && found[1].j == 3);
    const double d = 2.0 * radius - (x[3] - x[0]); // as rounded
    EXPECT_EQ(found[0].overlap, seen(linear, name, dt, d, 0.0).overlap);
    const double e = 2.0 * radius - (x[9] - x[6]);
    EXPECT_EQ(found[1].overlap, seen(linear, name, dt, e, 0.0, 2.0 / masses[3]).overlap);
  }
}

} // namespace
} // namespace cfpm
