// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/method/impulses/crowd.h"
#include "core/step/crowd_step.h"
#include "core/step/energy_budget.h"
#include "core/step/particles.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace cfpm {

/// What pairs, walls and the integrator share over a step. The pair style owns it and begins each step; pairs, then
/// walls, add to it; the integrator takes it.
class StepState {
public:
  double dt = 0.0;       ///< over which the forces of the last evaluation are means, 0 before the first one [s]
  double crowd_dt = 0.0; ///< over which crowds answer, see CrowdStep [s]
  int particles = 0;     ///< of this rank when it was made
  long evaluations = 0;  ///< how many there have been

  bool gives_impulses = false;      ///< whether pairs or walls do, which shift positions beyond the mean forces
  bool foresees = false;            ///< whether contacts of pairs or walls begin inside a step
  double ahead = 0.0;               ///< how far two particles come together in it at most, 0 if none do [m]
  VectorRows shift;                 ///< of the positions, see MeanForce [kg m]
  VectorRows contact_force;         ///< on each particle; only where impulses are given [N]
  Crowd crowd;                      ///< of the step before: walls act after the pairs, whose counts are not complete
  double *contact_counts = nullptr; ///< of each particle in this step; null if nobody gives impulses
  std::shared_ptr<EnergyBudget> budget; ///< of who moves the particles; null if the deck does not ask for it

  /// Before a run: what its pairs and walls are about to do. split: see Crowd.
  void prepare(bool impulses, bool begin_inside, double split) {
    gives_impulses = impulses;
    foresees = begin_inside;
    ahead = 0.0;
    shift = {};
    contact_force = {};
    crowd = {nullptr, split};
    contact_counts = nullptr;
  }

  /// Before a run, see CrowdStep.
  CrowdStep &crowd_step() { return crowd_step_; }

  /// Begins an evaluation over a step [s], of that many particles of this rank. v: also of their neighbours on other
  /// ranks, with these all of them.
  void begin(double step, int local, const double *const *v, int all) {
    dt = step;
    crowd_dt = crowd_step_.next(step);
    particles = local;
    if (foresees) ahead = largest_approach(v, all, dt);
    ++evaluations;
  }

  /// Likewise of impulses. counts, before: contacts of each of all particles, neighbours on other ranks among them, in
  /// this step and in the one before; again: the same state is evaluated once more; forward(): gives what stands in
  /// before to the neighbours on other ranks.
  template <class Forward>
  void begin_impulses(int all, double *counts, double *before, bool again, const Forward &forward) {
    shift_.assign(3 * static_cast<std::size_t>(all), 0.0);
    shift = VectorRows(shift_.data());
    contact_force_.assign(3 * static_cast<std::size_t>(all), 0.0);
    contact_force = VectorRows(contact_force_.data());
    if (!again) std::copy_n(counts, particles, before);
    forward();
    std::fill_n(counts, all, 0.0);
    crowd.contacts = before;
    contact_counts = counts;
  }

  /// After the pairs, before walls and all others: f is what they gave, to neighbours on other ranks too [N].
  void take_pair_forces(const double *const *f, int all) const {
    for (int i = 0; i < all; ++i) set(vec3(f[i]), contact_force[i]);
  }

  /// Where a single contact carries a load, gravity say, the load holds the particle as a second contact would, and is
  /// counted as one in the step to come. Taken as alone, the contact would let it fly freely: at rest under a load its
  /// time moments would move it against a velocity that never ends. In a collision the contact's force is far larger
  /// than loads are, but for the step in which it begins. f: of contacts and loads together, complete [N].
  void count_load(int i, const double *f) const {
    if (contact_counts[i] != 1.0 || crowd.contacts[i] == 0.0) return;
    const Vec3 contact = vec3(contact_force[i]);
    if (dot(vec3(f), contact) < 0.5 * dot(contact, contact)) contact_counts[i] = 2.0;
  }

private:
  CrowdStep crowd_step_;
  std::vector<double> shift_, contact_force_; ///< three values a particle
};

} // namespace cfpm
