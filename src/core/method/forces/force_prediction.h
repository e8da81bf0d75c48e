// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/parameter_cache.h"
#include "core/contact/tangential_spring.h"
#include "core/method/elastic_contact.h"
#include "core/numbers/vec3.h"

#include <type_traits>
#include <utility>

namespace cfpm {

/// What methods have in common that predict the force for the end of a step and act with the mean of it and of that
/// now. Their Normal has the PredictedLaw as law. ParametersOf: parameters_of(partners) is a reference that is valid
/// until the next call; LawOf: makes a PredictedLaw of parameters.
template <class ParametersOf, class LawOf> class ForcePrediction {
public:
  using Prediction = std::decay_t<decltype(std::declval<const ParametersOf &>()(ContactPartners{}))>;
  using Law = typename Prediction::Law;
  static constexpr bool wants_crowd = false;

  decltype(auto) parameters(const ContactPartners &partners) const { return parameters_of_(partners); }

  /// Of the law at the beginning, also where it pulls [N].
  template <class Parameters, class Normal>
  double force_now(const Parameters &, const Normal &normal, const ContactGeometry &g) const {
    return normal.law.law.normal_force(g.overlap, g.closing_speed);
  }

  /// Along what the normal force acts.
  template <class Normal> Vec3 acts_along(const Normal &, const ContactGeometry &g) const { return g.normal; }
  template <class Parameters, class Normal>
  ElasticContact elastic(const Parameters &parameters, const Normal &normal, const ContactGeometry &g) const {
    return {parameters.step().law.spring_energy(g.overlap), normal.law.law.tangential_stiffness};
  }
  /// Of a contact that has acted.
  Vec3 spring_now(const StoredSpring &stored, const ContactGeometry &g) const {
    return MidStepSpring(vec3(stored.values), stored.dt).now(g.slip_velocity);
  }

protected:
  ForcePrediction(const ParametersOf &parameters_of, const LawOf &law_of)
      : parameters_of_(parameters_of), law_of_(law_of) {}

  const ParametersOf &parameters_of_;
  const LawOf &law_of_;
};

} // namespace cfpm
