// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_nve_cfpm.h"

#include "companions.h"
#include "pair_gran_cfpm.h"
#include "time_step_report.h"

#include "../core/sphere_step.h"

#include <string>

namespace cfpm::lammps {

FixNveCfpm::FixNveCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  for (int k = 3; k < narg; ++k) {
    if (std::string(arg[k]) != "disc")
      error->all(FLERR, std::string("fix nve/cfpm: unknown argument '") + arg[k] + "'; expected disc or nothing");
    if (domain->dimension != 2)
      error->all(FLERR, std::string("fix nve/cfpm: disc in three dimensions; expected 'dimension 2'"));
    dimension_ = 2;
  }
  require_spheres(*lmp, "fix nve/cfpm");
  time_integrate = 1;
  dynamic_group_allow = 1;
}

int FixNveCfpm::setmask() { return LAMMPS_NS::FixConst::INITIAL_INTEGRATE; }

void FixNveCfpm::init() {
  int points = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit && atom->radius[i] <= 0.0) points = 1;
  MPI_Allreduce(MPI_IN_PLACE, &points, 1, MPI_INT, MPI_MAX, world);
  if (points) error->all(FLERR, std::string("fix nve/cfpm: a particle of the group has radius 0; expected spheres"));
}

void FixNveCfpm::setup(int) { report(); }

void FixNveCfpm::report() {
  for (int i = 0; modify->fix[i] != this; ++i)
    if (dynamic_cast<FixNveCfpm *>(modify->fix[i])) {
      particles_reported_ = true; // by the first integrator for all
      return;
    }
  const TimeStepReport report = report_time_step(*lmp, require_predicted_pair(*lmp, "fix nve/cfpm"));
  particles_reported_ = report.has_particles();
  if (report.text() == last_report_) return;
  last_report_ = report.text();
  if (comm->me != 0) return;
  LAMMPS_NS::utils::logmesg(lmp, last_report_);
  if (report.too_large())
    error->warning(FLERR, std::string("fix nve/cfpm: time step too large for the predictor; see the nt and their "
                                      "limits above"));
}

void FixNveCfpm::initial_integrate(int) {
  if (!particles_reported_ && atom->natoms > 0) report(); // poured after the run began
  const double dt = update->dt;
  const PairGranCfpm *pair = find_pair(*lmp); // "run pre no" may find another one
  if (!pair || pair->predicted_step() != dt)
    error->all(FLERR, std::string("fix nve/cfpm: the time step or the pair style changed after the forces over it were "
                                  "predicted; change them only between runs and let 'run' do its setup"));
  const double inertia = inertia_factor(dimension_);
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  for (int i = 0; i < nlocal; ++i)
    if (atom->mask[i] & groupbit)
      move_sphere(dt, atom->rmass[i], atom->radius[i], inertia, atom->f[i], atom->torque[i], nullptr, atom->x[i],
                  atom->v[i], atom->omega[i]);
}

} // namespace cfpm::lammps
