// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/method/impulses/crowd_response.h"
#include "core/method/impulses/normal_impulse.h"

namespace cfpm {

/// The parameters of contacts that in a crowd answer as over a larger step than dt, of which they give their part: for
/// a bed that came to rest over the larger one, with overlaps that belong to it.
///
/// With the shares C and D of CrowdResponse over the larger step H these are C dt/H and D dt/H, so where C H/2 < D and
/// D < 2/L hold they do so here all the more: what rested goes on resting.
/// Parameters: LinearImpulse or HertzImpulse
template <class Parameters> class SoftInCrowd : public Parameters {
public:
  /// now: over dt; before: over the larger step
  SoftInCrowd(const Parameters &now, const Parameters &before)
      : Parameters(now), before_(before), part_(now.dt() / before.dt()) {}

  /// See LinearImpulse; contacts that begin inside the step are as ever.
  NormalImpulse normal_in_crowd(double overlap, double closing_speed, double span, double crowding) const {
    if (span != this->dt()) return Parameters::normal_in_crowd(overlap, closing_speed, span, crowding);
    NormalImpulse action = before_.normal_in_crowd(overlap, closing_speed, before_.dt(), crowding);
    action.impulse *= part_;
    action.contact_time *= part_;
    return action;
  }

  /// See LinearImpulse.
  CrowdResponse slip_in_crowd(const NormalImpulse &normal) const {
    if (normal.contact_time != this->dt()) return Parameters::slip_in_crowd(normal);
    NormalImpulse longer = normal;
    longer.contact_time = before_.dt();
    CrowdResponse response = before_.slip_in_crowd(longer);
    response.rate_from_displacement *= part_;
    response.rate_from_rate = 1.0 - part_ * (1.0 - response.rate_from_rate);
    return response;
  }

private:
  Parameters before_;
  double part_; ///< dt over the larger step
};

} // namespace cfpm
