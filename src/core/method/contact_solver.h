// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/inertia.h"
#include "core/contact/parameter_cache.h"
#include "core/law/law_kind.h"
#include "core/method/forces/hertz_prediction.h"
#include "core/method/forces/integrated_prediction.h"
#include "core/method/forces/linear_prediction.h"
#include "core/method/forces/mean_of_two_forces.h"
#include "core/method/forces/mean_while_touching.h"
#include "core/method/impulses/exact_impulse.h"
#include "core/method/impulses/hertz_impulse.h"
#include "core/method/impulses/linear_impulse.h"
#include "core/method/impulses/soft_in_crowd.h"
#include "core/method/impulses/viscoelastic_impulse.h"
#include "core/method/made_steps.h"
#include "core/method/method.h"
#include "core/predict/predictor.h"

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

namespace cfpm {

/// What gives a method the parameters of two bodies: kept(partners) those that are kept, maker those made anew.
template <class Kept, class Maker> class KeptOrMade {
public:
  KeptOrMade(const Kept &kept, const Maker &maker) : kept_(kept), maker_(maker) {}

  decltype(auto) operator()(const ContactPartners &partners) const { return kept_(partners); }
  const Maker &maker() const { return maker_; }
  /// See parameters_of(); valid until the next call. Out of line: not compiled into every loop.
  [[gnu::noinline]] const auto &made(const ContactPartners &partners) const {
    return made_.emplace(maker_.parameters(partners));
  }

private:
  const Kept &kept_;
  Maker maker_;
  mutable std::optional<decltype(std::declval<const Maker &>().parameters(ContactPartners{}))> made_;
};

/// A contact law solved by the method that a deck has chosen, with the parameters of all contacts that it has met.
/// Law: LinearLaw, or one whose at(overlap) is a LinearLaw; LawOf: what gives it, which may know it for any sizes, see
/// made_steps.h; Among: the methods that it is compiled for.
template <class Law, class LawOf = std::function<Law(const ContactPartners &)>, class Among = Methods>
class ContactSolver {
public:
  /// law_of(partners): asked where parameters are not kept.
  explicit ContactSolver(LawOf law_of) : law_of_(std::move(law_of)) {}

  /// dimension: 2 for discs; begins_inside: whether contacts do. Forgets what it has kept; the method must be
  /// among those, and known for the law.
  void reset(const Method &method, int dimension, bool begins_inside) {
    method_ = &method;
    begins_inside_ = begins_inside;
    dimension_ = dimension;
    predictions_.clear();
    known_.clear();
    exact_.clear();
    soft_.clear();
    trajectories_.clear();
    responses_.clear();
  }

  /// Calls use() with the method for a step dt [s], a MeanOfTwoForces, MeanWhileTouching or ExactImpulse: the choice is
  /// made here, outside of any loop, so that a loop is compiled for each. These types depend on the law and what gives
  /// it alone, not on who uses them, so that it is compiled once for each.
  template <class Use> void with_method(double dt, const Use &use) { with_method(dt, dt, use); }
  /// The same where crowds answer over a larger step than dt, see SoftInCrowd [s].
  template <class Use> void with_method(double dt, double crowd_step, const Use &use) {
    if (crowd_step != crowd_step_) soft_.clear();
    crowd_step_ = crowd_step;
    Among::visit(*method_, [&](auto method) { solve(method, dt, use); });
  }

private:
  static constexpr bool linear = Law::law_kind == LawKind::linear;
  using Prediction = std::conditional_t<linear, LinearPrediction, IntegratedPrediction<Law>>;
  static constexpr bool viscoelastic = Law::law_kind == LawKind::viscoelastic;
  using Exactly =
      std::conditional_t<linear, LinearImpulse, std::conditional_t<viscoelastic, ViscoelasticImpulse, HertzImpulse>>;

  template <class, class> friend struct HertzMaker; // asks for tables

  /// Gives the parameters of two bodies over a step. member: which of those below.
  template <auto member> struct Kept {
    ContactSolver &solver;
    double dt;
    decltype(auto) operator()(const ContactPartners &partners) const { return (solver.*member)(partners, dt); }
  };

  /// Calls use() with what gives the parameters. make: returns their maker, where the law is known for any sizes.
  template <class Given, class Make, class Use> static void give(const Given &kept, const Make &make, const Use &use) {
    if constexpr (knows_sizes<LawOf>)
      use(KeptOrMade(kept, make()));
    else
      use(kept);
  }

  template <class P, class Use> void solve(PredictedForce<P>, double dt, const Use &use) {
    if constexpr (linear) {
      linear_predictor_ = &predictor<P>;
      solve_linear(dt, use);
    } else if constexpr (P::most_general == LawKind::any) {
      const auto make = [&] { return IntegratedStepMaker<LawOf, Law>{{law_of_, dimension_, dt}}; };
      give(Kept<&ContactSolver::prediction_of>{*this, dt}, make,
           [&](const auto &given) { use_means(given, PredictedBy<P>(), dt, use); });
    } else if constexpr (P::most_general == Law::law_kind) { // known from its one trajectory
      const auto make = [&] { return HertzStepMaker<LawOf, ContactSolver>{{{law_of_, dimension_, dt}, *this}}; };
      give(Kept<&ContactSolver::known_of>{*this, dt}, make,
           [&](const auto &given) { use_means(given, PredictedByParameters(), dt, use); });
    }
  }

  /// All predictors of a linear law differ in their coefficients alone: one loop for all.
  template <class Use> void solve_linear(double dt, const Use &use) {
    const auto make = [&] { return LinearStepMaker<LawOf>{{law_of_, dimension_, dt}, *linear_predictor_}; };
    give(Kept<&ContactSolver::prediction_of>{*this, dt}, make,
         [&](const auto &given) { use_means(given, PredictedByParameters(), dt, use); });
  }

  template <class ParametersOf, class At, class Use>
  void use_means(const ParametersOf &of, const At &at, double dt, const Use &use) {
    if (begins_inside_)
      use(MeanWhileTouching(of, at, dt));
    else
      use(MeanOfTwoForces(of, at));
  }

  template <class Use> void solve(PredictedImpulse, double dt, const Use &use) {
    if constexpr (Law::law_kind != LawKind::any) {
      const auto make = [&] { return impulse_maker(dt); };
      const auto make_soft = [&] { return SoftMaker<decltype(make())>{make(), impulse_maker(crowd_step_)}; };
      const auto use_impulse = [&](const auto &given) { use(ExactImpulse(given, dt)); };
      if (crowd_step_ > dt)
        give(Kept<&ContactSolver::soft_of>{*this, dt}, make_soft, use_impulse);
      else
        give(Kept<&ContactSolver::exact_of>{*this, dt}, make, use_impulse);
    }
  }

  auto impulse_maker(double dt) {
    if constexpr (linear)
      return LinearImpulseMaker<LawOf>{{law_of_, dimension_, dt}};
    else if constexpr (viscoelastic)
      return ViscoelasticImpulseMaker<LawOf>{{law_of_, dimension_, dt}};
    else
      return HertzImpulseMaker<LawOf, ContactSolver>{{{law_of_, dimension_, dt}, *this}};
  }

  /// The host's own step needs no solver.
  template <class Use> void solve(Verlet, double, const Use &) {}

  // Out of line: a loop asks only when the parameters change, and needs its registers.
  [[gnu::noinline]] const Prediction &prediction_of(const ContactPartners &partners, double dt) {
    return predictions_.get(partners, dt, [&]() -> Prediction {
      const double mass = partners.reduced_mass;
      const double tangential_mass = tangential_reduced_mass(mass, dimension_);
      if constexpr (linear)
        return {law_of_(partners), mass, tangential_mass, *linear_predictor_, dt};
      else
        return {law_of_(partners), mass, tangential_mass, dt};
    });
  }

  [[gnu::noinline]] const HertzPrediction &known_of(const ContactPartners &partners, double dt) {
    return known_.get(partners, dt, [&]() -> HertzPrediction {
      const double mass = partners.reduced_mass;
      const HertzPrediction::Law law = law_of_(partners);
      return {law, trajectory_of(law, mass), mass, tangential_reduced_mass(mass, dimension_), dt};
    });
  }

  [[gnu::noinline]] const Exactly &exact_of(const ContactPartners &partners, double dt) {
    return exact_.get(partners, dt, [&] { return make_exact(partners, dt); });
  }

  [[gnu::noinline]] const SoftInCrowd<Exactly> &soft_of(const ContactPartners &partners, double dt) {
    return soft_.get(partners, dt, [&]() -> SoftInCrowd<Exactly> {
      return {make_exact(partners, dt), make_exact(partners, crowd_step_)};
    });
  }

  Exactly make_exact(const ContactPartners &partners, double dt) {
    const double mass = partners.reduced_mass;
    const double tangential_mass = tangential_reduced_mass(mass, dimension_);
    const Law law = law_of_(partners);
    if constexpr (linear || viscoelastic)
      return {law, mass, tangential_mass, dt};
    else
      return {law, tables_of(law, mass, tangential_mass), mass, tangential_mass, dt};
  }

  HertzTables tables_of(const HertzImpulse::Law &law, double mass, double tangential_mass) {
    const auto response_to = [&](const Oscillator &o) {
      return kept(responses_, CrowdResponseTable::damping_ratio(o));
    };
    return {trajectory_of(law, mass), response_to(HertzImpulse::normal_at(law, mass, 1.0)),
            response_to(HertzImpulse::slip_at(law, tangential_mass, 1.0))};
  }

  std::shared_ptr<const HertzTrajectory> trajectory_of(const HertzImpulse::Law &law, double mass) {
    return kept(trajectories_, HertzImpulse::alpha(law, mass), law.tension());
  }

  template <class Table> using TablesOfRatio = std::map<double, std::shared_ptr<const Table>>;

  /// One for all sizes of particle with the same material, whose ratios differ by rounding.
  template <class Table, class... Others>
  static std::shared_ptr<const Table> kept(TablesOfRatio<Table> &tables, double ratio, Others... others) {
    constexpr double unit = 1e-13;
    auto &table = tables[std::round(ratio / unit)];
    if (!table) table = std::make_shared<Table>(ratio, others...);
    return table;
  }

  LawOf law_of_;
  const Method *method_ = nullptr;
  const Predictor *linear_predictor_ = nullptr;
  int dimension_ = 3;
  bool begins_inside_ = false;
  ParameterCache<Prediction> predictions_;
  ParameterCache<HertzPrediction> known_;
  double crowd_step_ = 0.0; ///< that soft_ is for [s]
  ParameterCache<SoftInCrowd<Exactly>> soft_{10};
  ParameterCache<Exactly> exact_{10}; // with split masses there are parameters for every two numbers of contacts
  TablesOfRatio<HertzTrajectory> trajectories_;
  TablesOfRatio<CrowdResponseTable> responses_;
};

} // namespace cfpm
