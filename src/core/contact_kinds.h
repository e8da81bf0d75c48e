// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_cache.h"
#include "linear_contact.h"
#include "nonlinear_contact.h"
#include "predictor.h"
#include "sphere_step.h"

#include <type_traits>

namespace cfpm {

/// The kinds of contact of one law and predictor. Law: LinearLaw, or one whose at(overlap) is a LinearLaw.
template <class Law> class ContactKinds {
public:
  static constexpr bool linear = std::is_same_v<Law, LinearLaw>;
  using Kind = std::conditional_t<linear, LinearContact, NonlinearContact<Law>>;

  /// dimension: 2 for discs. Forgets what it has kept; the predictor must have a form for the law.
  void reset(const Predictor *predictor, int dimension) {
    predictor_ = predictor;
    dimension_ = dimension;
    kept_.clear();
  }

  /// Valid until the next call. law_of(partners): asked where a kind is not kept.
  /// Out of line: a loop asks only when the kind of contact changes, and needs its registers.
  template <class LawOf>
  [[gnu::noinline]] const Kind &get(const ContactPartners &partners, double dt, const LawOf &law_of) {
    return kept_.get(partners, dt, [&]() -> Kind {
      const double mass = partners.reduced_mass;
      const double tangential_mass = tangential_reduced_mass(mass, dimension_);
      if constexpr (linear)
        return {law_of(partners), mass, tangential_mass, *predictor_, dt};
      else
        return {law_of(partners), mass, tangential_mass, dt};
    });
  }

  /// Calls use() with what makes a ContactStep of a kind, an overlap and a closing speed: the choice of the
  /// predictor is made here, outside of any loop.
  template <class Use> void with_predictor(const Use &use) const {
    if constexpr (linear)
      use([](const Kind &kind, double overlap, double closing_speed) { return kind.at(overlap, closing_speed); });
    else
      Predictors::for_any_law(*predictor_, [&use](auto predictor) {
        use([](const Kind &kind, double overlap, double closing_speed) {
          return kind.template at<decltype(predictor)>(overlap, closing_speed);
        });
      });
  }

private:
  const Predictor *predictor_ = nullptr;
  int dimension_ = 3;
  ContactCache<Kind> kept_;
};

} // namespace cfpm
