// SPDX-License-Identifier: GPL-2.0-or-later
// Rolling and twisting resistance: two bodies that a spring and a dashpot turn back, against their exact motion; the
// limit; and chunks computed several at a time, which give to the last bit what contacts give one by one.
#include "core/contact/resisted_turn.h"
#include "core/motion/exact_flow.h"
#include "core/step/turn_resistances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace cfpm::testing {
namespace {

constexpr Vec3 normal{0.0, 0.0, 1.0};
constexpr double unlimited = 1e300;

/// The rate after a time, from a spring at rest, in so many steps; inertia 1.
template <class Turn>
Turn rate_after(double time, int steps, const BasicTurnHold<double> &hold, Turn rate, Turn *kept_spring = nullptr) {
  const double dt = time / steps;
  const BasicTurnStep<double> step{dt, 1.0, 1.0};
  Turn kept = -0.5 * dt * rate; // so that the spring is 0 at the first evaluation
  for (int k = 0; k < steps; ++k) {
    const Turn now = move_on_turn(hold, dt, normal, kept, rate);
    rate = rate + dt * mean_couple(hold, step, now, rate);
  }
  if (kept_spring) *kept_spring = kept;
  return rate;
}

TEST(TurnResistances, AreOfSecondOrder) {
  for (const double damping : {0.0, 0.3, 3.0}) {
    const BasicTurnHold<double> hold{2.0, damping, unlimited};
    const double expected = exact_flow({2.0, damping, 1.0}, 1.5).rate_from_rate;
    double before = 0.0;
    for (const int steps : {40, 80, 160}) {
      const double error = std::fabs(rate_after(1.5, steps, hold, 1.0) - expected);
      const Vec3 rolling = rate_after(1.5, steps, hold, Vec3{0.6, -0.8, 0.0});
      EXPECT_NEAR(norm(rolling), std::fabs(rate_after(1.5, steps, hold, 1.0)), 1e-14);
      if (before > 0.0) {
        EXPECT_NEAR(before / error, 4.0, 0.3) << damping;
      }
      before = error;
    }
  }
}

TEST(TurnResistances, AreStableAtAnyStep) {
  for (const double stiffness : {1e-3, 1.0, 1e3, 1e9})
    for (const double damping : {0.0, 1.0, 1e3, 1e9}) {
      const double rate = rate_after(1000.0, 1000, {stiffness, damping, unlimited}, 1.0);
      EXPECT_LE(std::fabs(rate), 1.0 + 1e-9) << stiffness << ' ' << damping;
      if (damping > 0.0 && stiffness <= damping) {
        EXPECT_LT(std::fabs(rate), 0.5) << stiffness << ' ' << damping;
      }
    }
}

/// A strong dashpot stops, it does not throw back.
TEST(TurnResistances, StopByTheirDashpot) {
  for (const double h : {0.1, 1.0, 10.0, 1e3, 1e6}) {
    const double left = rate_after(1.0, 1, {0.0, h, unlimited}, 1.0);
    EXPECT_NEAR(left, std::exp(-h), 0.1) << h;
    EXPECT_GT(left, -0.1) << h;
  }
}

/// At the limit the rate falls linearly, and the spring is where both it and the dashpot reach the limit.
TEST(TurnResistances, KeepTheirLimit) {
  const BasicTurnHold<double> hold{1e3, 2.0, 0.5};
  double kept = 0.0;
  const double dt = 1e-4;
  const double rate = rate_after(1.0, 10000, hold, 3.0, &kept);
  EXPECT_NEAR(rate, 2.5, 0.5 * 0.5 / 1e3 / 2.5 + dt);
  EXPECT_NEAR(1e3 * (kept - 0.5 * dt * rate) + 2.0 * rate, 0.5, 1e-3);
}

TEST(TurnResistances, LimitTheMean) {
  const BasicTurnHold<double> hold{0.0, 100.0, 0.5};
  EXPECT_DOUBLE_EQ(mean_couple<double>(hold, {1e-4, 1.0, 1.0}, 0.0, 3.0), -0.5);
  EXPECT_NEAR(norm(mean_couple<double>(hold, {1e-4, 1.0, 1.0}, Vec3{}, Vec3{3.0, -4.0, 0.0}) - Vec3{-0.3, 0.4, 0.0}),
              0.0, 1e-15);
}

/// About the normal the direction at the limit is that of the rate, as in the host.
TEST(TurnResistances, TwistAgainstTheRate) {
  const BasicTurnHold<double> hold{1.0, 0.0, 0.1};
  EXPECT_DOUBLE_EQ(set_back(hold, 5.0, -1.0), -0.1);
  EXPECT_DOUBLE_EQ(set_back(hold, 5.0, 1.0), 0.1);
  EXPECT_DOUBLE_EQ(set_back(hold, 0.05, -1.0), 0.05);
  EXPECT_NEAR(norm(set_back(hold, Vec3{3.0, 4.0, 0.0}, Vec3{-1.0, 0.0, 0.0}) - Vec3{0.06, 0.08, 0.0}), 0.0, 1e-15);
}

/// Spheres in a row of which each touches the next.
class Row {
public:
  static constexpr int most = 40;
  static constexpr double dt = 2e-5;

  Row(int types, double by_area, double presses) : resistances_(types + 1, by_types(types, by_area, presses)) {
    std::mt19937_64 random(20051003);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    for (int i = 0; i <= most; ++i) {
      radius_.push_back(uniform(1e-3, 2e-3));
      mass_.push_back(uniform(1e-5, 2e-5));
      type_.push_back(1 + i % types);
      group_.push_back(i % 7 == 3 ? 2 : 1);
      for (int c = 0; c < 3; ++c) {
        v_.push_back(uniform(-0.1, 0.1));
        omega_.push_back(uniform(-50.0, 50.0));
      }
    }
    for (int k = 0; k < most * WiderHistory::size; ++k) history_.push_back(uniform(-1e-3, 1e-3));
    for (int k = 0; k < most; ++k) {
      const Vec3 direction{uniform(-1.0, 1.0), uniform(-1.0, 1.0), 1.0};
      separation_.push_back((0.99 * (radius_[at(k)] + radius_[at(k + 1)]) / norm(direction)) * direction);
      force_.push_back({uniform(-0.1, 0.1), uniform(-0.1, 0.1), uniform(-0.1, 0.1)});
    }
  }

  std::vector<double> together(int count, int lanes) {
    auto chunk = std::make_unique<ContactColumns>();
    std::vector<double> history = history_;
    chunk->count = count;
    for (int k = 0; k < count; ++k) {
      chunk->separation.set(k, separation_[at(k)]);
      chunk->squared[k] = dot(separation_[at(k)], separation_[at(k)]);
      chunk->radius_i[k] = radius_[at(k)];
      chunk->radius_j[k] = radius_[at(k + 1)];
      chunk->force.set(k, force_[at(k)]);
      chunk->i[k] = k;
      chunk->j[k] = k + 1;
      chunk->spring[k] = &history[at(k * WiderHistory::size)];
    }
    chunk->fill_up();
    for (int k = count; k < count + ContactColumns::most_lanes - 1; ++k) chunk->force.set(k, force_[at(count - 1)]);
    resistances_.add_couples(lanes, particles(), *chunk, dt);
    for (int k = 0; k < count; ++k)
      for (const double c : {chunk->couple[k].x, chunk->couple[k].y, chunk->couple[k].z}) history.push_back(c);
    return history;
  }

  std::vector<double> one_by_one(int count) {
    std::vector<double> history = history_;
    std::vector<double> couples;
    for (int k = 0; k < count; ++k) {
      const Particles all = particles();
      const Vec3 d = separation_[at(k)];
      const Contact contact{touching_spheres(d, std::sqrt(dot(d, d)), radius_[at(k)], radius_[at(k + 1)], all.motion(k),
                                             all.motion(k + 1)),
                            dt,
                            0.0,
                            {&history[at(k * WiderHistory::size)], dt, true}};
      const Vec3 couple = resistances_.couple(all, k, k + 1, contact, force_[at(k)], dt);
      couples.insert(couples.end(), {couple.x, couple.y, couple.z});
    }
    history.insert(history.end(), couples.begin(), couples.end());
    return history;
  }

private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }

  static std::vector<BasicTurnResistance<double>> by_types(int types, double by_area, double presses) {
    const int rows = types + 1;
    std::vector<BasicTurnResistance<double>> all(at(rows * rows));
    for (int i = 1; i <= types; ++i)
      for (int j = 1; j <= types; ++j) {
        GranularMaterial<double> law{};
        law.normal_area = 1e7;
        law.damping_ratio = 0.3;
        law.tangential_area = 1e7;
        law.tangential_damping = 0.5;
        law.friction = 0.5;
        const AdhesiveMaterial<double> adhesion{3.0, i == j ? presses : 0.0};
        all[at(i * rows + j)] = {1e3 * (i + j), 0.1, 0.2, 1e-2, 1e-7, 1e-4, i == j ? by_area : 0.0, law, adhesion};
      }
    return all;
  }

  Particles particles() {
    Particles p;
    p.v = VectorRows(v_.data());
    p.omega = VectorRows(omega_.data());
    p.radius = radius_.data();
    p.mass = mass_.data();
    p.type = type_.data();
    p.group = group_.data();
    p.count = p.receiving = most + 1;
    p.frozen = 2;
    return p;
  }

  TurnResistances resistances_;
  std::vector<double> radius_, mass_, v_, omega_, history_;
  std::vector<int> type_, group_;
  std::vector<Vec3> separation_, force_;
};

TEST(TurnResistances, OfChunksHaveTheBitsOfContacts) {
  for (const int types : {1, 3})
    for (const double by_area : {0.0, 1.0})
      for (const double presses : {0.0, 1.0}) {
        Row row(types, by_area, presses);
        for (int count = 1; count <= Row::most; ++count) {
          const std::vector<double> expected = row.one_by_one(count);
          EXPECT_TRUE(row.together(count, 2) == expected) << count;
          if (instruction_set().lanes == 4) {
            EXPECT_TRUE(row.together(count, 4) == expected) << count;
          }
        }
      }
}

TEST(TurnResistances, AreLimitedByWhatAdhesionPresses) {
  GranularMaterial<double> law{};
  law.normal_area = 1e7;
  const PairSizes<double> sizes{0.004, 0.006, 1e-3};
  const double overlap = 1e-5, push = 0.2;
  BasicTurnResistance<double> resistance{1e3, 0.1, 0.2, 1e-2, 1e-7, 1e-4, 0.0, law, {50.0, 0.0}};
  EXPECT_EQ(resistance.pushed(sizes, overlap, push), push);
  resistance.adhesion.presses = 1.0;
  const double expected = 1e7 * std::sqrt(0.0024 * overlap) * overlap + 50.0 * 0.0024;
  EXPECT_NEAR(resistance.pushed(sizes, overlap, push), expected, 1e-14);
}

} // namespace
} // namespace cfpm::testing
