// SPDX-License-Identifier: GPL-2.0-or-later
#include "core/method/method.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <string>

namespace cfpm {
namespace {

TEST(Registry, FindsEveryMethodByItsName) {
  for (const char *name : {"exact", "trapezoid", "rk2", "rk4", "impulse", "verlet"}) {
    const Method *method = find_method(name);
    ASSERT_NE(method, nullptr) << name;
    EXPECT_STREQ(method->name, name);
  }
}

TEST(Registry, KnowsTheConventionalMethodByTwoNames) { EXPECT_EQ(find_method("none"), find_method("verlet")); }

TEST(Registry, DoesNotGuess) {
  for (const char *name : {"", "exac", "exactly", "Exact", "rk3", "None", "auto", "exact "})
    EXPECT_EQ(find_method(name), nullptr) << name;
}

TEST(Registry, ListsTheNamesForMessages) {
  EXPECT_EQ(method_names(LawKind::linear), "exact, trapezoid, rk2, rk4, impulse, verlet");
  EXPECT_EQ(method_names(LawKind::self_similar), "exact, rk2, rk4, impulse, verlet");
  EXPECT_EQ(method_names(LawKind::viscoelastic), "rk2, rk4, impulse, verlet");
  EXPECT_EQ(method_names(LawKind::any), "rk2, rk4, verlet");
}

TEST(Registry, DefaultsFitTheLaw) {
  EXPECT_STREQ(default_method(LawKind::linear).name, "exact");
  EXPECT_STREQ(default_method(LawKind::self_similar).name, "rk4");
  EXPECT_STREQ(default_method(LawKind::any).name, "rk4");
}

/// Table 3; exact is known for one law more, but not for any.
TEST(Registry, KnowsWhichMethodsTheLawsHave) {
  const auto known = [](LawKind law) {
    std::string found;
    for (const Method *m : Methods::table)
      if (m->predicts(law)) found += std::string(m->name) + " ";
    return found;
  };
  EXPECT_EQ(known(LawKind::linear), "exact trapezoid rk2 rk4 impulse ");
  EXPECT_EQ(known(LawKind::self_similar), "exact rk2 rk4 impulse ");
  EXPECT_EQ(known(LawKind::viscoelastic), "rk2 rk4 impulse ");
  EXPECT_EQ(known(LawKind::any), "rk2 rk4 ");
}

TEST(Registry, VisitsTheTypeOfAMethodAndNoOther) {
  for (const Method *m : Methods::table) {
    std::string visited;
    Methods::visit(*m, [&](auto type) { visited += decltype(type)::method.name; });
    EXPECT_EQ(visited, m->name);
  }
}

/// Impulses do so unless they are told not to, the paper's methods if they are told to, the host's own step never.
TEST(Registry, BeginsContactsInsideAStepAsTheDeckSays) {
  for (const Method *m : Methods::table) {
    EXPECT_EQ(begins_inside(*m, std::nullopt), m == find_method("impulse")) << m->name;
    EXPECT_EQ(begins_inside(*m, true), m != find_method("verlet")) << m->name;
    EXPECT_FALSE(begins_inside(*m, false)) << m->name;
  }
}

/// What a wall does that does not say its own.
TEST(Registry, AWallFollowsThePairsAsFarAsItsLawAllows) {
  const Method &exact = *find_method("exact");
  EXPECT_STREQ(method_at_wall(exact, LawKind::linear).name, "exact");
  EXPECT_STREQ(method_at_wall(exact, LawKind::any).name, "rk4");
  EXPECT_STREQ(method_at_wall(*find_method("impulse"), LawKind::self_similar).name, "impulse");
  EXPECT_STREQ(method_at_wall(*find_method("none"), LawKind::any).name, "verlet");
}

/// Each name of the paper stands for its own map: the four differ in what they make of one state.
TEST(Registry, NamesBelongToTheirMaps) {
  const Oscillator oscillator{3.0, 0.4, 0.7};
  const double dt = 0.9;
  const auto expect = [&](const char *name, const Propagator &map) {
    const Propagator found = find_predictor(name)->propagator(oscillator, dt);
    EXPECT_EQ(found.displacement_from_displacement, map.displacement_from_displacement) << name;
    EXPECT_EQ(found.rate_from_rate, map.rate_from_rate) << name;
  };
  expect("exact", make_propagator<Exact>(oscillator, dt));
  expect("trapezoid", make_propagator<Trapezoid>(oscillator, dt));
  expect("rk2", make_propagator<RungeKutta2>(oscillator, dt));
  expect("rk4", make_propagator<RungeKutta4>(oscillator, dt));
  for (std::size_t i = 0; i < predictors.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(predictors[i].propagator(oscillator, dt).displacement_from_displacement,
                predictors[j].propagator(oscillator, dt).displacement_from_displacement);
}

} // namespace
} // namespace cfpm
