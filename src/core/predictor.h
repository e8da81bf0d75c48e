// SPDX-License-Identifier: GPL-2.0-or-later
// The predictors by name. A new one is its own file and one entry in the list below.
#pragma once

#include "law_kind.h"
#include "oscillator.h"
#include "predictors/exact.h"
#include "predictors/impulse.h"
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
  double stable_below;  ///< the whole step is stable for an undamped contact while t* = dt/tc is below
  double bed_nt;        ///< steps per contact time from which on packings come out right, as measured
  LawKind most_general; ///< that it predicts (Table 3)
  bool impulse;         ///< gives the impulse of a contact in place of the force at the end of the step

  bool predicts(LawKind law) const { return law <= most_general; }
};

template <class... P> struct PredictorList {
  static constexpr std::array table{
      Predictor{P::name, &make_propagator<P>, P::stable_below, P::bed_nt, P::most_general, P::impulse}...};

  /// Calls use(P{}) for that predictor if it predicts any law, else nothing.
  template <class Use> static void for_any_law(const Predictor &predictor, const Use &use) {
    const auto offer = [&](auto p) {
      if constexpr (decltype(p)::most_general == LawKind::any)
        if (predictor.propagator == &make_propagator<decltype(p)>) use(p);
    };
    (offer(P{}), ...);
  }
};

using Predictors = PredictorList<Exact, Trapezoid, RungeKutta2, RungeKutta4, Impulse>;

inline constexpr auto &predictors = Predictors::table;

/// The predictor of that name, or nullptr.
inline const Predictor *find_predictor(std::string_view name) {
  for (const Predictor &p : predictors)
    if (name == p.name) return &p;
  return nullptr;
}

/// The most accurate one of the paper's for the law.
inline const Predictor *default_predictor(LawKind law) {
  return find_predictor(law == LawKind::linear ? "exact" : "rk4");
}

/// "exact, trapezoid, rk2, rk4, impulse", or of these what predicts the law, for messages.
inline std::string predictor_names(LawKind law = LawKind::linear) {
  std::string names;
  for (const Predictor &p : predictors)
    if (p.predicts(law)) names += (names.empty() ? "" : ", ") + std::string(p.name);
  return names;
}

} // namespace cfpm
