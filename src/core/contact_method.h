// SPDX-License-Identifier: GPL-2.0-or-later
// The two ways to what a contact does to its bodies over a step. A loop over contacts is written for either: it asks
// for the kind of contact, for its normal part, then for the mean force.
#pragma once

#include "contact_cache.h"
#include "contact_geometry.h"
#include "contact_step.h"
#include "crowd.h"
#include "impulse_friction.h"
#include "mean_friction.h"
#include "normal_impulse.h"

namespace cfpm {

/// The paper's: the mean of the force now and the force predicted for the end of the step.
/// KindOf: kind_of(partners) is a reference to the kind of contact, valid until the next call;
/// StepOf: step_of(kind, overlap, closing speed) its ContactStep.
template <class KindOf, class StepOf> class MeanOfTwoForces {
public:
  static constexpr bool gives_impulses = false;

  MeanOfTwoForces(const KindOf &kind_of, const StepOf &step_of) : kind_of_(kind_of), step_of_(step_of) {}

  struct Normal {
    ContactStep contact;
    NormalAction action;
    double force() const { return action.force; } ///< at the beginning [N]
    double mean() const { return action.mean(); } ///< over the step [N]
    bool in_contact() const { return mean() > 0.0; }
  };

  decltype(auto) kind(const ContactPartners &partners) const { return kind_of_(partners); }

  template <class Kind>
  [[gnu::always_inline]] Normal normal(const Kind &kind, const ContactGeometry &g, double, double) const {
    const ContactStep contact = step_of_(kind, g.overlap, g.closing_speed);
    return {contact, predict_normal(contact, g)};
  }

  template <Friction friction, class Kind>
  [[gnu::always_inline]] MeanForce mean_force(const Kind &, const Normal &normal, const ContactGeometry &g, double,
                                              const StoredSpring &stored, double cohesive = 0.0) const {
    return cfpm::mean_force<friction>(normal.contact, g, normal.action, stored, cohesive);
  }

private:
  const KindOf &kind_of_;
  const StepOf &step_of_;
};

/// The exact impulse of the isolated contact, also of one that begins or ends inside the step.
template <class KindOf> class ExactImpulse {
public:
  static constexpr bool gives_impulses = true;

  ExactImpulse(const KindOf &kind_of, double dt) : kind_of_(kind_of), dt_(dt) {}

  struct Normal {
    NormalImpulse action;
    double crowding; ///< see crowding(); 1: the contact is isolated
    double dt;
    double force() const { return action.force; }
    double mean() const { return action.impulse / dt; }
    bool in_contact() const { return action.contact_time > 0.0; }
  };

  decltype(auto) kind(const ContactPartners &partners) const { return kind_of_(partners); }

  /// span: from the touch to the end of the step [s]; others: that hold its bodies, see Crowd [1/kg]. While the normal
  /// turns, half of its acceleration away from the line of centres, the square of the passing speed over the distance,
  /// is lost to the closing speed by the middle of the contact: that is the one along the normal of the middle. At the
  /// touch the same to first order, never less than nothing: grazing bodies touch as well.
  template <class Kind> Normal normal(const Kind &kind, const ContactGeometry &g, double span, double others) const {
    if (others > 0.0) {
      const double felt = crowding(others, kind.reduced_mass());
      return {kind.normal_in_crowd(g.overlap, g.closing_speed, span, felt), felt, dt_};
    }
    const NormalImpulse straight = kind.normal(g.overlap, g.closing_speed, span);
    const double outward = 0.5 * dot(g.turning, g.turning) * (g.lever_i + g.lever_j);
    if (outward == 0.0 || straight.contact_time == 0.0) return {straight, 1.0, dt_};
    const double lost = outward * straight.contact_time;
    const double speed =
        g.overlap > 0.0 ? g.closing_speed - lost : g.closing_speed * g.closing_speed / (g.closing_speed + lost);
    return {kind.normal(g.overlap, speed, span), 1.0, dt_};
  }

  template <Friction friction, class Kind>
  MeanForce mean_force(const Kind &kind, const Normal &normal, const ContactGeometry &g, double span,
                       const StoredSpring &stored, double cohesive = 0.0) const {
    return mean_force_of_impulse<friction>(kind, normal.action, g, span, normal.crowding, stored, cohesive);
  }

private:
  const KindOf &kind_of_;
  double dt_; ///< [s]
};

} // namespace cfpm
