// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

namespace cfpm {

/// The number that a word of a command is. Empty unless it is a decimal one and nothing else: the C library would also
/// take words such as "nan" and "inf", hexadecimal numbers, and one that is too large, "1e999", as infinity.
inline std::optional<double> finite_number(const std::string &word) {
  if (word.empty() || word.find_first_not_of("0123456789+-.eE") != std::string::npos) return std::nullopt;
  char *end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

} // namespace cfpm
