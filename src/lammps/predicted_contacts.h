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

/// A particle that touches a wall, or will inside the step, and what is added to.
struct WallContact {
  int type;
  double radius; ///< [m]
  double mass;   ///< [kg]
  ContactGeometry geometry;
  double span;        ///< from the touch to the end of the step [s]
  double others;      ///< see Crowd [1/kg]
  double *spring;     ///< its tangential spring
  double *spring_now; ///< see StoredSpring
  double *f;
  double *torque;
  double *shift;    ///< see MeanForce; null, as spring_now, without impulses [kg m]
  double *contacts; ///< counted in this step; null: nobody asks for them
};

/// Means over a step on the first body.
struct ContactForce {
  double normal;   ///< along the normal, positive where the contact pushes [N]
  Vec3 tangential; ///< [N]
};

/// The contacts of one pair style or wall with its law and predictor.
class PredictedContacts {
public:
  virtual ~PredictedContacts() = default;
  /// Before a run. dimension: of the particles' inertia, 2 for discs.
  virtual void prepare(int dimension) = 0;
  /// Adds the predicted forces of all listed pairs over a step dt. advance: false where a state is
  /// evaluated again; tally: empty, or called for every contact.
  virtual void add_pair_forces(const ListedPairs &pairs, double dt, bool advance, const Tally &tally) = 0;
  virtual void add_wall_forces(const std::vector<WallContact> &contacts, double dt, bool advance) = 0;
  /// Of one contact, in the state that forces were last added for. spring, spring_now: its own, which stay as they are.
  virtual ContactForce force_of(const ContactPartners &partners, const ContactGeometry &geometry, const double *spring,
                                const double *spring_now, double others, double dt) = 0;
};

/// A sphere and a wall.
ContactPartners at_wall(int type, double radius, double mass);

/// Undamped contact time tc of a collision at that speed [s]; without influence for hooke.
double contact_time(const ContactArguments &arguments, const ContactPartners &partners, double impact_speed);

/// The predictor must not be null.
std::unique_ptr<PredictedContacts> make_predicted_contacts(const ContactArguments &arguments);

} // namespace cfpm::lammps
