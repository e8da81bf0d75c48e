// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/keyword_options.h"
#include "core/method/auto_method.h"

#include <cstdlib>
#include <optional>
#include <string>

namespace cfpm {

/// How the command of a pair style came about.
enum class Command {
  named,   ///< the deck names a style of the plugin
  suffixed ///< it names one of the host, which "-suffix cfpm" has made one of the plugin
};

/// The name of what pairs are predicted with, "" for the default of their law. given: the word behind "predict" in
/// their command. Without it that of the option "-predict" of the launchers counts, which they leave in the
/// environment; without that too it is auto if the deck is not made for the plugin.
inline std::string chosen_name(const std::optional<std::string> &given, Command command) {
  const char *const option = std::getenv("CFPM_PREDICT");
  if (given) return *given;
  if (option && *option) return option;
  return command == Command::suffixed ? AutoMethod::name : "";
}

/// What may stand behind "predict", for messages.
inline std::string expected_names(bool of_pairs, LawKind law = LawKind::linear) {
  return "one of " + method_names(law) + (of_pairs ? std::string(", ") + AutoMethod::name : "");
}

/// The method of a name for a law, null for auto; that of pairs is a chosen_name(). model: what the deck calls the law,
/// for messages, with which words.fail() ends the run where there is no such method.
inline const Method *method_of(const std::string &name, bool of_pairs, LawKind law, const std::string &model,
                               const KeywordOptions &words) {
  if (name.empty()) return &default_method(law);
  if (name == AutoMethod::name && !of_pairs) words.fail("'predict auto' belongs to the pair style, which walls follow");
  if (name == AutoMethod::name) return nullptr;
  const Method *const method = find_method(name);
  if (!method) words.fail("unknown predictor '" + name + "'; expected " + expected_names(of_pairs));
  if (method->predicted && !method->predicts(law))
    words.fail("predictor '" + name + "' has no form for " + model + "; expected " + expected_names(of_pairs, law));
  return method;
}

} // namespace cfpm
