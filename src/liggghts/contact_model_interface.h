// SPDX-License-Identifier: GPL-2.0-or-later
// What the styles that own a contact model and the model, which the host's parser makes for them, know of each other.
#pragma once

#include "core/law/law_kind.h"
#include "core/method/method.h"
#include "core/motion/restitution.h"
#include "core/step/energy_budget.h"
#include "core/step/equivalent_overlaps.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"
#include "core/step/wall_contact.h"

#include <string>
#include <vector>

namespace cfpm::liggghts {

/// Implemented by the contact model, which alone has the host's parameters at hand.
class ContactModelInterface {
public:
  /// Adds the forces of all listed pairs, predicted or, to the last bit, those of the host's loop. advance: false where
  /// a state is evaluated again.
  virtual void add_pair_forces(const Particles &particles, const PairList &pairs, bool advance) = 0;
  /// Contacts with walls that are predicted from now on are put there in place of acting; null: they act at once, which
  /// a host needs that reads the force of each.
  virtual void collect_wall_contacts(std::vector<WallContact> *collected) = 0;
  /// Adds the forces of those that were.
  virtual void add_wall_forces(const std::vector<WallContact> &contacts) = 0;
  /// Of all listed pairs that overlap, see equivalent_overlaps(); nothing where forces are not predicted.
  virtual std::vector<PairOverlap> equivalent_overlaps(const Particles &particles, const PairList &pairs) = 0;
  /// Tells of all listed pairs, behind their forces; contacts with walls tell when they act.
  virtual void add_pair_energies(const Particles &particles, const PairList &pairs, EnergyBudget &budget) = 0;
  /// Undamped contact time tc of a collision at that speed [s]; without influence for a linear law.
  virtual double contact_time(const ContactPartners &partners, double impact_speed) = 0;
  virtual Restitution restitution(const ContactPartners &partners) = 0;
  virtual LawKind law() const = 0;
  /// Where the tangential spring lies in a contact's history, -1 without one.
  virtual int spring_offset() const = 0;
  /// Likewise StoredSpring::now, -1 if the method has none.
  virtual int spring_now_offset() const = 0;
  /// Called by the owner when all contacts have been evaluated with the host's present time step.
  virtual void all_evaluated() = 0;
  /// Whether cohesion or rolling friction of the host act beside the predicted forces.
  virtual bool has_host_models() const = 0;
  /// Why forces of one instant are left to the host's loop, as text behind "as"; empty where they are not.
  virtual std::string reason_for_host_loop() const = 0;

protected:
  ~ContactModelInterface() = default;
};

/// Implemented by pair_style gran/cfpm and fix wall/gran/cfpm.
class ContactModelOwner {
public:
  virtual const Method &method() const = 0;
  /// Whether contacts begin inside a step.
  virtual bool onset() const = 0;
  /// Called by the contact model at every init, when the host's properties are connected.
  virtual void connect(ContactModelInterface &model) = 0;
  /// Of the pair style.
  virtual StepState &step() = 0;
  /// "pair_style gran/cfpm" or "fix wall/gran/cfpm", for messages.
  virtual const char *command() const = 0;

protected:
  ~ContactModelOwner() = default;
};

} // namespace cfpm::liggghts
