// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_nve_cfpm.h"

#include "companions.h"
#include "pair_gran_cfpm.h"

#include <string>

namespace cfpm::lammps {

FixNveCfpm::FixNveCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (narg > 3)
    error->all(FLERR,
               std::string("fix nve/cfpm: unknown argument '") + arg[3] + "'; expected only 'fix ID group nve/cfpm'");
  if (!atom->sphere_flag)
    error->all(FLERR, std::string("fix nve/cfpm: particles have no radius; expected 'atom_style sphere'"));
  time_integrate = 1;
  dynamic_group_allow = 1;
}

int FixNveCfpm::setmask() { return LAMMPS_NS::FixConst::INITIAL_INTEGRATE; }

void FixNveCfpm::init() {
  pair_ = &require_predicted_pair(*lmp, "fix nve/cfpm");
  int points = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit && atom->radius[i] <= 0.0) points = 1;
  MPI_Allreduce(MPI_IN_PLACE, &points, 1, MPI_INT, MPI_MAX, world);
  if (points) error->all(FLERR, std::string("fix nve/cfpm: a particle of the group has radius 0; expected spheres"));
}

void FixNveCfpm::initial_integrate(int) {
  const double dt = update->dt;
  if (pair_->predicted_step() != dt)
    error->all(FLERR, std::string("fix nve/cfpm: the time step changed after the forces over it were predicted; "
                                  "change it only between runs and let 'run' do its setup"));
  const double per_force = dt * force->ftm2v;
  const double inertia = domain->dimension == 2 ? 0.5 : 0.4; // of a disc, or a sphere
  double **const x = atom->x;
  double **const v = atom->v;
  double **const f = atom->f;
  double **const omega = atom->omega;
  double **const torque = atom->torque;
  const double *const radius = atom->radius;
  const double *const rmass = atom->rmass;
  const int *const mask = atom->mask;
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;

  for (int i = 0; i < nlocal; ++i) {
    if (!(mask[i] & groupbit)) continue;
    const double per_mass = per_force / rmass[i];
    const double spin = per_mass / (inertia * radius[i] * radius[i]);
    for (int k = 0; k < 3; ++k) {
      const double dv = per_mass * f[i][k];
      x[i][k] += dt * (v[i][k] + 0.5 * dv);
      v[i][k] += dv;
      omega[i][k] += spin * torque[i][k];
    }
  }
}

} // namespace cfpm::lammps
