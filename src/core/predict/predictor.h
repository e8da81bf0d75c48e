// SPDX-License-Identifier: GPL-2.0-or-later
// The paper's predictors by name. A new one is its own file and one entry in the list below.
#pragma once

#include "core/law/law_kind.h"
#include "core/motion/flow_by_series.h"
#include "core/motion/oscillator.h"
#include "core/predict/exact.h"
#include "core/predict/rk2.h"
#include "core/predict/rk4.h"
#include "core/predict/trapezoid.h"

#include <array>
#include <string_view>
#include <type_traits>

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

/// The map of a predictor P over numbers R, doubles or packs: of the exact solution by series, else to the last bit
/// that of its entry in the table.
template <class P, class R>
[[gnu::always_inline]] inline BasicPropagator<R> propagator_in_packs(const BasicOscillator<R> &o, const R &dt) {
  if constexpr (std::is_same_v<P, Exact>)
    return flow_by_series(o, dt);
  else
    return map_of_unit_states<P>(o, dt);
}

template <class... P> struct PredictorList {
  static constexpr std::array table{predictor<P>...};

  /// The same of one of them.
  template <class R> [[gnu::always_inline]] static BasicPropagator<R>
  propagator_in_packs(const Predictor &chosen, const BasicOscillator<R> &o, const R &dt) {
    BasicPropagator<R> map{};
    (void)((chosen.propagator == &make_propagator<P> && (map = cfpm::propagator_in_packs<P>(o, dt), true)) || ...);
    return map;
  }
};

using Predictors = PredictorList<Exact, Trapezoid, RungeKutta2, RungeKutta4>;

inline constexpr auto &predictors = Predictors::table;

/// The predictor of that name, or nullptr.
inline const Predictor *find_predictor(std::string_view name) {
  for (const Predictor &p : predictors)
    if (name == p.name) return &p;
  return nullptr;
}

} // namespace cfpm
