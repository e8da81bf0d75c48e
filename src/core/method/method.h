// SPDX-License-Identifier: GPL-2.0-or-later
// The methods by name: what a deck chooses with "predict". Each is a type that says what it needs; its row in the table
// says the same to code that is not compiled for it.
#pragma once

#include "core/law/law_kind.h"
#include "core/law/linear_law.h"
#include "core/predict/predictor.h"
#include "core/predict/right_from.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace cfpm {

struct Method {
  const char *name;     ///< as written in a deck after the keyword "predict"
  LawKind most_general; ///< that it is known for (Table 3)
  double stable_below;  ///< the whole step is stable for an undamped contact while t* = dt/tc is below
  RightFrom right_from; ///< as measured without onset
  RightFrom right_from_with_onset;
  bool predicted;    ///< gives means over the coming step, which fix nve/cfpm integrates; else forces of one instant
  bool onset;        ///< contacts begin inside the step if the deck does not say, see begins_inside()
  bool wants_crowd;  ///< asks how many contacts hold a body, see Crowd
  int spring_values; ///< that a contact carries from step to step for its tangential spring

  bool predicts(LawKind law) const { return predicted && law <= most_general; }
};

/// The paper's: the mean of the force now and the force that the predictor finds for the end of the step.
template <class P> struct PredictedForce {
  static constexpr Method method{
      P::name, P::most_general, P::stable_below, P::right_from, P::right_from_with_onset, true, false, false, 3};
};

/// Beyond the paper: not the force at the end of the step but the impulse over it, with the beginning and the end of
/// the contact inside the step, from the exact solution. One contact is right at any step.
struct PredictedImpulse {
  static constexpr Method method{"impulse",
                                 LawKind::viscoelastic,
                                 std::numeric_limits<double>::infinity(),
                                 {1.0, 2.0, 4.0},
                                 {1.0, 2.0, 4.0},
                                 true,
                                 true,
                                 true,
                                 6};

  /// From which nt = tc/dt on impacts that meet never raise kinetic and elastic energy together, at a restitution e in
  /// [0, 1]. A body that was alone in the step before is hit as if it still were: that gains, as found with rows and
  /// blocks of spheres without damping, about 1/nt^2 of the energy of a blow (more below nt = 4), while damping takes
  /// in proportion to 1 - e. See tests/core/test_row_of_balls.cpp, tests/lammps/test_energy.py.
  static double keeps_energy_from(double e) { return std::max(4.0, std::sqrt(2.0 / (1.0 - std::min(e, 1.0)))); }
};

/// The host's own conventional step: its velocity Verlet with its force of one instant.
struct Verlet {
  static constexpr Method method{"verlet", LawKind::any, 2.0 / pi, {6.0, 6.0, 6.0}, {}, false, false, false, 3};
  /// Where friction has a dashpot that Coulomb's limit holds too, as in LAMMPS: the dashpot is then what beds are made
  /// of, and it is sampled once a step.
  static constexpr RightFrom right_from_with_dashpot{30.0, 10.0, 6.0};
  static constexpr const char *other_name = "none";
};

/// Onset: whether contacts begin and end inside a step, at their touch and where they part, or are found and left late,
/// at the next step. onset: what the deck says, if it does.
inline bool begins_inside(const Method &method, std::optional<bool> onset) {
  return method.predicted && onset.value_or(method.onset);
}

/// damped_friction: whether the law's friction has a dashpot that Coulomb's limit holds together with the spring.
inline const RightFrom &right_from(const Method &method, bool damped_friction, bool begins_inside) {
  if (begins_inside) return method.right_from_with_onset;
  return damped_friction && !method.predicted ? Verlet::right_from_with_dashpot : method.right_from;
}

template <class... M> struct MethodList {
  static constexpr std::array<const Method *, sizeof...(M)> table{&M::method...};

  /// Calls use(M{}) with the type of a method of the table.
  template <class Use> static void visit(const Method &method, const Use &use) {
    const auto offer = [&](auto m) {
      if (&method == &decltype(m)::method) use(m);
    };
    (offer(M{}), ...);
  }
};

template <class> struct MethodsOf;
template <class... P> struct MethodsOf<PredictorList<P...>> {
  using type = MethodList<PredictedForce<P>..., PredictedImpulse, Verlet>;
};
using Methods = MethodsOf<Predictors>::type;

/// The method of that name, or nullptr.
inline const Method *find_method(std::string_view name) {
  if (name == Verlet::other_name) return &Verlet::method;
  for (const Method *m : Methods::table)
    if (name == m->name) return m;
  return nullptr;
}

/// The most accurate one of the paper's for the law.
inline const Method &default_method(LawKind law) {
  return law == LawKind::linear ? PredictedForce<Exact>::method : PredictedForce<RungeKutta4>::method;
}

/// At a wall that does not say its own: that of the pairs, or the default of the wall's law where it has no form for
/// it.
inline const Method &method_at_wall(const Method &of_pairs, LawKind law) {
  return !of_pairs.predicted || of_pairs.predicts(law) ? of_pairs : default_method(law);
}

/// "exact, trapezoid, rk2, rk4, impulse, verlet", or of these what is known for the law, for messages.
inline std::string method_names(LawKind law = LawKind::linear) {
  std::string names;
  for (const Method *m : Methods::table)
    if (law <= m->most_general) names += (names.empty() ? "" : ", ") + std::string(m->name);
  return names;
}

} // namespace cfpm
