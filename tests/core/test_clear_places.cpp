// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/step/clear_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace cfpm;

namespace {

constexpr double radius = 0.5;

/// One particle that was at a place from which the wall, a plane, was that far.
ClearPlaces clear_of(const Vec3 &place, double clearance) {
  ClearPlaces places;
  places.resize(1);
  places.remember(0, place, clearance);
  return places;
}

// The plane z = 0, particles above it: one is clear of it if its centre is higher than its radius. All that can be said
// from a place at height h is that those are that are less than h - radius away from there.
TEST(ClearPlaces, AreASphereThatReachesToTheWall) {
  const ClearPlaces places = clear_of({3.0, -2.0, 4.0}, 4.0);
  const double way = 4.0 - radius;
  for (const Vec3 &along : {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, -1.0, 0.0}, Vec3{0.0, 0.6, -0.8}, Vec3{0.0, 0.0, 1.0}}) {
    EXPECT_TRUE(places.is_clear(0, Vec3{3.0, -2.0, 4.0} + 0.999 * way * along, radius));
    EXPECT_FALSE(places.is_clear(0, Vec3{3.0, -2.0, 4.0} + way * along, radius));
  }
}

TEST(ClearPlaces, HoldForWhoeverIsThere) {
  const ClearPlaces places = clear_of({0.0, 0.0, 2.0}, 2.0);
  EXPECT_TRUE(places.is_clear(0, {0.0, 0.0, 1.0}, 0.9));
  EXPECT_FALSE(places.is_clear(0, {0.0, 0.0, 1.0}, 1.0)) << "a larger one, or one that comes nearer within the step";
  EXPECT_FALSE(places.is_clear(0, {0.0, 0.0, 2.0}, 2.0));
}

// Floats keep places to 6e-8 of their coordinates: however that rounds, nothing is called clear that is not.
TEST(ClearPlaces, AreNeverLargerThanTheyWere) {
  const double clearance = 1.0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 place{1e4 + k * 1.2345e-4, -7e3 - k * 3.21e-4, 1.0};
    const ClearPlaces places = clear_of(place, clearance);
    for (const double side : {-1.0, 1.0})
      EXPECT_FALSE(places.is_clear(0, place + Vec3{side * (clearance - radius), 0.0, 0.0}, radius)) << k;
    EXPECT_TRUE(places.is_clear(0, place + Vec3{0.9 * (clearance - radius), 0.0, 0.0}, radius)) << k;
  }
}

TEST(ClearPlaces, AreUnknownAtFirstAndWhenForgotten) {
  ClearPlaces places;
  places.resize(2);
  EXPECT_FALSE(places.is_clear(0, {}, 0.0));
  places.remember(0, {1.0, 1.0, 1.0}, 1.0);
  places.copy(0, 1);
  places.resize(3);
  EXPECT_TRUE(places.is_clear(0, {1.0, 1.0, 1.0}, radius)) << "kept";
  EXPECT_TRUE(places.is_clear(1, {1.0, 1.0, 1.0}, radius)) << "a copy";
  EXPECT_FALSE(places.is_clear(2, {1.0, 1.0, 1.0}, radius));
  places.forget(0);
  EXPECT_FALSE(places.is_clear(0, {1.0, 1.0, 1.0}, radius));
  EXPECT_TRUE(places.is_clear(1, {1.0, 1.0, 1.0}, radius));
  places.forget_all();
  EXPECT_FALSE(places.is_clear(1, {1.0, 1.0, 1.0}, radius));
}

// A wall that is infinitely far, none at all, is far from everywhere; a particle without a position is to be asked for.
TEST(ClearPlaces, OfNumbersThatAreNotFinite) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(clear_of({}, infinite).is_clear(0, {1e9, 0.0, 0.0}, radius));
  const double none = std::nan("");
  EXPECT_FALSE(clear_of({}, 1.0).is_clear(0, {none, 0.0, 0.0}, radius));
  EXPECT_FALSE(clear_of({none, 0.0, 0.0}, 1.0).is_clear(0, {none, 0.0, 0.0}, radius));
  EXPECT_FALSE(clear_of({}, none).is_clear(0, {}, radius));
}

} // namespace
