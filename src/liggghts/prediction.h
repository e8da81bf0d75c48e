// SPDX-License-Identifier: GPL-2.0-or-later
// What pair_style gran/cfpm and fix wall/gran/cfpm share: which predictor their contacts use, and the
// contact law behind a pair of particles.
#pragma once

#include "../core/linear_law.h"
#include "../core/predictor.h"

namespace cfpm::liggghts {

/// Two touching bodies as a contact law sees them; of a wall only the type counts.
struct ContactPartners {
  int type_i;
  int type_j;
  double radius_i;     ///< [m]
  double radius_j;     ///< [m], unused at a wall
  double reduced_mass; ///< m* [kg]
};

/// Implemented by the contact model, which alone has the host's parameters at hand.
class LawSource {
public:
  virtual LinearLaw law(const ContactPartners &partners) = 0;

protected:
  ~LawSource() = default;
};

/// Implemented by the styles that own a contact model.
class PredictionOwner {
public:
  /// The predictor in force, or nullptr for "predict none".
  virtual const Predictor *predictor() const = 0;
  /// Called by the contact model at every init, when the host's properties are connected.
  virtual void connect(LawSource &source) = 0;
  /// "pair_style gran/cfpm" or "fix wall/gran/cfpm", for messages.
  virtual const char *command() const = 0;

protected:
  ~PredictionOwner() = default;
};

} // namespace cfpm::liggghts
