// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/coulomb.h"
#include "core/numbers/instruction_set.h"
#include "core/step/act.h"
#include "core/step/packed_pairs.h"
#include "core/step/packed_walls.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"
#include "core/step/turn_resistances.h"
#include "core/step/wall_contact.h"

#include <vector>

namespace cfpm {

/// Lets the contacts with walls act and applies what they do. See add_pair_forces().
template <Friction friction, class M>
void add_wall_forces_one_by_one(const std::vector<WallContact> &contacts, const Particles &particles, StepState &step,
                                const M &method, const TurnResistances *resistances = nullptr) {
  for (const WallContact &c : contacts) {
    const ContactAction action = act<friction>(method, method.parameters(c.partners), c.contact, no_cohesion);
    add(action.mean.force, particles.f[c.i]);
    add(action.mean.couple(c.contact.geometry.lever_i), particles.torque[c.i]);
    if (resistances)
      add(resistances->couple_at_wall(particles, c.i, c.partners, c.contact, action.mean.force, step.dt),
          particles.torque[c.i]);
    share_at_wall<M>(step, c.i, action);
  }
}

/// The same to the last bit, several contacts at a time where they can be computed in packs and the instructions are
/// there and nobody counts contacts. Springs of all contacts are read alike.
template <Friction friction, class M> void add_wall_forces(const std::vector<WallContact> &contacts,
                                                           const Particles &particles, StepState &step, const M &method,
                                                           const InstructionSet &instructions = instruction_set(),
                                                           const TurnResistances *resistances = nullptr) {
  if constexpr (packs_walls<M>)
    if (!contacts.empty() && !step.contact_counts &&
        may_pack<friction, M>(instructions, step, contacts.front().contact.spring))
      return PackedWalls<friction, M>(instructions.lanes, particles, method, resistances, step.dt).add_forces(contacts);
  add_wall_forces_one_by_one<friction>(contacts, particles, step, method, resistances);
}

} // namespace cfpm
