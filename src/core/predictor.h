// SPDX-License-Identifier: GPL-2.0-or-later
// The predictors by name. A new one is its own file and one entry in the list below.
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
  bool any_law;        ///< predicts every contact law, not only the linear one (Table 3)
};

template <class... P> struct PredictorList {
  static constexpr std::array table{Predictor{P::name, &make_propagator<P>, P::stable_below, P::any_law}...};

  /// Calls use(P{}) for that predictor if it predicts any law, else nothing.
  template <class Use> static void for_any_law(const Predictor &predictor, const Use &use) {
    const auto offer = [&](auto p) {
      if constexpr (decltype(p)::any_law)
        if (predictor.propagator == &make_propagator<decltype(p)>) use(p);
    };
    (offer(P{}), ...);
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

/// The most accurate one for the law.
inline const Predictor *default_predictor(bool linear_law) { return find_predictor(linear_law ? "exact" : "rk4"); }

/// "exact, trapezoid, rk2, rk4", or of these what predicts the law, for messages.
inline std::string predictor_names(bool linear_law = true) {
  std::string names;
  for (const Predictor &p : predictors)
    if (linear_law || p.any_law) names += (names.empty() ? "" : ", ") + std::string(p.name);
  return names;
}

} // namespace cfpm
