// SPDX-License-Identifier: GPL-2.0-or-later
// The paper's predictors by name. A new one is its own file and one entry in the list below.
#pragma once

#include "core/law/law_kind.h"
#include "core/motion/oscillator.h"
#include "core/predict/exact.h"
#include "core/predict/rk2.h"
#include "core/predict/rk4.h"
#include "core/predict/trapezoid.h"

#include <array>
#include <string_view>

namespace cfpm {

/// A rule for the state of two isolated bodies at the end of a step.
struct Predictor {
  const char *name;
  Propagator (*propagator)(const Oscillator &, double dt); ///< of the linear law
  double stable_below;  ///< the whole step is stable for an undamped contact while t* = dt/tc is below
  LawKind most_general; ///< that it predicts (Table 3)

  bool predicts(LawKind law) const { return law <= most_general; }
};

template <class P> inline constexpr Predictor predictor{P::name, &make_propagator<P>, P::stable_below, P::most_general};

template <class... P> struct PredictorList { static constexpr std::array table{predictor<P>...}; };

using Predictors = PredictorList<Exact, Trapezoid, RungeKutta2, RungeKutta4>;

inline constexpr auto &predictors = Predictors::table;

/// The predictor of that name, or nullptr.
inline const Predictor *find_predictor(std::string_view name) {
  for (const Predictor &p : predictors)
    if (name == p.name) return &p;
  return nullptr;
}

} // namespace cfpm
