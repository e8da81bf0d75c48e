// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../core/pair_loop.h"
#include "contact_arguments.h"

#include <functional>
#include <memory>
#include <vector>

namespace cfpm::lammps {

/// Called for a contact with i, j, the force on i and xi - xj.
using Tally = std::function<void(int, int, const Vec3 &, const Vec3 &)>;

/// A particle that touches a wall, and what is added to.
struct WallContact {
  int type;
  double radius; ///< [m]
  double mass;   ///< [kg]
  ContactGeometry geometry;
  double *spring; ///< its tangential spring
  double *f;
  double *torque;
};

/// The contacts of one pair style or wall with its law and predictor.
class PredictedContacts {
public:
  virtual ~PredictedContacts() = default;
  /// Adds the predicted forces of all listed pairs over a step dt. advance: false where a state is
  /// evaluated again; tally: empty, or called for every contact.
  virtual void add_pair_forces(const ListedPairs &pairs, double dt, bool advance, const Tally &tally) = 0;
  virtual void add_wall_forces(const std::vector<WallContact> &contacts, double dt, bool advance) = 0;
};

/// dimension: 2 for discs. The predictor must not be null.
std::unique_ptr<PredictedContacts> make_predicted_contacts(const ContactArguments &arguments, int dimension);

} // namespace cfpm::lammps
