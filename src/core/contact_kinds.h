// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_cache.h"
#include "contact_method.h"
#include "hertz_impulse.h"
#include "linear_contact.h"
#include "linear_impulse.h"
#include "nonlinear_contact.h"
#include "predictor.h"
#include "sphere_step.h"

#include <cmath>
#include <map>
#include <memory>

namespace cfpm {

/// The kinds of contact of one law and predictor. Law: LinearLaw, or one whose at(overlap) is a LinearLaw.
template <class Law> class ContactKinds {
public:
  /// dimension: 2 for discs. Forgets what it has kept; the predictor must predict the law.
  void reset(const Predictor *predictor, int dimension) {
    predictor_ = predictor;
    dimension_ = dimension;
    means_.clear();
    exact_.clear();
    trajectories_.clear();
    responses_.clear();
  }

  /// Calls use() with the method, MeanOfTwoForces or ExactImpulse: the choice is made here, outside of any loop.
  /// law_of(partners): asked where a kind of contact is not kept.
  template <class LawOf, class Use> void with_method(double dt, const LawOf &law_of, const Use &use) {
    const auto mean_kind = [&](const ContactPartners &p) -> const MeanKind & { return mean_of(p, dt, law_of); };
    const auto own = [](const auto &kind, double overlap, double closing_speed) {
      return kind.at(overlap, closing_speed);
    };
    if constexpr (Law::law_kind != LawKind::any) {
      const auto exact_kind = [&](const ContactPartners &p) -> const ExactKind & { return exact_of(p, dt, law_of); };
      if (predictor_->impulse) return use(ExactImpulse(exact_kind, dt));
      if constexpr (!linear)
        if (predictor_->propagator == &make_propagator<Exact>) return use(MeanOfTwoForces(exact_kind, own));
    }
    if constexpr (linear)
      use(MeanOfTwoForces(mean_kind, own));
    else
      Predictors::for_any_law(*predictor_, [&](auto predictor) {
        const auto advanced = [](const MeanKind &kind, double overlap, double closing_speed) {
          return kind.template at<decltype(predictor)>(overlap, closing_speed);
        };
        use(MeanOfTwoForces(mean_kind, advanced));
      });
  }

private:
  static constexpr bool linear = Law::law_kind == LawKind::linear;
  using MeanKind = std::conditional_t<linear, LinearContact, NonlinearContact<Law>>;
  using ExactKind = std::conditional_t<linear, LinearImpulse, HertzImpulse>;

  // Out of line: a loop asks only when the kind of contact changes, and needs its registers.
  template <class LawOf>
  [[gnu::noinline]] const MeanKind &mean_of(const ContactPartners &partners, double dt, const LawOf &law_of) {
    return means_.get(partners, dt, [&]() -> MeanKind {
      const double mass = partners.reduced_mass;
      const double tangential_mass = tangential_reduced_mass(mass, dimension_);
      if constexpr (linear)
        return {law_of(partners), mass, tangential_mass, *predictor_, dt};
      else
        return {law_of(partners), mass, tangential_mass, dt};
    });
  }

  template <class LawOf>
  [[gnu::noinline]] const ExactKind &exact_of(const ContactPartners &partners, double dt, const LawOf &law_of) {
    return exact_.get(partners, dt, [&]() -> ExactKind {
      const double mass = partners.reduced_mass;
      const double tangential_mass = tangential_reduced_mass(mass, dimension_);
      const Law law = law_of(partners);
      if constexpr (linear)
        return {law, mass, tangential_mass, dt};
      else
        return {law, tables_of(law, mass, tangential_mass), mass, tangential_mass, dt};
    });
  }

  HertzTables tables_of(const HertzImpulse::Law &law, double mass, double tangential_mass) {
    const auto response_to = [&](const Oscillator &o) {
      return kept(responses_, CrowdResponseTable::damping_ratio(o));
    };
    return {kept(trajectories_, HertzImpulse::alpha(law, mass)), response_to(HertzImpulse::normal_at(law, mass, 1.0)),
            response_to(HertzImpulse::slip_at(law, tangential_mass, 1.0))};
  }

  template <class Table> using TablesOfRatio = std::map<double, std::shared_ptr<const Table>>;

  /// One for all sizes of particle with the same material, whose ratios differ by rounding.
  template <class Table> static std::shared_ptr<const Table> kept(TablesOfRatio<Table> &tables, double ratio) {
    constexpr double unit = 1e-13;
    auto &table = tables[std::round(ratio / unit)];
    if (!table) table = std::make_shared<Table>(ratio);
    return table;
  }

  const Predictor *predictor_ = nullptr;
  int dimension_ = 3;
  ContactCache<MeanKind> means_;
  ContactCache<ExactKind> exact_{10}; // with split masses there are kinds for every two numbers of contacts
  TablesOfRatio<HertzTrajectory> trajectories_;
  TablesOfRatio<CrowdResponseTable> responses_;
};

} // namespace cfpm
