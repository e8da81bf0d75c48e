// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"

#include <string>

namespace cfpm::lammps {

/// fix nve/cfpm, also by the name nve/sphere/cfpm: moves spheres by the mean forces over the step that pair_style
/// gran/cfpm leaves in f and torque, all at its start (Eqs. 20, 27): v += dt f/m, x += dt (v + v')/2, and the spin
/// likewise.
class FixNveCfpm : public LAMMPS_NS::Fix {
public:
  FixNveCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;

  /// Of the inertia: 2 for discs, else 3.
  int dimension() const { return dimension_; }

private:
  void report();

  int dimension_ = 3;
  bool particles_reported_ = false;
  std::string last_report_;
};

} // namespace cfpm::lammps
