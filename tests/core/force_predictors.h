// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "predictor.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace cfpm::testing {

/// Those of the paper, which predict the force at the end of the step.
inline std::vector<Predictor> force_predictors() {
  std::vector<Predictor> found;
  std::copy_if(predictors.begin(), predictors.end(), std::back_inserter(found),
               [](const Predictor &p) { return !p.impulse; });
  return found;
}

} // namespace cfpm::testing
