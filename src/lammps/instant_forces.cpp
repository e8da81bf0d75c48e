// SPDX-License-Identifier: GPL-2.0-or-later
#include "instant_forces.h"

#include "host_versions.h"

#include "core/law/coulomb.h"
#include "core/law/linear_law.h"
#include "core/law/pair_material.h"
#include "core/method/conventional/force_of_instant.h"
#include "core/method/conventional/granular_sub_models.h"
#include "core/method/conventional/limited_with_dashpot.h"
#include "core/method/conventional/turned_spring.h"
#include "core/numbers/instruction_set.h"
#include "core/step/packed_pairs.h"

#include <algorithm>
#include <type_traits>

namespace cfpm::lammps {

namespace {

/// Law of two bodies, and what makes it of any sizes, see made_steps.h: damping goes with the reduced mass.
template <class Growth> struct InstantLawOfHost {
  using Law = LimitedWithDashpot<Growth, double>;
  template <class R> using Material = PairMaterial<R>;
  template <class R> using Step = LimitedWithDashpot<Growth, R>;

  const ContactArguments &arguments;
  double dt; ///< by which springs move on [s]

  PairMaterial<double> material(int, int) const { return arguments.material(); }
  template <class R>
  [[gnu::always_inline]] bool make(const PairMaterial<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    step = {material.normal_stiffness,
            sizes.reduced_mass * material.normal_damping,
            material.tangential_stiffness,
            sizes.reduced_mass * material.tangential_damping,
            material.friction,
            material.least_force,
            dt};
    return true;
  }
  ParametersOfInstant<Law> operator()(const ContactPartners &p) const {
    ParametersOfInstant<Law> parameters;
    make(material(p.type_i, p.type_j), sizes_of(p), parameters.law);
    return parameters;
  }
  const InstantLawOfHost &maker() const { return *this; }
};

template <class R> using Turned = TurnedSpring<granular_order, R>;
template <class R> using RollingTurned = RollingTurnedSpring<granular_order, R>;
template <class R> using TurnedWithSubModels = TurnedSpringWithSubModels<granular_order, R>;

/// Coefficients of rolling, see RollingTurnedSpring.
template <class R> struct RollingMaterial { R stiffness, damping, friction; };

/// The same of the host's granular. L: Turned, RollingTurned or TurnedWithSubModels.
template <template <class> class L> struct InstantLawOfGranular {
  using Law = L<double>;
  static constexpr bool rolls = resists_rolling<Law>;
  static constexpr bool has_sub_models = resists_twisting<Law>;
  template <class R> using Step = L<R>;
  template <class R> struct Material {
    GranularMaterial<R> contact;
    std::conditional_t<has_sub_models, GranularSubModels<R>, RollingMaterial<R>> more;
  };

  const GranularPairs &coefficients;
  double dt; ///< by which springs move on [s]

  Material<double> material(int type_i, int type_j) const {
    const GranularCoefficients &c = of_types(coefficients, type_i, type_j);
    if constexpr (has_sub_models)
      return {material_of(c), sub_models_of(c)};
    else
      return {material_of(c), {c.rolling_stiffness, c.rolling_damping, c.rolling_friction}};
  }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    const R reduced_radius = sizes.radius_i * sizes.radius_j / (sizes.radius_i + sizes.radius_j);
    const Turned<R> contact{material.contact, reduced_radius, sizes.reduced_mass, dt};
    if constexpr (has_sub_models)
      step = {contact, material.more};
    else if constexpr (rolls)
      step = {contact, material.more.stiffness, material.more.damping, material.more.friction};
    else
      step = contact;
    return true;
  }
  ParametersOfInstant<Law> operator()(const ContactPartners &p) const {
    ParametersOfInstant<Law> parameters;
    make(material(p.type_i, p.type_j), sizes_of(p), parameters.law);
    return parameters;
  }
  const InstantLawOfGranular &maker() const { return *this; }
};

template <Friction friction, class LawOf>
void add_forces(const LawOf &law_of, const Particles &particles, const PairList &pairs, const Tally &tally) {
  const auto told = [&](int i, int j, const Vec3 &force, const Vec3 &separation) {
    if (tally) tally(i, j, force, separation);
  };
  const ForceOfInstant method(law_of);
  PackedPairs<friction, decltype(method), decltype(told)>(instruction_set().lanes, particles, pairs, method, told)
      .add_forces();
}

} // namespace

void add_instant_forces(const ContactArguments &arguments, const Particles &particles, const PairList &pairs, double dt,
                        const Tally &tally) {
  constexpr Friction full = Friction::spring_and_dashpot;
  const InstantLawOfHost<HookeGrowth> hooke{arguments, dt};
  if (arguments.hertz)
    add_forces<full>(InstantLawOfHost<HertzGrowth>{arguments, dt}, particles, pairs, tally);
  else if (arguments.history)
    add_forces<full>(hooke, particles, pairs, tally);
  else
    add_forces<Friction::dashpot>(hooke, particles, pairs, tally);
}

InstantLoop instant_loop(const GranularPairs &coefficients) {
  const GranularCoefficients &first = coefficients.begin()->second;
  const bool more = std::any_of(coefficients.begin(), coefficients.end(), [&](const auto &pair) {
    const GranularCoefficients &c = pair.second;
    return has_more_sub_models(c) || c.has_spring != first.has_spring || c.rolls != first.rolls;
  });
  return more ? InstantLoop::sub_models : first.rolls ? InstantLoop::rolling : InstantLoop::plain;
}

void add_instant_forces(const GranularPairs &coefficients, InstantLoop loop, const Particles &particles,
                        const PairList &pairs, double dt, const Tally &tally) {
  constexpr Friction full = Friction::spring_and_dashpot;
  const InstantLawOfGranular<Turned> plain{coefficients, dt};
  const InstantLawOfGranular<TurnedWithSubModels> with_sub_models{coefficients, dt};
  if (loop == InstantLoop::sub_models && pairs.flags)
    add_forces<full>(with_sub_models, particles, pairs, tally);
  else if (loop == InstantLoop::sub_models)
    add_forces<Friction::dashpot>(with_sub_models, particles, pairs, tally);
  else if (loop == InstantLoop::rolling)
    add_forces<full>(InstantLawOfGranular<RollingTurned>{coefficients, dt}, particles, pairs, tally);
  else if (pairs.flags)
    add_forces<full>(plain, particles, pairs, tally);
  else
    add_forces<Friction::dashpot>(plain, particles, pairs, tally);
}

} // namespace cfpm::lammps
