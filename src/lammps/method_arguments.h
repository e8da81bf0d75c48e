// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/method_choice.h"
#include "core/deck/method_options.h"
#include "core/method/method.h"

#include <optional>
#include <string>

namespace cfpm::lammps {

enum class ContactOwner { pairs, wall };

/// What the command of a pair style or a wall says of the method.
struct MethodArguments {
  bool method_given = false; ///< with "predict X"
  bool automatic = false;    ///< "predict auto": the pair style chooses
  const Method *method = nullptr;
  MethodOptions options; ///< given with "split c" and "onset on|off", by a pair style only
};

/// Takes "predict X" and its options out of a command, wherever they stand. model: what the deck calls the law, for
/// messages; made: how the words came about.
inline MethodArguments take_method_arguments(KeywordOptions &words, ContactOwner owner, LawKind law,
                                             const std::string &model, Command made) {
  const bool of_pairs = owner == ContactOwner::pairs;
  MethodArguments taken;
  const std::optional<std::string> given = words.take("predict", expected_names(of_pairs, law));
  const std::string name = of_pairs ? chosen_name(given, made) : given.value_or("");
  taken.method_given = given.has_value();
  taken.method = method_of(name, of_pairs, law, model, words);
  taken.automatic = !taken.method;
  if (taken.automatic) taken.method = &AutoMethod::at_few_steps(law);
  taken.options = take_method_options(words, !of_pairs, taken.method->wants_crowd, taken.method->predicted);
  return taken;
}

} // namespace cfpm::lammps
