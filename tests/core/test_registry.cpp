// SPDX-License-Identifier: GPL-2.0-or-later
#include "force_predictors.h"
#include "predictor.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cfpm {
namespace {

TEST(Registry, FindsEveryPredictorByItsName) {
  for (const char *name : {"exact", "trapezoid", "rk2", "rk4", "impulse"}) {
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
  EXPECT_EQ(predictor_names(LawKind::linear), "exact, trapezoid, rk2, rk4, impulse");
  EXPECT_EQ(predictor_names(LawKind::self_similar), "exact, rk2, rk4, impulse");
  EXPECT_EQ(predictor_names(LawKind::any), "rk2, rk4");
}

TEST(Registry, DefaultsFitTheLaw) {
  EXPECT_STREQ(default_predictor(LawKind::linear)->name, "exact");
  EXPECT_STREQ(default_predictor(LawKind::self_similar)->name, "rk4");
  EXPECT_STREQ(default_predictor(LawKind::any)->name, "rk4");
}

/// Table 3; exact is known for one law more, but not for any.
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
  const std::vector<Predictor> of_forces = testing::force_predictors();
  for (std::size_t i = 0; i < of_forces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(of_forces[i].propagator(oscillator, dt).displacement_from_displacement,
                of_forces[j].propagator(oscillator, dt).displacement_from_displacement);
}

} // namespace
} // namespace cfpm
