// SPDX-License-Identifier: GPL-2.0-or-later
// "predict auto": which method it takes at which step, and that a choice lasts; what a command is predicted with that
// does not say it.
#include "core/deck/method_choice.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace cfpm {
namespace {

constexpr double no_particles = std::numeric_limits<double>::infinity();

/// At nt steps per shortest contact.
std::string chosen(double nt, LawKind law = LawKind::linear, bool damped_friction = false) {
  AutoMethod method(law, damped_friction);
  method.choose(nt * 1e-5, 1e-5);
  return method.method().name;
}

TEST(AutoMethod, TakesTheHostsStepWhereThatIsRightAndElseImpulses) {
  EXPECT_EQ(chosen(100.0), "verlet");
  EXPECT_EQ(chosen(6.0), "verlet");
  EXPECT_EQ(chosen(5.9), "impulse");
  EXPECT_EQ(chosen(4.7, LawKind::self_similar), "impulse");
  EXPECT_EQ(chosen(2.1), "impulse");
}

TEST(AutoMethod, AsksMoreStepsOfADashpotInFriction) {
  EXPECT_EQ(chosen(30.0, LawKind::linear, true), "verlet");
  EXPECT_EQ(chosen(29.0, LawKind::linear, true), "impulse");
}

TEST(AutoMethod, HasNoChoiceWithoutMeasuredImpulses) {
  for (const LawKind law : {LawKind::viscoelastic, LawKind::any})
    for (const double nt : {100.0, 3.0}) EXPECT_EQ(chosen(nt, law), "verlet");
}

TEST(AutoMethod, TakesImpulsesUntilParticlesAreKnown) {
  AutoMethod method(LawKind::linear, false);
  EXPECT_STREQ(method.method().name, "impulse");
  method.choose(no_particles, 1e-5);
  EXPECT_STREQ(method.method().name, "impulse");
}

/// Friction begins anew with another method. A choice goes with the step, or when it has become wrong.
TEST(AutoMethod, StaysWhileTheStepIsTheSame) {
  AutoMethod method(LawKind::linear, false);
  method.choose(no_particles, 1e-5);
  method.choose(1e-3, 1e-5);
  EXPECT_STREQ(method.method().name, "impulse"); // the poured bed goes on as it was
  method.choose(1e-3, 2e-5);
  EXPECT_STREQ(method.method().name, "verlet");
  method.choose(4e-5, 2e-5); // smaller particles have come
  EXPECT_STREQ(method.method().name, "impulse");
  method.choose(1e-3, 1e-4);
  EXPECT_STREQ(method.method().name, "verlet");
}

TEST(AutoMethod, ComesBackFromItsWords) {
  const double step = 1.0 / 30.0; // of no few digits
  AutoMethod before(LawKind::linear, false);
  before.choose(no_particles, step);
  AutoMethod after(LawKind::linear, false);
  after.choose(1.0, step);
  ASSERT_STREQ(after.method().name, "verlet");
  after.restore(before.words());
  EXPECT_STREQ(after.method().name, "impulse");
  after.choose(1.0, step); // the step is the same to the last bit
  EXPECT_STREQ(after.method().name, "impulse");
  after.restore({});
  EXPECT_STREQ(after.method().name, "impulse");
}

TEST(AutoMethod, SaysWhy) {
  AutoMethod method(LawKind::linear, true);
  EXPECT_EQ(method.reason(3e-4), "verlet, the host's own step, is right for any use and cheapest up to dt = 1e-05, "
                                 "nt = 30; impulse at fewer steps");
  EXPECT_EQ(method.reason(no_particles),
            "verlet, the host's own step, is right for any use and cheapest from nt = 30 on, looked at when a run "
            "begins with particles; impulse at fewer steps");
  EXPECT_EQ(AutoMethod(LawKind::any, false).reason(3e-4),
            "verlet, the host's own step, is all that was measured for this law; right for any use from nt = 6 on");
}

/// The launchers leave their option "-predict" in the environment.
class MethodChoice : public ::testing::Test {
protected:
  void TearDown() override { unsetenv("CFPM_PREDICT"); }
};

TEST_F(MethodChoice, IsThatOfTheCommandThenOfTheLauncherThenADefault) {
  EXPECT_EQ(chosen_name("rk4", Command::suffixed), "rk4");
  EXPECT_EQ(chosen_name(std::nullopt, Command::suffixed), "auto");
  EXPECT_EQ(chosen_name(std::nullopt, Command::named), "");
  setenv("CFPM_PREDICT", "impulse", 1);
  EXPECT_EQ(chosen_name("rk4", Command::suffixed), "rk4");
  EXPECT_EQ(chosen_name(std::nullopt, Command::suffixed), "impulse");
  EXPECT_EQ(chosen_name(std::nullopt, Command::named), "impulse");
  setenv("CFPM_PREDICT", "", 1);
  EXPECT_EQ(chosen_name(std::nullopt, Command::suffixed), "auto");
}

TEST_F(MethodChoice, NamesWhatThereIsForTheLaw) {
  std::vector<std::string> none;
  const KeywordOptions words(none, 0, [](const std::string &what) { throw std::runtime_error(what); });
  EXPECT_EQ(method_of("auto", true, LawKind::any, "model 'x'", words), nullptr);
  EXPECT_EQ(method_of("", true, LawKind::linear, "model 'x'", words), &default_method(LawKind::linear));
  EXPECT_EQ(method_of("none", true, LawKind::any, "model 'x'", words), find_method("verlet"));
  const auto message = [&](const char *name, LawKind law, bool of_pairs = true) -> std::string {
    try {
      method_of(name, of_pairs, law, "model 'x'", words);
    } catch (const std::runtime_error &error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(message("euler", LawKind::any),
            "unknown predictor 'euler'; expected one of exact, trapezoid, rk2, rk4, impulse, verlet, auto");
  EXPECT_EQ(message("exact", LawKind::any),
            "predictor 'exact' has no form for model 'x'; expected one of rk2, rk4, verlet, auto");
  EXPECT_EQ(message("exact", LawKind::any, false),
            "predictor 'exact' has no form for model 'x'; expected one of rk2, rk4, verlet");
  EXPECT_EQ(message("auto", LawKind::any, false), "'predict auto' belongs to the pair style, which walls follow");
}

} // namespace
} // namespace cfpm
