// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/method/impulses/crowd_response.h"
#include "core/method/impulses/normal_impulse.h"

namespace cfpm {

/// See SoftInCrowd. Step: the numbers of the larger step; R: double, or a Pack of several contacts' numbers.
template <class Step, class R> struct SoftCrowdStep {
  R dt;              ///< [s]
  R reduced_mass;    ///< m* [kg]
  R tangential_mass; ///< mt [kg]
  R friction;
  R part;      ///< dt over the larger step
  Step larger; ///< its numbers

  [[gnu::always_inline]] BasicNormalImpulse<R> normal_in_crowd(const R &overlap, const R &closing_speed,
                                                               const R &crowding) const {
    BasicNormalImpulse<R> action = larger.normal_in_crowd(overlap, closing_speed, crowding);
    action.impulse = part * action.impulse;
    action.contact_time = select(R(0.0) < action.contact_time, dt, 0.0);
    return action;
  }
  [[gnu::always_inline]] BasicCrowdResponse<R> slip_in_crowd(const BasicNormalImpulse<R> &normal) const {
    return part_of(larger.slip_in_crowd(normal), part);
  }
  [[gnu::always_inline]] R retardation(const BasicNormalImpulse<R> &normal) const { return larger.retardation(normal); }
  [[gnu::always_inline]] static BasicCrowdResponse<R> part_of(BasicCrowdResponse<R> response, const R &part) {
    response.rate_from_displacement = part * response.rate_from_displacement;
    response.rate_from_rate = 1.0 - part * (1.0 - response.rate_from_rate);
    return response;
  }
};

/// The parameters of contacts that in a crowd answer as over a larger step than dt, of which they give their part: for
/// a bed that came to rest over the larger one, with overlaps that belong to it.
///
/// With the shares C and D of CrowdResponse over the larger step H these are C dt/H and D dt/H, so where C H/2 < D and
/// D < 2/L hold they do so here all the more: what rested goes on resting.
/// Parameters: LinearImpulse, HertzImpulse or ViscoelasticImpulse
template <class Parameters> class SoftInCrowd : public Parameters {
public:
  template <class R> using CrowdStep = SoftCrowdStep<typename Parameters::template CrowdStep<R>, R>;

  /// now: over dt; before: over the larger step
  SoftInCrowd(const Parameters &now, const Parameters &before)
      : Parameters(now), before_(before), part_(now.dt() / before.dt()) {
    if (before_.crowd_step())
      step_ = {now.dt(), now.reduced_mass(), now.tangential_mass(), now.friction(), part_, *before_.crowd_step()};
  }

  /// See LinearImpulse.
  const CrowdStep<double> *crowd_step() const { return before_.crowd_step() ? &step_ : nullptr; }

  /// See LinearImpulse.
  double softening(double overlap, double closing_speed) const { return before_.softening(overlap, closing_speed); }
  /// See LinearImpulse; contacts that begin inside the step are as ever.
  NormalImpulse normal_in_crowd(double overlap, double closing_speed, double span, double crowding) const {
    if (span != this->dt()) return Parameters::normal_in_crowd(overlap, closing_speed, span, crowding);
    NormalImpulse action = before_.normal_in_crowd(overlap, closing_speed, before_.dt(), crowding);
    action.impulse *= part_;
    if (action.contact_time > 0.0) action.contact_time = span;
    return action;
  }

  /// See LinearImpulse.
  CrowdResponse slip_in_crowd(const NormalImpulse &normal) const {
    if (normal.contact_time != this->dt()) return Parameters::slip_in_crowd(normal);
    NormalImpulse longer = normal;
    longer.contact_time = before_.dt();
    return CrowdStep<double>::part_of(before_.slip_in_crowd(longer), part_);
  }

private:
  Parameters before_;
  double part_; ///< dt over the larger step
  CrowdStep<double> step_{};
};

} // namespace cfpm
