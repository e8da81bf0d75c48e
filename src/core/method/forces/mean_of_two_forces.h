// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/parameter_cache.h"
#include "core/contact/tangential_spring.h"
#include "core/method/forces/follow_area.h"
#include "core/method/forces/force_prediction.h"
#include "core/method/forces/mean_friction.h"
#include "core/method/forces/predicted_law.h"
#include "core/method/method.h"
#include "core/numbers/vec3.h"

#include <utility>

namespace cfpm {

/// What a MeanOfTwoForces makes of parameters, or of those of a pack of contacts, and a MeanWhileTouching of those of
/// one: where they know how to predict,
struct PredictedByParameters {
  template <class Parameters, class R>
  [[gnu::always_inline]] auto operator()(const Parameters &parameters, const R &overlap, const R &closing_speed) const {
    return parameters.at(overlap, closing_speed);
  }
  template <class Parameters>
  auto while_touching(const Parameters &parameters, double overlap, double closing_speed, double span) const {
    return parameters.while_touching(overlap, closing_speed, span);
  }
};
/// and where a predictor does.
template <class Predictor> struct PredictedBy {
  template <class Parameters, class R>
  [[gnu::always_inline]] auto operator()(const Parameters &parameters, const R &overlap, const R &closing_speed) const {
    return parameters.template at<Predictor>(overlap, closing_speed);
  }
  template <class Parameters>
  auto while_touching(const Parameters &parameters, double overlap, double closing_speed, double span) const {
    return parameters.template while_touching<Predictor>(overlap, closing_speed, span);
  }
};

/// What a MeanOfTwoForces does with a pack of contacts, see compute_pack().
template <class LawOf> struct PackedMeanOfTwoForces {
  template <Friction friction, class R, class Step, class Springs> [[gnu::always_inline]] static BasicPairForce<R>
  act(const Step &step, const BasicSpherePair<R> &pair, const Springs &springs) {
    // not const: the compiler would keep aggregates that are in memory
    BasicContactGeometry<R> g = touching_spheres(pair);
    auto law = LawOf()(step, g.overlap, g.closing_speed);
    BasicNormalAction<R> normal = predict_normal(law, g);
    if constexpr (has_spring(friction)) follow_area(step.law, g.overlap, springs);
    return {cfpm::mean_force<friction>(law, g, normal, springs), g.lever_i, g.lever_j,
            select(normal.mean() != R(0.0), R(1.0), R(0.0))};
  }

  static constexpr bool takes_geometry = true;
  /// Of contacts whose geometry is known, as at walls.
  template <Friction friction, class R, class Step, class Springs> [[gnu::always_inline]] static BasicMeanForce<R>
  mean_force(const Step &step, const BasicContactGeometry<R> &g, const Springs &springs) {
    auto law = LawOf()(step, g.overlap, g.closing_speed); // not const, see above
    if constexpr (has_spring(friction)) follow_area(step.law, g.overlap, springs);
    return cfpm::mean_force<friction>(law, g, predict_normal(law, g), springs);
  }
};

/// The paper's method in a loop over contacts: the mean of the force now and the force predicted for the end of the
/// step. As every method it gives the parameters of two bodies, the normal part of a contact, then the whole mean
/// force. LawOf: law_of(parameters, overlap, closing speed) is a PredictedLaw, or one with adhesion.
template <class ParametersOf, class LawOf> class MeanOfTwoForces : public ForcePrediction<ParametersOf, LawOf> {
  using Base = ForcePrediction<ParametersOf, LawOf>;
  using typename Base::Prediction;

public:
  using Packed = PackedMeanOfTwoForces<LawOf>;
  static constexpr bool wants_onset = false;

  MeanOfTwoForces(const ParametersOf &parameters_of, const LawOf &law_of) : Base(parameters_of, law_of) {}

  struct Normal {
    decltype(std::declval<const LawOf &>()(std::declval<const Prediction &>(), 0.0, 0.0)) law; ///< a PredictedLaw
    NormalAction action;
    double mean() const { return action.mean(); } ///< over the step [N]
    bool in_contact() const { return mean() != 0.0; }
  };

  /// What makes those of contacts of any sizes, where it is known, see made_steps.h.
  template <class Of = ParametersOf> auto maker() const -> decltype(std::declval<const Of &>().maker()) {
    return parameters_of_.maker();
  }
  decltype(auto) made_parameters(const ContactPartners &partners) const { return parameters_of_.made(partners); }

  template <class Parameters>
  [[gnu::always_inline]] Normal normal(const Parameters &parameters, const ContactGeometry &g, double, double) const {
    const auto law = law_of_(parameters, g.overlap, g.closing_speed);
    return {law, predict_normal(law, g)};
  }

  template <Friction friction, class Parameters>
  [[gnu::always_inline]] MeanForce mean_force(const Parameters &parameters, const Normal &normal,
                                              const ContactGeometry &g, double, const StoredSpring &spring,
                                              double cohesive) const {
    if constexpr (has_spring(friction))
      if (spring.advance) follow_area(parameters.step().law, g.overlap, spring);
    return cfpm::mean_force<friction>(normal.law, g, normal.action, spring, cohesive);
  }

private:
  using Base::law_of_;
  using Base::parameters_of_;
};

} // namespace cfpm
