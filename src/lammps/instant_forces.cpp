// SPDX-License-Identifier: GPL-2.0-or-later
#include "instant_forces.h"

#include "core/law/coulomb.h"
#include "core/law/linear_law.h"
#include "core/method/conventional/force_of_instant.h"
#include "core/method/conventional/limited_with_dashpot.h"
#include "core/numbers/instruction_set.h"
#include "core/step/packed_pairs.h"

namespace cfpm::lammps {

namespace {

template <class Growth> void add_forces(const ContactArguments &a, const Particles &particles, const PairList &pairs,
                                        double dt, const Tally &tally) {
  using Law = LimitedWithDashpot<Growth, double>;
  const auto law_of = [&](const ContactPartners &p) -> ParametersOfInstant<Law> {
    return {{a.kn, p.reduced_mass * a.gamma_n, a.kt, p.reduced_mass * a.gamma_t, a.xmu,
             a.limit_damping ? without_tension : with_tension, dt}};
  };
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
