// SPDX-License-Identifier: GPL-2.0-or-later
// Near pairs are chosen rarely, and there is no contact that is not among them.
#include "core/law/linear_law.h"
#include "core/numbers/pack.h"
#include "core/numbers/two_packs.h"
#include "core/step/near_pairs.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace cfpm {
namespace {

constexpr double radius = 0.01;

/// Spheres that fly through each other in a box, and a list of all their pairs.
class Spheres {
public:
  /// count: packs leave some of their coordinates over.
  explicit Spheres(double speed, double place = 0.0, int count = 61) : count_(count) {
    const auto size = static_cast<std::size_t>(count);
    std::mt19937_64 random(20051003);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    neighbors_.resize(size);
    flags_.resize(size);
    history_.resize(size);
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k) {
        x.push_back(place + uniform(0.0, 0.1));
        v.push_back(uniform(-speed, speed));
      }
      radii.push_back(uniform(0.5 * radius, radius));
      const auto at = static_cast<std::size_t>(i);
      for (int j = i + 1; j < count; ++j) neighbors_[at].push_back(j);
      counts_.push_back(count - 1 - i);
      flags_[at].assign(size, 0);
      history_[at].assign(3 * size, 0.0);
      first_.push_back(i);
      neighbor_rows_.push_back(neighbors_[at].data());
      flag_rows_.push_back(flags_[at].data());
      history_rows_.push_back(history_[at].data());
    }
    pairs.count = count;
    pairs.first = first_.data();
    pairs.neighbor_count = counts_.data();
    pairs.neighbors = neighbor_rows_.data();
    pairs.index_mask = ~0;
    pairs.flags = flag_rows_.data();
    pairs.history = history_rows_.data();
    pairs.history_size = 3;
    pairs.spring_offset = 0;
    pairs.touching = 1;
  }

  void move() {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += v[k];
  }

  /// After which near must hold what it says.
  void follow(double ahead = 0.0) {
    Particles particles;
    particles.x = VectorRows(x.data());
    particles.radius = radii.data();
    particles.count = count_;
    near.follow<TwoPacks<Pack<2>>, LinearLaw>(particles, pairs, ahead);
  }

  /// Pairs that are apart by less than a gap.
  std::set<std::pair<int, int>> closer_than(double gap) const {
    std::set<std::pair<int, int>> found;
    for (int i = 0; i < count_; ++i)
      for (int j = i + 1; j < count_; ++j) {
        const Vec3 separation = vec3(&x[3 * static_cast<std::size_t>(i)]) - vec3(&x[3 * static_cast<std::size_t>(j)]);
        const double reach = radii[static_cast<std::size_t>(i)] + radii[static_cast<std::size_t>(j)] + gap;
        if (dot(separation, separation) < reach * reach) found.emplace(i, j);
      }
    return found;
  }

  std::set<std::pair<int, int>> chosen() const {
    std::set<std::pair<int, int>> found;
    for (int k = 0; k < near.count(); ++k) found.emplace(near.i()[k], near.j()[k]);
    return found;
  }

  /// How many that are closer than a gap are not among the near ones.
  std::size_t missing(double gap = 0.0) const {
    const auto near_ones = chosen();
    std::size_t found = 0;
    for (const auto &pair : closer_than(gap)) found += 1 - near_ones.count(pair);
    return found;
  }

  /// Sets one on the diagonal, along which it flies. place: along each axis [m]; speed: likewise [m per step].
  void put(int i, double place, double speed) {
    for (std::size_t k = 3 * static_cast<std::size_t>(i); k < 3 * static_cast<std::size_t>(i + 1); ++k) {
      x[k] = place;
      v[k] = speed;
    }
  }

  std::vector<double> x, v, radii;
  PairList pairs;
  NearPairs near;

private:
  int count_;
  std::vector<std::vector<int>> neighbors_, flags_;
  std::vector<std::vector<double>> history_;
  std::vector<int> first_, counts_;
  std::vector<int *> neighbor_rows_, flag_rows_;
  std::vector<double *> history_rows_;
};

TEST(NearPairs, HoldAllThatTouchAsLongAsTheyLast) {
  Spheres spheres(1e-4 * radius);
  int chosen = 0;
  for (int n = 0; n < 600; ++n, spheres.move()) {
    spheres.follow();
    ASSERT_EQ(spheres.missing(), 0U) << "step " << n;
    if (spheres.near.age() == 0) ++chosen;
  }
  EXPECT_LT(spheres.near.count(), 900); // of 1,830: far ones are left out
  EXPECT_GT(chosen, 5);
  EXPECT_LT(chosen, 50); // some 24 steps each
}

/// Two that come together as fast as is thought to be possible, from several distances.
TEST(NearPairs, HoldThoseThatFlyAtEachOther) {
  const double speed = 1e-3 * radius;
  for (const double ahead : {0.0, 0.05 * radius})
    for (int gap = 0; gap < 20; ++gap) {
      Spheres spheres(0.0, 0.0, 2);
      spheres.put(0, 0.0, speed);
      spheres.put(1, (2.0 + 0.05 * gap) * radius, -speed);
      for (int n = 0; n < 1000; ++n, spheres.move()) {
        spheres.follow(ahead);
        ASSERT_EQ(spheres.missing(ahead), 0U) << "ahead " << ahead << ", gap " << gap << ", step " << n;
      }
    }
}

TEST(NearPairs, SeeThatRadiiGrow) {
  Spheres spheres(0.0);
  for (int n = 0; n < 100; ++n) {
    for (double &r : spheres.radii) r *= 1.0005;
    spheres.follow();
    ASSERT_EQ(spheres.missing(), 0U) << "step " << n;
  }
}

TEST(NearPairs, SeeWhoIsMovedOnce) {
  Spheres spheres(0.0);
  for (int n = 0; n < 5; ++n) spheres.follow();
  EXPECT_EQ(spheres.near.age(), 4);
  // the last one, which the packs of the check leave over
  for (std::size_t k = 3; k > 0; --k) spheres.x[spheres.x.size() - k] = spheres.x[3 - k] + 0.5 * radius;
  spheres.follow();
  EXPECT_EQ(spheres.near.age(), 0);
  EXPECT_EQ(spheres.missing(), 0U);
}

/// Places are remembered as numbers that are 8 mm apart here: two spheres that move from one side of theirs to the
/// other seem to be hardly elsewhere, but touch.
TEST(NearPairs, KnowHowTheyRoundPlaces) {
  const double place = 1e5;
  const double between = 149.0 / 128.0; // along each axis
  const double way = 2e-4;
  const double gap = 1.2e-3; // less than they come together
  Spheres spheres(0.0, 0.0, 2);
  spheres.put(0, place - way, 2.0 * way);
  spheres.put(1, place + between + way, -2.0 * way);
  for (double &r : spheres.radii) r = 0.5 * (std::sqrt(3.0) * (between + 2.0 * way) - gap);
  spheres.follow();
  EXPECT_EQ(spheres.closer_than(0.0).size(), 0U);
  spheres.move();
  spheres.follow();
  EXPECT_EQ(spheres.closer_than(0.0).size(), 1U);
  EXPECT_EQ(spheres.missing(), 0U);
}

TEST(NearPairs, LastWhereNothingMoves) {
  Spheres spheres(0.0);
  for (int n = 0; n < 1000; ++n) spheres.follow();
  EXPECT_EQ(spheres.near.age(), 999);
  EXPECT_EQ(spheres.chosen(), spheres.closer_than(0.001 * spheres.radii[0]));
}

TEST(NearPairs, KnowWhichTouch) {
  Spheres spheres(1e-3 * radius);
  spheres.follow();
  const auto touching = spheres.closer_than(0.0);
  for (int k = 0; k < spheres.near.count(); ++k)
    EXPECT_EQ(spheres.near.touching(k) >> k % NearPairs::group & 1U,
              static_cast<unsigned>(touching.count({spheres.near.i()[k], spheres.near.j()[k]})));
}

TEST(NearPairs, AreChosenAnewWhereTheyAreForgotten) {
  Spheres spheres(0.0);
  for (int n = 0; n < 3; ++n) spheres.follow();
  spheres.near.forget();
  spheres.follow();
  EXPECT_EQ(spheres.near.age(), 0);
}

} // namespace
} // namespace cfpm
