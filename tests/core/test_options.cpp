// SPDX-License-Identifier: GPL-2.0-or-later
// Options of a host's command: what is taken, what is left, and that an error names the option, what was found and
// what was expected.
#include "core/deck/method_options.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace cfpm::testing {
namespace {

using Words = std::vector<std::string>;

struct Failed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The message of the error that the action ends with; empty without one.
template <class Action> std::string error(const Words &words, const Action &action) {
  Words copy = words;
  KeywordOptions options(copy, 1, [](const std::string &what) { throw Failed(what); });
  try {
    action(options);
  } catch (const Failed &failed) {
    return failed.what();
  }
  return {};
}

MethodOptions taken(Words &words) {
  KeywordOptions options(words, 1, [](const std::string &what) { throw Failed(what); });
  return take_method_options(options, false, true, true);
}

std::string method_error(const Words &words, bool is_wall = false, bool impulses = true, bool predicted = true) {
  return error(words, [&](KeywordOptions &options) { take_method_options(options, is_wall, impulses, predicted); });
}

TEST(KeywordOptions, TakesAKeywordAndItsValueFromAnywhere) {
  Words words{"predict", "a", "predict", "exact", "b"};
  KeywordOptions options(words, 1, [](const std::string &what) { throw Failed(what); });
  EXPECT_TRUE(options.has("predict"));
  EXPECT_EQ(options.take("predict", "a name"), "exact"); // the first word is not among them
  EXPECT_EQ(words, (Words{"predict", "a", "b"}));
  EXPECT_FALSE(options.has("predict"));
  EXPECT_EQ(options.take("predict", "a name"), std::nullopt);
}

TEST(KeywordOptions, NamesWhatIsMissing) {
  EXPECT_EQ(error({"x", "a", "predict"}, [](KeywordOptions &o) { o.take("predict", "exact or rk4"); }),
            "missing value after 'predict'; expected exact or rk4");
}

TEST(KeywordOptions, RefusesAKeywordGivenTwice) {
  EXPECT_EQ(error({"x", "split", "1", "split", "0"}, [](KeywordOptions &o) { o.take("split", "a number"); }),
            "'split' given twice; expected it once");
}

TEST(MethodOptions, AreTakenOut) {
  Words words{"x", "split", "0.25", "other", "onset", "off"};
  const MethodOptions options = taken(words);
  EXPECT_EQ(options.split, 0.25);
  EXPECT_EQ(options.onset, false);
  EXPECT_EQ(words, (Words{"x", "other"}));
}

TEST(MethodOptions, HaveDefaults) {
  Words words{"x"};
  EXPECT_EQ(taken(words).split, 0.0);
  EXPECT_EQ(taken(words).onset, std::nullopt);
  words = {"x", "onset", "on", "split", "1"};
  const MethodOptions options = taken(words);
  EXPECT_EQ(options.split, 1.0); // the limits belong to it
  EXPECT_EQ(options.onset, true);
}

TEST(MethodOptions, NameWhatWasFoundAndExpected) {
  for (const std::string bad : {"-0.1", "1.1", "nan", "half", "0.5x"})
    EXPECT_EQ(method_error({"x", "split", bad}), "split is '" + bad + "'; expected a number from 0 to 1");
  EXPECT_EQ(method_error({"x", "onset", "yes"}), "onset is 'yes'; expected on or off");
  EXPECT_EQ(method_error({"x", "onset"}), "missing value after 'onset'; expected on or off");
  EXPECT_EQ(method_error({"x", "split"}), "missing value after 'split'; expected a number from 0 to 1");
}

TEST(MethodOptions, BelongToThePairStyleAndToItsMethod) {
  for (const std::string option : {"split", "onset"})
    EXPECT_EQ(method_error({"x", option, "1"}, true), "'" + option + "' belongs to the pair style, which walls follow");
  EXPECT_EQ(method_error({"x", "split", "1"}, false, false), "'split' goes with 'predict impulse' only");
  EXPECT_EQ(method_error({"x", "onset", "on"}, false, false, false),
            "'onset' goes with predicted contacts, not with 'predict verlet'");
  EXPECT_EQ(method_error({"x", "onset", "on"}, false, false), "");
  EXPECT_EQ(method_error({"x"}, true), "");
  EXPECT_EQ(method_error({"x"}, false, false, false), "");
}

} // namespace
} // namespace cfpm::testing
