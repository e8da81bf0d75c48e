// SPDX-License-Identifier: GPL-2.0-or-later
// What pair_style gran/cfpm and fix wall/gran/cfpm share: which predictor their contacts use, and the
// contact model behind a pair of particles.
#pragma once

#include "../core/pair_loop.h"
#include "../core/predictor.h"

namespace cfpm::liggghts {

/// Of the particles of this rank and, but for shift and contacts, of their neighbours on others: what pairs and walls
/// share over a step if one of them gives impulses.
struct SharedStep {
  VectorRows shift; ///< see MeanForce [kg m]
  Crowd crowd;
  double *contacts = nullptr; ///< counted in this step; null if nobody gives impulses
  bool onset = true;          ///< whether contacts begin inside a step
  double ahead = 0.0;         ///< see ListedPairs [m]
};

/// Implemented by the contact model, which alone has the host's parameters at hand.
class PredictedContacts {
public:
  /// Adds the predicted forces of all listed pairs. advance: false where a state is evaluated again.
  virtual void add_pair_forces(const ListedPairs &pairs, bool advance) = 0;
  /// Undamped contact time tc of a collision at that speed [s]; without influence for a linear law.
  virtual double contact_time(const ContactPartners &partners, double impact_speed) = 0;
  virtual LawKind law() const = 0;
  /// Where the tangential spring lies in a contact's history, -1 without one.
  virtual int spring_offset() const = 0;
  /// Likewise StoredSpring::now, -1 if the method has none.
  virtual int spring_now_offset() const = 0;
  /// The step by half of which the stored springs lead, or with impulses lag [s].
  virtual double spring_step() const = 0;
  /// Called by the owner when all contacts have been evaluated with the host's present time step.
  virtual void all_evaluated() = 0;
  /// Whether cohesion or rolling friction of the host act beside the predicted forces.
  virtual bool has_host_models() const = 0;

protected:
  ~PredictedContacts() = default;
};

/// Implemented by the styles that own a contact model.
class PredictionOwner {
public:
  /// The predictor in force, or nullptr for "predict none".
  virtual const Predictor *predictor() const = 0;
  /// Called by the contact model at every init, when the host's properties are connected.
  virtual void connect(PredictedContacts &contacts) = 0;
  virtual const SharedStep &shared_step() const = 0;
  /// "pair_style gran/cfpm" or "fix wall/gran/cfpm", for messages.
  virtual const char *command() const = 0;

protected:
  ~PredictionOwner() = default;
};

} // namespace cfpm::liggghts
