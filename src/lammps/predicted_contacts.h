// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_arguments.h"

#include "core/contact/contact.h"
#include "core/motion/restitution.h"
#include "core/step/add_wall_forces.h"
#include "core/step/contact_energy.h"
#include "core/step/energy_budget.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"

#include <functional>
#include <memory>
#include <vector>

namespace cfpm::lammps {

/// Called for a contact with i, j, the force on i and xi - xj.
using Tally = std::function<void(int, int, const Vec3 &, const Vec3 &)>;

/// The contacts of one pair style or wall with its law and method. With a method that predicts nothing, the host having
/// added the forces, it tells energies alone.
class PredictedContacts {
public:
  virtual ~PredictedContacts() = default;
  /// Before a run. dimension: of the particles' inertia, 2 for discs; begins_inside: whether contacts do.
  virtual void prepare(int dimension, bool begins_inside) = 0;
  /// Adds the predicted forces of all listed pairs over the step. advance: false where a state is
  /// evaluated again; tally: empty, or called for every contact.
  virtual void add_pair_forces(const Particles &particles, const PairList &pairs, const StepState &step, bool advance,
                               const Tally &tally) = 0;
  virtual void add_wall_forces(std::vector<WallContact> &contacts, const Particles &particles, StepState &step,
                               bool advance) = 0;
  /// Of one contact, in the state that forces were last added for; its spring stays as it is.
  virtual ContactAction action_of(const ContactPartners &partners, Contact contact, const StepState &step) = 0;
  /// Likewise the couple on i of rolling and twisting resistance [N m]. force: the contact's [N]
  virtual Vec3 couple_of(const Particles &particles, int i, int j, Contact contact, const Vec3 &force,
                         const StepState &step) = 0;

  // behind forces, of the state that they were added for
  virtual void add_pair_energies(const Particles &particles, const PairList &pairs, const StepState &step,
                                 EnergyBudget &budget) = 0;
  /// touched: see there.
  virtual ContactEnergy energy_of(const ContactPartners &partners, Contact contact, bool touched,
                                  const StepState &step) = 0;
};

/// In place of the type of a particle.
constexpr int wall_type = 0;

/// A sphere and a wall. of_wall: its radius of curvature [m], see ContactPartners.
ContactPartners at_wall(int type, double radius, double mass, double of_wall = flat_wall);

/// How the isolated collision of two bodies goes.
struct Collision {
  double contact_time; ///< tc, undamped [s]
  bool hertz;          ///< its spring; else linear
  Restitution restitution;
};

/// Of two bodies that meet at that speed [m/s], which has no influence for hooke.
Collision collision(const ContactArguments &arguments, const ContactPartners &partners, double impact_speed);

/// The method must be one that predicts, but for energies.
std::unique_ptr<PredictedContacts> make_predicted_contacts(const ContactArguments &arguments);

} // namespace cfpm::lammps
