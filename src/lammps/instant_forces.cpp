// SPDX-License-Identifier: GPL-2.0-or-later
#include "instant_forces.h"

#include "core/law/coulomb.h"
#include "core/law/linear_law.h"
#include "core/law/pair_material.h"
#include "core/method/conventional/force_of_instant.h"
#include "core/method/conventional/limited_with_dashpot.h"
#include "core/numbers/instruction_set.h"
#include "core/step/packed_pairs.h"

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

template <class Growth> void add_forces(const ContactArguments &a, const Particles &particles, const PairList &pairs,
                                        double dt, const Tally &tally) {
  const InstantLawOfHost<Growth> law_of{a, dt};
  const auto told = [&](int i, int j, const Vec3 &force, const Vec3 &separation) {
    if (tally) tally(i, j, force, separation);
  };
  const ForceOfInstant method(law_of);
  PackedPairs<Friction::spring_and_dashpot, decltype(method), decltype(told)>(instruction_set().lanes, particles, pairs,
                                                                              method, told)
      .add_forces();
}

} // namespace

void add_instant_forces(const ContactArguments &arguments, const Particles &particles, const PairList &pairs, double dt,
                        const Tally &tally) {
  if (arguments.hertz)
    add_forces<HertzGrowth>(arguments, particles, pairs, dt, tally);
  else
    add_forces<HookeGrowth>(arguments, particles, pairs, dt, tally);
}

} // namespace cfpm::lammps
