// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

namespace cfpm {

/// The number that a word of a command is, or nothing. Both hosts take words of digits, signs, points and e or E only,
/// which leaves out nan, inf, hexadecimal numbers and blanks, all of which strtod would take. Beyond that the word must
/// be a number to its end, where the hosts read 5e as 5, and a finite one, where they read 1e999 as infinite.
inline std::optional<double> finite_number(const std::string &word) {
  if (word.empty() || word.find_first_not_of("0123456789+-.eE") != std::string::npos) return std::nullopt;
  char *end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

} // namespace cfpm
