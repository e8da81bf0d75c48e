// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/law/coulomb.h"
#include "core/method/forces/follow_area.h"
#include "core/method/forces/force_prediction.h"
#include "core/method/forces/mean_friction.h"
#include "core/method/forces/predicted_law.h"
#include "core/numbers/vec3.h"

#include <algorithm>
#include <utility>

namespace cfpm {

/// Beyond the paper, in a loop over contacts, see MeanOfTwoForces: the mean of the two forces acts while the bodies
/// touch, from the touch on where a contact begins inside the step and, where it ends inside, until Eq. 39 says or the
/// bodies part.
///
/// Let k u be how fast the force rises after a touch at the speed u. A contact that is found when it overlaps, T after
/// the touch, lacks the impulse k u T^2/2, on the average k u dt^2/6; the force of one that is released at T, k u T,
/// acts over dt instead of T and gives k u T (dt - T)/2 too much, on the average k u dt^2/12. Either adds to the energy
/// of the bodies: the first is two thirds of what the method gains in a collision, the second one third. With a
/// dashpot, whose force jumps at both ends, these are errors of first order in dt.
///
/// The two forces of a contact of duration T act in the middle of it, not of the step: the bodies move by the impulse
/// times a part of dt/2 too far or too little. That is of third order in dt, twice in a collision (with a dashpot of
/// second order), which is what the trapezoid of Eq. 27 leaves over in a collision anyway. So positions advance by
/// Eq. 27 as ever, and collisions are of second order, as tests/core/test_mean_while_touching.cpp measures; but for
/// Hertz' law, whose damping rises with the fourth root of the overlap.
///
/// LawOf: law_of.while_touching(parameters, overlap, closing speed, span) is a PredictedTouch, or one
/// with adhesion.
template <class ParametersOf, class LawOf> class MeanWhileTouching : public ForcePrediction<ParametersOf, LawOf> {
  using Base = ForcePrediction<ParametersOf, LawOf>;
  using typename Base::Prediction;
  using Touch =
      decltype(std::declval<const LawOf &>().while_touching(std::declval<const Prediction &>(), 0.0, 0.0, 0.0));

public:
  static constexpr bool wants_onset = true;

  /// dt: of the step [s]
  MeanWhileTouching(const ParametersOf &parameters_of, const LawOf &law_of, double dt)
      : Base(parameters_of, law_of), dt_(dt) {}

  struct Normal {
    decltype(Touch::law) law;
    NormalAction action;
    double part;                                         ///< of the step in which the bodies touch
    double mean() const { return part * action.mean(); } ///< over the step [N]
    bool in_contact() const { return mean() != 0.0; }
  };

  /// span: from the touch to the end of the step [s]
  template <class Parameters>
  Normal normal(const Parameters &parameters, const ContactGeometry &g, double span, double) const {
    const Touch touch = law_of_.while_touching(parameters, g.overlap, g.closing_speed, span);
    const NormalAction action = predict_normal(touch.law, g);
    return {touch.law, action, std::min(action.separation_time, touch.contact_time) / dt_};
  }

  template <Friction friction, class Parameters>
  MeanForce mean_force(const Parameters &parameters, const Normal &normal, const ContactGeometry &g, double span,
                       const StoredSpring &spring, double cohesive) const {
    const BasicLimitForces<double> limit = limit_forces(normal.law, normal.action, cohesive);
    Vec3 tangential{};
    if (span == dt_) {
      if constexpr (has_spring(friction))
        if (spring.advance) follow_area(parameters.step().law, g.overlap, spring);
      tangential = mean_friction<friction>(normal.law, g, spring, limit.now, limit.predicted);
    } else if constexpr (friction != Friction::none) {
      // without a spring at the touch; what is carried on leads the end of the step by half a step, see MidStepSpring
      if constexpr (has_spring(friction)) set((span - 0.5 * dt_) * g.slip_velocity, spring.values);
      tangential = predict_tangential<friction>(normal.law, {}, g.slip_velocity, limit.now, limit.predicted).mean();
    }
    tangential = normal.part * tangential;
    return {normal.mean() * g.normal + tangential, cross(g.normal, tangential), {}};
  }

private:
  using Base::law_of_;
  double dt_; ///< [s]
};

} // namespace cfpm
