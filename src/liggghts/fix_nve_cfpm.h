// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"

#include "core/numbers/vec3.h"
#include "core/step/energy_budget.h"
#include "core/step/foresight.h"

#include <memory>
#include <string>
#include <vector>

namespace cfpm::liggghts {

class FixWallGranCfpm;
class PairGranCfpm;

/// fix nve/cfpm: the step of the contact force prediction method for spheres (Eqs. 20 and 27).
/// f holds the mean force over the coming step, so with a = f/m
///   x(t + dt) = x + dt v + dt^2 a/2,  v(t + dt) = v + dt a,  likewise the angular velocity,
/// and what contacts shift positions by beyond that, see MeanForce.
/// Positions and velocities are those of the same time in every output.
/// Where the pair style leaves forces of one instant, the host's fix nve/sphere does its own step.
/// With "energy yes" it tells the budget of energy of its particles.
class FixNveCfpm : public LAMMPS_NS::Fix {
public:
  FixNveCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void set_arrays(int i) override;
  void initial_integrate(int vflag) override;
  void post_integrate() override;
  void setup_pre_neighbor() override { pre_neighbor(); }
  void pre_neighbor() override;
  void final_integrate() override;
  void post_run() override;
  void reset_dt() override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  void write_restart(FILE *file) override;
  void restart(char *state) override;

  /// Null if the deck does not ask for it.
  const std::shared_ptr<EnergyBudget> &budget() const { return budget_; }

private:
  bool is_first();
  bool look_ahead();
  void take_energy(int narg, char **arg);
  void require_energy();
  template <class Move> void tell_energy(double dt, PairGranCfpm &pair, const VectorRows *shift, const Move &move);
  EnergyBudget::Entries energies();
  void fail_without_position(int i, const Vec3 &before) const;

  std::shared_ptr<EnergyBudget> budget_;
  std::unique_ptr<LAMMPS_NS::Fix> verlet_; ///< fix nve/sphere
  bool predicted_ = true;                  ///< what this run began with
  long added_after_ = -1;                  ///< how many predictions there were when a particle was added last
  Foresight foresight_;
  bool long_moves_told_ = false;                    ///< in this run
  bool primitive_walls_ = false;                    ///< whether there are any that give impulses
  std::vector<const FixWallGranCfpm *> mesh_walls_; ///< that give impulses
  std::string last_report_;                         ///< a deck of many runs is told about its time step once
};

} // namespace cfpm::liggghts
