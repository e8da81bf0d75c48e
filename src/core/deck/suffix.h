// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace cfpm {

/// By which hosts are told with "-suffix cfpm", or in a deck "suffix cfpm", to take predicted styles where there are
/// any.
constexpr const char *suffix = "cfpm";

/// Of a run without a predicted style, for the log. found: its pair style; predictable: pair styles that have one.
inline std::string nothing_to_predict(const std::string &found, const std::string &predictable) {
  return std::string("-suffix ") + suffix + " finds nothing to predict: pair_style " + found +
         " has no predicted form, so this is a run of the host's own styles; expected pair_style " + predictable;
}

/// Of a run whose particles are moved by another fix, here its name, than the one that -suffix cfpm takes.
inline std::string nothing_to_move(const std::string &found) {
  return std::string("-suffix ") + suffix + " finds nothing to predict: " + found +
         " moves the particles, so only the host's own step goes here; expected fix nve/sphere";
}

} // namespace cfpm
