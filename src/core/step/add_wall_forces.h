// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/parameter_cache.h"
#include "core/law/coulomb.h"
#include "core/step/act.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"

#include <vector>

namespace cfpm {

/// A particle and a wall.
struct WallContact {
  int i;
  ContactPartners partners;
  Contact contact;
};

/// Lets the contacts with walls act and applies what they do. See add_pair_forces().
template <Friction friction, class M> void add_wall_forces(const std::vector<WallContact> &contacts,
                                                           const Particles &particles, StepState &step,
                                                           const M &method) {
  for (const WallContact &c : contacts) {
    const ContactAction action = act<friction>(method, method.parameters(c.partners), c.contact, no_cohesion);
    add(action.mean.force, particles.f[c.i]);
    add(action.mean.couple(c.contact.geometry.lever_i), particles.torque[c.i]);
    share_at_wall<M>(step, c.i, action);
  }
}

} // namespace cfpm
