// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of one instant of LAMMPS' granular with all its sub-models, in closed form; the bits of the host's own style,
// in packs of any width, are compared in tests/lammps/test_granular.py.
#include "core/method/conventional/force_of_instant.h"
#include "core/method/conventional/granular_sub_models.h"
#include "instant_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

namespace cfpm::testing {
namespace {

constexpr double kn = 1e7; // [N/m^2]
constexpr double gn = 3.0; // [kg/s]
constexpr double kt = 6e6; // [N/m^2]
constexpr double gt = 1.0; // [kg/s]
constexpr double mu = 0.5; // [-]
const double push = kn * area_radius * overlap + gn * closing;

void expect_near(double found, double expected) { EXPECT_NEAR(found, expected, rounding * std::fabs(expected)); }

/// What one contact keeps.
struct Kept {
  Vec3 spring{}, rolled{};
  double area = 0.0, turned = 0.0;
};
struct OneNumber {
  double *stored;
  double load() const { return *stored; }
  void store(double number) const { *stored = number; }
};
struct Springs : OneSpring {
  Kept *kept;
  OneNumber area() const { return {&kept->area}; }
  OneSpring rolling() const { return {&kept->rolled}; }
  OneNumber twist() const { return {&kept->turned}; }
};

/// i to the right of j, coming nearer, passing upwards and turning about the normal.
BasicSpherePair<double> meeting(double passing, double twisting = 0.0) {
  return {{distance, 0.0, 0.0},
          distance * distance,
          radius_i,
          radius_j,
          {{-closing, passing, 0.0}, {twisting, 0.0, 0.0}},
          {{}, {}}};
}

template <GranularOrder order, Friction kind = Friction::spring_and_dashpot> BasicTurningPairForce<double>
act(const GranularSubModels<double> &sub_models, const BasicSpherePair<double> &pair, Kept &kept) {
  const double area_stiffness = sub_models.springless > 0.0 ? 0.0 : kt;
  const TurnedSpringWithSubModels<order, double> law{
      {{0.0, kn, gn, 0.0, 0.0, 0.0, 0.0, area_stiffness, gt / gn, mu, with_tension}, reduced_radius, 1e-3, dt},
      sub_models};
  return PackedForceOfInstant::act<kind>(law, pair, Springs{{&kept.spring}, &kept});
}

/// check(order): of a type whose value is the order.
template <class Check> void in_every_order(const Check &check) {
  check(std::integral_constant<GranularOrder, GranularOrder::of_2021>{});
  check(std::integral_constant<GranularOrder, GranularOrder::of_2025>{});
  check(std::integral_constant<GranularOrder, GranularOrder::of_2026>{});
}

/// mindlin/force: what was slipped before has the force of then, and the slip of the step that of now.
TEST(GranularSubModels, AKeptForceMovesOnByTheStiffnessOfNow) {
  const double slip = 0.1;
  GranularSubModels<double> of_force{};
  of_force.keeps_force = 1.0;
  in_every_order([&](auto order) {
    Kept kept{{0.0, -0.2, 0.0}};
    const auto found = act<order()>(of_force, meeting(slip), kept);
    expect_near(kept.spring.y, -0.2 - kt * area_radius * slip * dt);
    expect_near(found.pair.mean.force.y, kept.spring.y - gt * slip);
    expect_near(found.pair.mean.force.x, push);
    kept.spring.y = -10.0 * push; // beyond the limit: so that spring and dashpot are at it
    expect_near(act<order()>(of_force, meeting(slip), kept).pair.mean.force.y, -mu * push);
    expect_near(kept.spring.y, -mu * push + gt * slip);
  });
}

/// By less than 1e-10 of Coulomb's limit it is left out of the tangent plane, else turned into it.
TEST(GranularSubModels, AKeptForceIsTurnedByItsSize) {
  GranularSubModels<double> of_force{};
  of_force.keeps_force = 1.0;
  for (const double part : {0.9, 1.1}) {
    Kept kept{{part * 1e-10 * mu * push, -0.2, 0.0}};
    act<GranularOrder::of_2021>(of_force, meeting(0.0), kept);
    EXPECT_EQ(kept.spring.x != 0.0, part < 1.0);
  }
}

TEST(GranularSubModels, ASpringShrinksWithTheAreaAndDoesNotGrowWithIt) {
  GranularSubModels<double> rescaled{};
  rescaled.rescales = 1.0;
  in_every_order([&](auto order) {
    for (const double before : {2.0, 0.5}) {
      Kept kept{{0.0, 3e-6, 0.0}, {}, before * area_radius};
      const auto found = act<order()>(rescaled, meeting(0.0), kept);
      expect_near(kept.spring.y, before > 1.0 ? 1.5e-6 : 3e-6);
      expect_near(found.pair.mean.force.y, -kt * area_radius * kept.spring.y);
      expect_near(kept.area, area_radius);
    }
    // of a pair without, in a deck where others have it
    Kept kept{{0.0, 3e-6, 0.0}, {}, 2.0 * area_radius};
    act<order()>({}, meeting(0.0), kept);
    EXPECT_EQ(kept.spring.y, 3e-6);
    EXPECT_EQ(kept.area, 2.0 * area_radius);
  });
}

TEST(GranularSubModels, TwistingIsASpringWithALimit) {
  const double k = 2.0;
  const double g = 1e-3;
  const double lever = 1e-3;
  GranularSubModels<double> sds{};
  sds.twists = 1.0;
  sds.twisting_stiffness = k;
  sds.twisting_damping = g;
  sds.twisting_friction = lever;
  in_every_order([&](auto order) {
    for (const double rate : {0.3, -0.3}) {
      Kept kept{{}, {}, 0.0, 1e-5};
      const auto found = act<order()>(sds, meeting(0.0, rate), kept);
      expect_near(kept.turned, 1e-5 + rate * dt);
      expect_near(found.twisting.x, -(k * kept.turned + g * rate));
      EXPECT_EQ(found.twisting.y, 0.0);
      kept.turned = 1.0; // against the rate, whatever the spring says
      const double sign = rate < 0.0 ? -1.0 : 1.0;
      expect_near(act<order()>(sds, meeting(0.0, rate), kept).twisting.x, -sign * lever * push);
      expect_near(kept.turned, (sign * lever * push - g * rate) / k);
    }
    Kept kept{{}, {}, 0.0, 1e-5};
    EXPECT_EQ(act<order()>({}, meeting(0.0, 0.3), kept).twisting.x, 0.0);
    EXPECT_EQ(kept.turned, 1e-5);
  });
}

/// What slips at a distance from the normal up to the radius of the area; since 2023 by the stiffness over that radius.
TEST(GranularSubModels, TwistingByTheAreaGoesWithFriction) {
  const double rate = 0.3;
  const double area = area_radius * area_radius;
  GranularSubModels<double> marshall{};
  marshall.twists = marshall.twists_by_area = 1.0;
  in_every_order([&](auto order) {
    const double k = 0.5 * kt * area * (order() == GranularOrder::of_2021 ? area_radius : 1.0);
    Kept kept{{}, {}, 0.0, 1e-4};
    const auto found = act<order()>(marshall, meeting(0.0, rate), kept);
    expect_near(found.twisting.x, -(k * (1e-4 + rate * dt) + 0.5 * gt * area * rate));
    kept.turned = 1e3;
    expect_near(act<order()>(marshall, meeting(0.0, rate), kept).twisting.x, -2.0 / 3.0 * area_radius * mu * push);
  });
}

/// The pull acts; limits count what presses the bodies together without the dashpot.
TEST(GranularSubModels, AdhesionPullsAndPresses) {
  const double pull = 0.3 * reduced_radius;
  const double spring = kn * area_radius * overlap;
  GranularSubModels<double> dmt{};
  dmt.adheres = 1.0;
  dmt.pull_of_radius = 0.3;
  in_every_order([&](auto order) {
    Kept kept{{0.0, 1.0, 0.0}};
    const auto found = act<order()>(dmt, meeting(0.0), kept);
    expect_near(found.pair.mean.force.x, push - pull);
    expect_near(found.pair.mean.force.y, -mu * (spring + pull));
  });
}

/// Among pairs that have one; in 2021 such a pair has no friction where it slides.
TEST(GranularSubModels, WithoutASpringFrictionIsThatOfTheDashpot) {
  GranularSubModels<double> none{};
  none.springless = none.keeps_force = 1.0;
  in_every_order([&](auto order) {
    Kept kept;
    expect_near(act<order()>(none, meeting(0.1), kept).pair.mean.force.y, -gt * 0.1);
    const double sliding = act<order()>(none, meeting(100.0), kept).pair.mean.force.y;
    expect_near(sliding, order() == GranularOrder::of_2021 ? 0.0 : -mu * push);
    EXPECT_TRUE(kept.spring == Vec3{});
    const auto alone = act<order(), Friction::dashpot>(none, meeting(100.0), kept);
    expect_near(alone.pair.mean.force.y, -mu * push);
  });
}

} // namespace
} // namespace cfpm::testing
