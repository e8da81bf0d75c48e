// SPDX-License-Identifier: GPL-2.0-or-later
// The numbers of contacts between bodies of any sizes, made several at a time: where particles are of so many sizes
// that hardly two contacts have the same parameters, keeping those that were met is of no use. A maker says
//   material(type i, type j)     what all contacts of two materials share: a Material<double>, numbers alone
//   make(material, sizes, step)  the Step<R> of contacts; whether it says all that is asked of it, in all lanes
//   parameters(partners)         the same of one contact as parameters, to the last bit
// Where a law is known for any sizes: LawOf has material(type i, type j), a PairMaterial<double> or what else its
// template Material over a number is, and law(Material<R>, PairSizes<R>), the law over R.
#pragma once

#include "core/contact/inertia.h"
#include "core/contact/parameter_cache.h"
#include "core/law/pair_material.h"
#include "core/method/forces/hertz_prediction.h"
#include "core/method/forces/integrated_prediction.h"
#include "core/method/forces/linear_prediction.h"
#include "core/method/impulses/hertz_impulse.h"
#include "core/method/impulses/linear_impulse.h"
#include "core/method/impulses/soft_in_crowd.h"
#include "core/method/impulses/viscoelastic_impulse.h"
#include "core/numbers/pack.h"
#include "core/predict/predictor.h"

#include <type_traits>
#include <utility>

namespace cfpm {

/// Whether a host's law is known for any sizes, see above.
template <class LawOf, class = void> inline constexpr bool knows_sizes = false;
template <class LawOf>
inline constexpr bool knows_sizes<LawOf, std::void_t<decltype(std::declval<const LawOf &>().material(1, 1))>> = true;

/// What belongs to two materials, see above. R: double, or a Pack of several contacts' numbers.
template <class LawOf, class R, class = void> struct MaterialOfLaw { using type = PairMaterial<R>; };
template <class LawOf, class R> struct MaterialOfLaw<LawOf, R, std::void_t<typename LawOf::template Material<R>>> {
  using type = typename LawOf::template Material<R>;
};
template <class LawOf, class R> using MaterialOf = typename MaterialOfLaw<LawOf, R>::type;

/// What all makers have. dimension: 2 for discs; dt: of the step [s]
template <class LawOf> struct StepMaker {
  const LawOf &law_of;
  int dimension;
  double dt;

  auto law(const ContactPartners &p) const { return law_of.law(law_of.material(p.type_i, p.type_j), sizes_of(p)); }
  template <class R> [[gnu::always_inline]] R tangential_mass(const PairSizes<R> &sizes) const {
    return tangential_reduced_mass(sizes.reduced_mass, dimension);
  }
};

/// Of LinearPrediction.
template <class LawOf> struct LinearStepMaker : StepMaker<LawOf> {
  const Predictor &predictor;
  template <class R> using Material = MaterialOf<LawOf, R>;
  template <class R> using Step = BasicLinearStep<R>;

  Material<double> material(int type_i, int type_j) const { return this->law_of.material(type_i, type_j); }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    step = linear_step<R>(this->law_of.law(material, sizes), sizes.reduced_mass, this->tangential_mass(sizes),
                          predictor, this->dt);
    return true;
  }
  LinearPrediction parameters(const ContactPartners &p) const {
    Step<double> step;
    make(material(p.type_i, p.type_j), sizes_of(p), step);
    return {step, p.reduced_mass, this->tangential_mass(sizes_of(p)), predictor};
  }
};

/// Of IntegratedPrediction.
template <class LawOf, class Law> struct IntegratedStepMaker : StepMaker<LawOf> {
  template <class R> using Material = MaterialOf<LawOf, R>;
  template <class R> using Step = typename IntegratedPrediction<Law>::template Step<R>;

  Material<double> material(int type_i, int type_j) const { return this->law_of.material(type_i, type_j); }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    step = {this->law_of.law(material, sizes), 1.0 / sizes.reduced_mass, 1.0 / this->tangential_mass(sizes), this->dt};
    return true;
  }
  IntegratedPrediction<Law> parameters(const ContactPartners &p) const {
    return {this->law(p), p.reduced_mass, this->tangential_mass(sizes_of(p)), this->dt};
  }
};

/// Two materials whose contacts are all read from the same tables, as alpha and the damping ratios are theirs, whatever
/// the sizes. Solver: a ContactSolver, which keeps the tables.
template <class LawOf, class Solver> struct HertzMaker : StepMaker<LawOf> {
  Solver &solver;

  auto trajectory(int type_i, int type_j) const {
    const ContactPartners unit = of_unit_size(type_i, type_j);
    return solver.trajectory_of(this->law(unit), unit.reduced_mass);
  }
  HertzTables tables(int type_i, int type_j) const {
    const ContactPartners unit = of_unit_size(type_i, type_j);
    return solver.tables_of(this->law(unit), unit.reduced_mass, this->tangential_mass(sizes_of(unit)));
  }
};

/// Of HertzPrediction.
template <class LawOf, class Solver> struct HertzStepMaker : HertzMaker<LawOf, Solver> {
  template <class R> struct Material {
    MaterialOf<LawOf, R> law;
    BasicHertzTrajectory<R> trajectory;
  };
  template <class R> using Step = BasicHertzStep<R>;

  Material<double> material(int type_i, int type_j) const {
    return {this->law_of.material(type_i, type_j), this->trajectory(type_i, type_j)->tables()};
  }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    step = hertz_step<R>(this->law_of.law(material.law, sizes), material.trajectory, sizes.reduced_mass,
                         this->tangential_mass(sizes), this->dt);
    return true;
  }
  HertzPrediction parameters(const ContactPartners &p) const {
    return {this->law(p), this->trajectory(p.type_i, p.type_j), p.reduced_mass, this->tangential_mass(sizes_of(p)),
            this->dt};
  }
};

/// Of LinearImpulse.
template <class LawOf> struct LinearImpulseMaker : StepMaker<LawOf> {
  template <class R> using Material = MaterialOf<LawOf, R>;
  template <class R> using Step = LinearCrowdStep<R>;

  Material<double> material(int type_i, int type_j) const { return this->law_of.material(type_i, type_j); }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    const MadeLinearCrowdStep<R> made = linear_crowd_step<R>(this->law_of.law(material, sizes), sizes.reduced_mass,
                                                             this->tangential_mass(sizes), this->dt);
    step = made.step;
    return all(made.fits);
  }
  LinearImpulse parameters(const ContactPartners &p) const {
    const double tangential_mass = this->tangential_mass(sizes_of(p));
    const LinearLaw law = this->law(p);
    return {LinearImpulse(law, p.reduced_mass, tangential_mass, this->dt),
            linear_crowd_step(law, p.reduced_mass, tangential_mass, this->dt)};
  }
};

/// Of HertzImpulse.
template <class LawOf, class Solver> struct HertzImpulseMaker : HertzMaker<LawOf, Solver> {
  template <class R> struct Material {
    MaterialOf<LawOf, R> law;
    BasicHertzTrajectory<R> trajectory;
    BasicCrowdResponseTable<R> normal, slip;
  };
  template <class R> using Step = HertzCrowdStep<R>;

  Material<double> material(int type_i, int type_j) const {
    const HertzTables tables = this->tables(type_i, type_j);
    return {this->law_of.material(type_i, type_j), tables.trajectory->tables(), tables.normal->table(),
            tables.slip->table()};
  }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    step = hertz_crowd_step<R>(this->law_of.law(material.law, sizes), material.trajectory, material.normal,
                               material.slip, sizes.reduced_mass, this->tangential_mass(sizes), this->dt);
    return true;
  }
  HertzImpulse parameters(const ContactPartners &p) const {
    return {this->law(p), this->tables(p.type_i, p.type_j), p.reduced_mass, this->tangential_mass(sizes_of(p)),
            this->dt};
  }
};

/// Of ViscoelasticImpulse.
template <class LawOf> struct ViscoelasticImpulseMaker : StepMaker<LawOf> {
  template <class R> using Material = MaterialOf<LawOf, R>;
  template <class R> using Step = ViscoelasticCrowdStep<R>;

  Material<double> material(int type_i, int type_j) const { return this->law_of.material(type_i, type_j); }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    step = viscoelastic_crowd_step<R>(this->law_of.law(material, sizes), sizes.reduced_mass,
                                      this->tangential_mass(sizes), this->dt);
    return true;
  }
  ViscoelasticImpulse parameters(const ContactPartners &p) const {
    return {this->law(p), p.reduced_mass, this->tangential_mass(sizes_of(p)), this->dt};
  }
};

/// Of SoftInCrowd. Maker: of a LinearImpulse, HertzImpulse or ViscoelasticImpulse.
template <class Maker> struct SoftMaker {
  Maker now;    ///< over dt
  Maker before; ///< over the larger step
  template <class R> using Material = typename Maker::template Material<R>;
  template <class R> using Step = SoftCrowdStep<typename Maker::template Step<R>, R>;

  Material<double> material(int type_i, int type_j) const { return now.material(type_i, type_j); }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    const bool fits = before.make(material, sizes, step.larger);
    step.dt = now.dt;
    step.reduced_mass = sizes.reduced_mass;
    step.tangential_mass = now.tangential_mass(sizes);
    step.friction = step.larger.friction;
    step.part = now.dt / before.dt;
    return fits;
  }
  auto parameters(const ContactPartners &p) const { return SoftInCrowd(now.parameters(p), before.parameters(p)); }
};

} // namespace cfpm
