// SPDX-License-Identifier: GPL-2.0-or-later
// The predictors by name. A new one is its own file and one line in the table below.
#pragma once

#include "oscillator.h"
#include "predictors/exact.h"
#include "predictors/rk2.h"
#include "predictors/rk4.h"
#include "predictors/trapezoid.h"

#include <array>
#include <string>
#include <string_view>

namespace cfpm {

struct Predictor {
  const char *name; ///< as written in a deck after the keyword "predict"
  Propagator (*propagator)(const Oscillator &, double dt);
  double stable_below; ///< the whole step is stable for an undamped contact while t* = dt/tc is below
};

template <class P> constexpr Predictor describe() { return {P::name, &make_propagator<P>, P::stable_below}; }

inline constexpr std::array predictors{
    describe<Exact>(),
    describe<Trapezoid>(),
    describe<RungeKutta2>(),
    describe<RungeKutta4>(),
};

/// The predictor of that name, or nullptr.
inline const Predictor *find_predictor(std::string_view name) {
  for (const Predictor &p : predictors)
    if (name == p.name) return &p;
  return nullptr;
}

/// "exact, trapezoid, rk2, rk4", for messages.
inline std::string predictor_names() {
  std::string names;
  for (const Predictor &p : predictors) names += (names.empty() ? "" : ", ") + std::string(p.name);
  return names;
}

} // namespace cfpm
