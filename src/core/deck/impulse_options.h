// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/finite_number.h"
#include "core/deck/keyword_options.h"

#include <optional>
#include <string>

namespace cfpm {

/// What "predict impulse" of a pair style does, also at its walls.
struct ImpulseOptions {
  double split = 0.0; ///< c: a particle with n contacts gives each of them its mass over 1 + c (n - 1)
  bool onset = true;  ///< contacts begin inside a step
};

/// Takes "split c" and "onset on|off" out of a command. impulse: whether it says "predict impulse".
inline ImpulseOptions take_impulse_options(KeywordOptions &words, bool is_wall, bool impulse) {
  for (const std::string keyword : {"split", "onset"}) {
    if (!words.has(keyword)) continue;
    if (is_wall) words.fail("'" + keyword + "' belongs to the pair style, which walls follow");
    if (!impulse) words.fail("'" + keyword + "' goes with 'predict impulse' only");
  }
  ImpulseOptions options;
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
