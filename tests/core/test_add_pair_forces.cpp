// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over listed pairs, the cache of contact kinds and the step of a sphere together: what they do with a cloud
// of spheres is what all pairs do in the plain way, and what has to hold of any forces holds.
#include "collapsing_cloud.h"
#include "plain_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cfpm::testing {
namespace {

/// Both, step by step, with what they do compared before each.
template <class Law> class Twice {
public:
  explicit Twice(const Options &options, const Cloud &start = cloud()) : loop(start, options), plain(start, options) {}

  void step(int n) {
    const double dt = step_length(n);
    const double last = n == 0 ? dt : step_length(n - 1);
    loop.evaluate(dt, last, true);
    plain.evaluate(dt, last);
    compare(n);
    loop.move(dt);
    plain.move(dt);
  }

  /// Differences come from rounding alone. Collisions let them grow: by how much, the run of a cloud shows that begins
  /// a little elsewhere, see growth().
  void compare(int n) {
    for (int i = 0; i < size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      largest =
          std::max({largest, norm(at(loop.now.x, i) - at(plain.now.x, i)),
                    shortest_contact * norm(at(loop.now.v, i) - at(plain.now.v, i)),
                    shortest_contact * loop.now.radius[k] * norm(at(loop.now.omega, i) - at(plain.now.omega, i))});
      ASSERT_EQ(loop.contacts[k], plain.contacts[k]) << "of " << i << " in step " << n;
      seen = std::max(seen, plain.contacts[k]);
      for (int j = i + 1; j < size; ++j) {
        const bool known = plain.springs.count({i, j}) != 0;
        ASSERT_EQ(loop.touches(i, j), known) << i << ", " << j << " in step " << n;
        if (known) continue;
        ASSERT_EQ(loop.spring(i, j), Vec3{}) << i << ", " << j << " in step " << n;
      }
    }
  }

  Loop<Law> loop;
  Plain<Law> plain;
  double largest = 0.0; ///< difference [m]
  int seen = 0;         ///< contacts of one particle at most
};

/// How far two plain runs are apart that begin this far apart [m].
template <class Law> double growth(const Options &options, double apart) {
  Plain<Law> one(cloud(), options);
  Cloud moved = cloud();
  for (std::size_t k = 0; k < moved.x.size(); ++k) moved.x[k] += k % 2 == 0 ? apart : -apart;
  Plain<Law> other(moved, options);
  double largest = 0.0;
  for (int n = 0; n < steps; ++n) {
    for (Plain<Law> *const run : {&one, &other}) {
      run->evaluate(step_length(n), step_length(n == 0 ? 0 : n - 1));
      run->move(step_length(n));
    }
    for (int i = 0; i < size; ++i) largest = std::max(largest, norm(at(one.now.x, i) - at(other.now.x, i)));
  }
  return largest / apart;
}

/// All steps agree to what rounding becomes: in each of them about ten roundings of a place, of which none is above
/// 0.1 m, grow as any other difference does.
template <class Law> void expect_the_same(const Options &options) {
  Twice<Law> both(options);
  for (int n = 0; n < steps; ++n) {
    both.step(n);
    if (::testing::Test::HasFatalFailure()) return;
  }
  const double rounding = 0.1 * 1.1e-16;
  EXPECT_LT(both.largest, 10.0 * steps * rounding * std::max(1.0, growth<Law>(options, 1e-10)));
  EXPECT_GE(both.seen, 3); // the cloud met
  EXPECT_TRUE(both.loop.keeps_what_is_not_its_own());
  const bool impulse = find_method(options.predictor)->wants_crowd;
  EXPECT_EQ(both.plain.crowded > 0, impulse);
  EXPECT_EQ(both.plain.met_inside > 0, options.inside());
  EXPECT_EQ(both.plain.parted_inside > 0, options.inside() && !impulse);
}

TEST(AddPairForces, DoesWhatAllPairsDoWithMeanForces) {
  expect_the_same<LinearLaw>({"exact"});
  expect_the_same<LinearLaw>({"trapezoid"});
  expect_the_same<HertzLaw>({"rk4"});
}

TEST(AddPairForces, DoesWhatAllPairsDoWithMeanForcesFromTheTouchOn) {
  expect_the_same<LinearLaw>({"exact", 0.0, true});
  expect_the_same<LinearLaw>({"rk2", 0.0, true});
  expect_the_same<HertzLaw>({"rk4", 0.0, true});
}

TEST(AddPairForces, DoesWhatAllPairsDoWithImpulses) {
  expect_the_same<LinearLaw>({"impulse"});
  expect_the_same<LinearLaw>({"impulse", 0.5});
  expect_the_same<LinearLaw>({"impulse", 0.0, false});
}

TEST(AddPairForces, DoesWhatAllPairsDoWithImpulsesOfHertzContacts) { expect_the_same<HertzLaw>({"impulse", 0.5}); }

/// The loop alone, up to where spheres are in contact.
template <class Law> Loop<Law> after(const Options &options, int count) {
  Loop<Law> loop(cloud(), options);
  for (int n = 0; n < count; ++n) {
    loop.evaluate(step_before, step_before, true);
    loop.move(step_before);
  }
  return loop;
}

const std::vector<Options> both_methods = {{"exact"}, {"impulse", 0.5}};

/// Whatever the contacts do, their forces and shifts add up to nothing: every one is given to either body.
TEST(AddPairForces, ConservesMomentum) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> loop(cloud(), options);
    int acted = 0;
    for (int n = 0; n < 40; ++n) {
      loop.evaluate(step_before, step_before, true);
      for (const Rows *const rows : {&loop.f, &loop.shift}) {
        Vec3 sum{};
        double sizes = 0.0;
        for (int i = 0; i < size; ++i) {
          sum = sum + at(*rows, i);
          sizes += norm(at(*rows, i));
        }
        acted += sizes > 0.0;
        EXPECT_LE(norm(sum), size * 2.3e-16 * sizes) << options.predictor << " in step " << n; // a rounding per sum
      }
      loop.move(step_before);
    }
    EXPECT_GT(acted, 20);
  }
}

/// About any point, too: a contact's force acts where the bodies meet, on both.
TEST(AddPairForces, ConservesAngularMomentum) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> loop = after<LinearLaw>({options.predictor, options.split, false}, 14);
    loop.evaluate(step_before, step_before, true);
    Vec3 sum{};
    double sizes = 0.0;
    for (int i = 0; i < size; ++i) {
      sum = sum + at(loop.torque, i) + cross(at(loop.now.x, i), at(loop.f, i));
      sizes += norm(at(loop.torque, i)) + norm(at(loop.f, i)) * norm(at(loop.now.x, i));
    }
    ASSERT_GT(sizes, 0.0);
    // an impulse acts along the normal of the middle of an isolated contact, not of its beginning: its arm is off by
    // the way that the centres turn in half a step, and its lever by the overlap that changes in that time
    const double turning = std::string(options.predictor) == "impulse" ? 0.01 : 0.0;
    EXPECT_LE(norm(sum), (turning + size * 1e-15) * sizes) << options.predictor;
  }
}

/// What is tallied of a contact is what its bodies get, the first of the two along the way from the second.
TEST(AddPairForces, TalliesEveryContact) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> loop = after<LinearLaw>(options, 14);
    loop.evaluate(step_before, step_before, true);
    Rows sum(3 * size, 0.0);
    for (const auto &[pair, of] : loop.tally) {
      add(of.first, row(sum, pair.first));
      add(-of.first, row(sum, pair.second));
      EXPECT_GT(dot(of.second, at(loop.now.x, pair.first) - at(loop.now.x, pair.second)), 0.0);
    }
    EXPECT_GE(loop.tally.size(), 5U);
    for (int i = 0; i < size; ++i) EXPECT_LE(norm(at(sum, i) - at(loop.f, i)), 1e-14 * norm(at(loop.f, i)));
  }
}

/// Particles from "receiving" on belong to somebody else, who asks for the pair as well: they get nothing here, and
/// those below the same as ever.
TEST(AddPairForces, GivesNothingToParticlesOfOthers) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> whole = after<LinearLaw>(options, 14);
    Options half = options;
    half.receiving = 7;
    Loop<LinearLaw> part(whole.now, half);
    Loop<LinearLaw> all(whole.now, options);
    part.evaluate(step_before, step_before, true);
    all.evaluate(step_before, step_before, true);
    int acted = 0;
    for (int i = 0; i < size; ++i) {
      const bool own = i < half.receiving;
      for (const auto &[a, b] : {std::pair(&part.f, &all.f), {&part.torque, &all.torque}, {&part.shift, &all.shift}})
        EXPECT_EQ(at(*a, i), own ? at(*b, i) : Vec3{}) << options.predictor << ' ' << i;
      const auto k = static_cast<std::size_t>(i);
      EXPECT_EQ(part.contacts[k], own ? all.contacts[k] : 0.0) << options.predictor << ' ' << i;
      acted += !own && all.contacts[k] > 0.0;
    }
    EXPECT_GT(acted, 0);
  }
}

/// A host asks again where it writes output: to the last bit the same, and nothing is accumulated.
TEST(AddPairForces, AnsweringAgainChangesNothing) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> loop = after<LinearLaw>(options, 14);
    loop.evaluate(step_before, step_before, true);
    const auto f = loop.f;
    const auto torque = loop.torque;
    const auto shift = loop.shift;
    const auto contacts = loop.contacts;
    std::map<std::pair<int, int>, Vec3> springs;
    for (const auto &entry : loop.tally) springs[entry.first] = loop.spring(entry.first.first, entry.first.second);
    for (int again = 0; again < 3; ++again) {
      loop.evaluate(step_before, step_before, false);
      EXPECT_EQ(loop.f, f) << options.predictor;
      EXPECT_EQ(loop.torque, torque) << options.predictor;
      EXPECT_EQ(loop.shift, shift) << options.predictor;
      EXPECT_EQ(loop.contacts, contacts) << options.predictor;
      for (const auto &[pair, spring] : springs) EXPECT_EQ(loop.spring(pair.first, pair.second), spring);
    }
  }
}

/// Moves two spheres of the cloud together or apart, all others out of the way.
void put_pair(Cloud &c, double distance) {
  for (int i = 2; i < size; ++i) set({i * 1.0, 0.0, 0.0}, row(c.x, i));
  set({0.0, 0.0, 0.0}, row(c.x, 0));
  set({distance, 0.0, 0.0}, row(c.x, 1));
  for (int i = 0; i < 2; ++i) {
    set({0.0, i == 0 ? 0.05 : -0.05, 0.0}, row(c.v, i));
    set({}, row(c.omega, i));
  }
}

/// In either way that the end of a contact is noticed: by the loop that gives forces, or by the one that only ends.
TEST(AddPairForces, APairThatMeetsAgainFindsNoOldSpring) {
  for (const Options &options : both_methods)
    for (const bool by_forces : {true, false}) {
      Cloud touching_pair = cloud();
      put_pair(touching_pair, 0.0179);
      Loop<LinearLaw> loop(touching_pair, options);
      loop.evaluate(step_before, step_before, true);
      const auto first = loop.f;
      EXPECT_FALSE(loop.spring(0, 1) == Vec3{});
      EXPECT_TRUE(loop.touches(0, 1));
      for (int n = 0; n < 3; ++n) loop.evaluate(step_before, step_before, true); // the spring is stretched
      EXPECT_NE(loop.f, first);
      end_separated_contacts(loop.particles(), loop.pairs()); // still together: nothing ends
      EXPECT_FALSE(loop.spring(0, 1) == Vec3{});
      EXPECT_TRUE(loop.touches(0, 1));

      put_pair(loop.now, 0.0181);
      if (by_forces)
        loop.evaluate(step_before, step_before, true);
      else
        end_separated_contacts(loop.particles(), loop.pairs());
      EXPECT_EQ(loop.spring(0, 1), Vec3{}) << options.predictor;
      EXPECT_FALSE(loop.touches(0, 1)) << options.predictor;
      EXPECT_TRUE(loop.keeps_what_is_not_its_own());

      std::fill(loop.contacts.begin(), loop.contacts.end(), 0.0);
      put_pair(loop.now, 0.0179);
      loop.evaluate(step_before, step_before, true);
      EXPECT_EQ(loop.f, first) << options.predictor;
    }
}

} // namespace
} // namespace cfpm::testing
