// SPDX-License-Identifier: GPL-2.0-or-later
#include "predictor.h"

#include <gtest/gtest.h>

#include <string>

namespace cfpm {
namespace {

TEST(Registry, FindsEveryPredictorByItsName) {
  for (const char *name : {"exact", "trapezoid", "rk2", "rk4"}) {
    const Predictor *predictor = find_predictor(name);
    ASSERT_NE(predictor, nullptr) << name;
    EXPECT_STREQ(predictor->name, name);
  }
}

TEST(Registry, DoesNotGuess) {
  for (const char *name : {"", "exac", "exactly", "Exact", "rk3", "none", "exact "})
    EXPECT_EQ(find_predictor(name), nullptr) << name;
}

TEST(Registry, ListsTheNamesForMessages) {
  EXPECT_EQ(predictor_names(true), "exact, trapezoid, rk2, rk4");
  EXPECT_EQ(predictor_names(false), "rk2, rk4");
}

TEST(Registry, DefaultsFitTheLaw) {
  EXPECT_STREQ(default_predictor(true)->name, "exact");
  EXPECT_STREQ(default_predictor(false)->name, "rk4");
}

/// Table 3: trapezoid and exact have a form for the linear law only.
TEST(Registry, OffersThePredictorsOfAnyLaw) {
  const auto offered = [](const char *name) {
    std::string found;
    Predictors::for_any_law(*find_predictor(name), [&](auto predictor) { found += predictor.name; });
    return found;
  };
  EXPECT_EQ(offered("rk2"), "rk2");
  EXPECT_EQ(offered("rk4"), "rk4");
  EXPECT_EQ(offered("exact"), "");
  EXPECT_EQ(offered("trapezoid"), "");
}

/// Each name stands for its own map: the four differ in what they make of one state.
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
