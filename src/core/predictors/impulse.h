// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "exact.h"

#include <limits>

namespace cfpm {

/// Beyond the paper: not the force at the end of the step but the impulse over it, with the beginning and the end of
/// the contact inside the step, from the same exact solution.
struct Impulse : Exact {
  static constexpr const char *name = "impulse";
  static constexpr bool impulse = true;
  /// One contact is right at any step.
  static constexpr double stable_below = std::numeric_limits<double>::infinity();
  static constexpr double bed_nt = 3.0;
};

} // namespace cfpm
