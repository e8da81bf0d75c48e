// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/finite_number.h"
#include "core/deck/keyword_options.h"

#include <optional>
#include <string>

namespace cfpm {

/// What the deck says of the method of a pair style, also at its walls.
struct MethodOptions {
  double split = 0.0;        ///< c: a particle with n contacts gives each of them its mass over 1 + c (n - 1)
  std::optional<bool> onset; ///< see begins_inside()
};

/// Takes "split c" and "onset on|off" out of a command. impulses: whether it may come to give them; predicted: whether
/// it may come to predict.
inline MethodOptions take_method_options(KeywordOptions &words, bool is_wall, bool impulses, bool predicted) {
  for (const std::string keyword : {"split", "onset"})
    if (is_wall && words.has(keyword)) words.fail("'" + keyword + "' belongs to the pair style, which walls follow");
  if (!impulses && words.has("split")) words.fail("'split' goes with 'predict impulse' only");
  if (!predicted && words.has("onset")) words.fail("'onset' goes with predicted contacts, not with 'predict verlet'");
  MethodOptions options;
  if (const auto split = words.take("split", "a number from 0 to 1")) {
    options.split = finite_number(*split).value_or(-1.0);
    if (options.split < 0.0 || options.split > 1.0)
      words.fail("split is '" + *split + "'; expected a number from 0 to 1");
  }
  if (const auto onset = words.take("onset", "on or off")) {
    if (*onset != "on" && *onset != "off") words.fail("onset is '" + *onset + "'; expected on or off");
    options.onset = *onset == "on";
  }
  return options;
}

} // namespace cfpm
