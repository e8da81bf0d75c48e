// SPDX-License-Identifier: GPL-2.0-or-later
// Whether lists hold what particles can meet in the coming step.

#include "core/step/foresight.h"

#include <gtest/gtest.h>

#include <limits>

namespace cfpm {
namespace {

constexpr double dt = 0.5;
constexpr double radii[2] = {1.0, 1.0};

/// Two particles, of which the second does not move unless told.
struct Two {
  double x[6] = {0.0, 0.0, 0.0, 10.0, 0.0, 0.0};
  double v[6] = {};
  double *places[2] = {x, x + 3};
  double *velocities[2] = {v, v + 3};
  Foresight foresight;

  Two() { foresight.list(places, 2); }
  Foresight::Look look(double reach) {
    return foresight.look(places, velocities, radii, 2, dt, [reach](int) { return reach; });
  }
};

TEST(Foresight, ListsLastAsLongAsTheyReach) {
  Two two;
  two.v[1] = 2.0; // 1 in a step
  EXPECT_EQ(two.look(1.0).outdated, 0);
  two.x[1] = 0.25;
  EXPECT_EQ(two.look(1.25).outdated, 0);
  EXPECT_EQ(two.look(1.2).outdated, 1);
  EXPECT_EQ(two.look(1.2).too_long, 0); // new lists will do
  two.foresight.list(two.places, 2);
  EXPECT_EQ(two.look(1.2).outdated, 0);
  EXPECT_EQ(two.foresight.take_long_moves().count, 0);
}

/// The way that is left and the way that has been made may point anywhere: their lengths are added.
TEST(Foresight, AddsLengths) {
  Two two;
  two.x[0] = 0.6;
  two.v[1] = 1.0;
  EXPECT_EQ(two.look(1.1).outdated, 0);
  EXPECT_EQ(two.look(1.0).outdated, 1); // the distance from where it was listed would be 0.78
}

TEST(Foresight, CountsMovesThatNewListsDoNotReach) {
  Two two;
  two.v[0] = 1.0;  // 0.5 in a step
  two.v[3] = -2.5; // 1.25, more than its radius
  const Foresight::Look look = two.look(0.25);
  EXPECT_EQ(look.outdated, 1);
  EXPECT_EQ(look.too_long, 1);
  two.look(1.0);
  const LongMoves moves = two.foresight.take_long_moves();
  EXPECT_EQ(moves.count, 3);
  EXPECT_EQ(moves.passing, 2);
  EXPECT_EQ(moves.missing, 1.0);
  EXPECT_EQ(two.foresight.take_long_moves().count, 0);
}

/// Of a mesh that moves by more than lists reach.
TEST(Foresight, TakesAReachOfLessThanNothing) {
  Two two;
  EXPECT_EQ(two.look(-0.5).too_long, 1);
  EXPECT_EQ(two.foresight.take_long_moves().missing, 0.5);
}

TEST(Foresight, AsksForListsOfParticlesThatHaveNone) {
  Two two;
  two.foresight.list(two.places, 1);
  EXPECT_EQ(two.look(1.0).outdated, 1);
  two.foresight.list(two.places, 0);
  EXPECT_EQ(two.look(1.0).outdated, 1);
  EXPECT_EQ(two.look(1.0).too_long, 0);
}

/// The integrator tells of these.
TEST(Foresight, LeavesOutWhatIsNotFinite) {
  Two two;
  for (const double speed : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    two.v[0] = speed;
    EXPECT_EQ(two.look(1.0).too_long, 0);
  }
}

TEST(LongMoves, AreTold) {
  LongMoves moves;
  moves.add(0.25, false);
  EXPECT_EQ(moves.text("fix nve/cfpm"),
            "fix nve/cfpm: 1 moves of a particle in a step, 0 of them by more than its radius, were longer than "
            "neighbour lists reach; contacts there began late, as with 'onset off'; expected a smaller timestep, or "
            "0.5 more of skin in 'neighbor'");
  moves.add(0.125, true);
  EXPECT_EQ(moves.text("fix nve/cfpm"),
            "fix nve/cfpm: 2 moves of a particle in a step, 1 of them by more than its radius, were longer than "
            "neighbour lists reach; contacts there began late, as with 'onset off', or were passed by; expected a "
            "smaller timestep, or 0.5 more of skin in 'neighbor'");
  EXPECT_EQ(LongMoves::first("fix nve/cfpm", 7),
            "fix nve/cfpm: from step 7 on, particles move farther in a step than neighbour lists reach; a contact that "
            "such a particle comes to there begins late, as with 'onset off'. The end of the run tells how many moves "
            "these were");
}

} // namespace
} // namespace cfpm
