// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"

#include "core/numbers/vec3.h"
#include "core/step/energy_budget.h"
#include "core/step/foresight.h"

#include <memory>
#include <string>

namespace cfpm::lammps {

class PairGranCfpm;

/// fix nve/cfpm, also by the name nve/sphere/cfpm: moves spheres by the mean forces over the step that pair_style
/// gran/cfpm leaves in f and torque, all at its start (Eqs. 20, 27): v += dt f/m, x += dt (v + v')/2, and the spin
/// likewise; where impulses are given, positions are also shifted by what these say. Where the pair style leaves forces
/// of one instant, the host's fix nve/sphere does its own step.
///
/// With "energy yes" it tells the budget of energy of its particles.
class FixNveCfpm : public LAMMPS_NS::Fix {
public:
  FixNveCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void final_integrate() override;
  void reset_dt() override;
  void post_integrate() override;
  void setup_post_neighbor() override { post_neighbor(); }
  void post_neighbor() override;
  void post_run() override;

  double compute_scalar() override;
  double compute_vector(int n) override;
  void write_restart(FILE *file) override;
  void restart(char *state) override;

  /// Of the inertia: 2 for discs, else 3.
  int dimension() const { return dimension_; }
  /// Null if the deck does not ask for it.
  const std::shared_ptr<EnergyBudget> &budget() const { return budget_; }

private:
  void report();
  bool is_first() const;
  [[noreturn]] void fail_without_position(int i, const Vec3 &before) const;
  bool look_ahead();
  void take_energy(const std::string &value);
  template <class Move>
  void tell_energy(double dt, const PairGranCfpm &pair, const VectorRows *shift, const Move &move);
  EnergyBudget::Entries energies();

  int dimension_ = 3;
  std::shared_ptr<EnergyBudget> budget_;
  std::unique_ptr<LAMMPS_NS::Fix> verlet_; ///< fix nve/sphere
  bool predicted_ = true;                  ///< what this run began with
  bool particles_reported_ = false;
  std::string last_report_;
  Foresight foresight_;
  bool long_moves_told_ = false; ///< in this run
};

} // namespace cfpm::lammps
