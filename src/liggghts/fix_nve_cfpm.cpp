// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_nve_cfpm.h"

#include "companions.h"
#include "fix_wall_gran_cfpm.h"
#include "pair_gran_cfpm.h"
#include "setup_facts.h"
#include "time_step_report.h"

#include "core/contact/inertia.h"
#include "core/step/move_sphere.h"
#include "core/step/particles.h"

#include "fix_nve_sphere.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

namespace cfpm::liggghts {

FixNveCfpm::FixNveCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  if (narg > 3) take_energy(narg, arg);
  if (!atom->sphere_flag)
    error->all(FLERR, "fix nve/cfpm: particles have no radius; expected 'atom_style sphere' (or granular)");
  std::string host_style = "nve/sphere";
  char *words[] = {arg[0], arg[1], host_style.data()};
  verlet_ = std::make_unique<LAMMPS_NS::FixNVESphere>(lmp, 3, words);
  time_integrate = 1;
  next_reneighbor = -1;
  create_attribute = 1; // asks the host for set_arrays()
}

void FixNveCfpm::take_energy(int narg, char **arg) {
  const std::string value = narg > 4 ? arg[4] : "nothing";
  if (std::string(arg[3]) != "energy" || narg > 5)
    error->all(FLERR, (std::string("fix nve/cfpm: unknown argument '") + arg[narg > 5 ? 5 : 3] +
                       "'; expected 'fix ID group nve/cfpm' with nothing or energy yes|no behind")
                          .c_str());
  if (value != "yes" && value != "no")
    error->all(FLERR, ("fix nve/cfpm: found '" + value + "' behind energy; expected yes or no").c_str());
  if (value == "no") return;
  budget_ = std::make_shared<EnergyBudget>();
  scalar_flag = vector_flag = 1;
  size_vector = EnergyBudget::entry_count;
  extscalar = extvector = 1;
  global_freq = 1;
  restart_global = 1;
}

int FixNveCfpm::setmask() {
  using namespace LAMMPS_NS::FixConst;
  return INITIAL_INTEGRATE | POST_INTEGRATE | PRE_NEIGHBOR | FINAL_INTEGRATE | POST_RUN;
}

void FixNveCfpm::init() {
  require_cfpm_pair(*lmp, "fix nve/cfpm");
  predicted_ = static_cast<const PairGranCfpm *>(force->pair)->method().predicted;
  int points = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit && atom->radius[i] <= 0.0) points = 1;
  MPI_Allreduce(MPI_IN_PLACE, &points, 1, MPI_INT, MPI_MAX, world);
  if (points) error->all(FLERR, "fix nve/cfpm: a particle of the group has radius 0; expected spheres");
  verlet_->init();
  if (budget_) budget_->begin_run();
  if (is_first()) static_cast<PairGranCfpm *>(force->pair)->tell_energies_to(budget_);

  const auto *pair = static_cast<const PairGranCfpm *>(force->pair);
  force_reneighbor = is_first() && any_onset(*lmp);
  mesh_walls_.clear();
  primitive_walls_ = false;
  for (int i = 0; i < modify->nfix; ++i) {
    const auto *wall = dynamic_cast<const FixWallGranCfpm *>(modify->fix[i]);
    if (!wall || !pair->onset_of(wall->method())) continue;
    if (wall->is_mesh_wall())
      mesh_walls_.push_back(wall);
    else
      primitive_walls_ = true;
  }
}

/// The first integrator does for all of them what is to be done once.
bool FixNveCfpm::is_first() {
  for (int i = 0; modify->fix[i] != this; ++i)
    if (dynamic_cast<FixNveCfpm *>(modify->fix[i])) return false;
  return true;
}

void FixNveCfpm::setup(int) {
  added_after_ = -1; // the forces of all particles have just been predicted, maybe by another pair style than before
  if (force_reneighbor) look_ahead();
  if (budget_) require_energy();
  if (!is_first()) return;
  const TimeStepReport report = report_time_step(*lmp);
  static_cast<PairGranCfpm *>(force->pair)->begin_run(report.shortest());
  tell_facts(*lmp, report);
  if (report.text() == last_report_) return;
  last_report_ = report.text();
  if (comm->me != 0) return;
  for (FILE *out : {screen, logfile})
    if (out) std::fputs(last_report_.c_str(), out);
  for (const std::string &warning : report.warnings()) error->warning(FLERR, ("fix nve/cfpm: " + warning).c_str());
  if (report.too_large())
    error->warning(FLERR, "fix nve/cfpm: time step too large for the predictor; see the nt and their limits above");
}

/// For every particle that is added. One for which no forces are predicted by the next step has come between two runs,
/// the second of them with 'pre no'; where as many were removed the number alone would not tell.
void FixNveCfpm::set_arrays(int) {
  const auto *pair = dynamic_cast<const PairGranCfpm *>(force->pair);
  if (pair) added_after_ = pair->step().evaluations;
}

/// Stops the run where something has no budget of energy.
void FixNveCfpm::require_energy() {
  std::string wrong = static_cast<PairGranCfpm *>(force->pair)->reason_against_energy();
  if (force->ftm2v != 1.0)
    wrong = std::string("units ") + update->unit_style +
            ": forces over masses are no accelerations there; expected lj, si, cgs or micro";
  int integrators = 0;
  for (int i = 0; i < modify->nfix && wrong.empty(); ++i) {
    const LAMMPS_NS::Fix &fix = *modify->fix[i];
    const std::string name = std::string("fix ") + fix.style + " (id " + fix.id + "): ";
    if (dynamic_cast<const FixNveCfpm *>(&fix) && ++integrators > 1)
      wrong = name + "the budget is of the particles of one fix nve/cfpm; expected one for all of them";
    const auto *wall = dynamic_cast<const FixWallGranCfpm *>(&fix);
    if (wall && !wall->reason_against_energy().empty()) wrong = name + wall->reason_against_energy();
    if (!wall && std::string(fix.style).rfind("wall/gran", 0) == 0)
      wrong = name + "its contacts are the host's; expected fix wall/gran/cfpm";
  }
  if (!wrong.empty()) error->all(FLERR, ("fix nve/cfpm: 'energy yes' beside " + wrong).c_str());
}

void FixNveCfpm::final_integrate() {
  if (predicted_) return;
  auto *pair = dynamic_cast<PairGranCfpm *>(force->pair);
  if (budget_ && pair)
    tell_energy(0.5 * update->dt, *pair, nullptr, [&] { verlet_->final_integrate(); });
  else
    verlet_->final_integrate();
}

void FixNveCfpm::reset_dt() { verlet_->reset_dt(); }

void FixNveCfpm::initial_integrate(int vflag) {
  const double dt = update->dt;
  auto *pair = static_cast<PairGranCfpm *>(force->pair); // "run pre no" may find another one
  if (!predicted_ && !pair->method().predicted)
    return tell_energy(0.5 * dt, *pair, nullptr, [&] { verlet_->initial_integrate(vflag); });
  const StepState &step = pair->step();
  if (!predicted_ || step.dt != dt)
    error->all(FLERR, "fix nve/cfpm: the time step or the pair style changed after the forces over it were predicted; "
                      "change them only between runs and let 'run' do its setup");
  if (step.particles != atom->nlocal || added_after_ == step.evaluations)
    error->one(FLERR, "fix nve/cfpm: particles were added or removed after the forces over the step were predicted; do "
                      "it only between runs and let 'run' do its setup");
  const double inertia = inertia_factor(domain->dimension);
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  const int frozen = pair->freeze_group_bit(); // whose forces fix freeze has cleared
  if (atom->nlocal == 0) return tell_energy(dt, *pair, nullptr, [] {});
  const VectorRows x(atom->x), v(atom->v), omega(atom->omega), f(atom->f), torque(atom->torque);
  const bool shifts = step.gives_impulses;
  tell_energy(dt, *pair, shifts ? &step.shift : nullptr, [&] {
    for (int i = 0; i < nlocal; ++i) {
      if (!(atom->mask[i] & groupbit)) continue;
      const Vec3 before = vec3(x[i]);
      if (shifts) step.count_load(i, f[i]);
      move_sphere(dt, atom->rmass[i], atom->radius[i], inertia, f[i], torque[i],
                  shifts && !(atom->mask[i] & frozen) ? step.shift[i] : nullptr, x[i], v[i], omega[i]);
      if (!std::isfinite(x[i][0] + x[i][1] + x[i][2])) fail_without_position(i, before);
    }
  });
}

/// Moves particles by what has been evaluated, over a time dt [s], and tells what does the work where a deck asks for
/// it. shift: of positions, or null.
template <class Move>
void FixNveCfpm::tell_energy(double dt, PairGranCfpm &pair, const VectorRows *shift, const Move &move) {
  if (!budget_) return move();
  if (!budget_->is_for(atom->nlocal))
    error->one(FLERR,
               "fix nve/cfpm: 'energy yes' was given, particles were added or removed, or the pair style was given "
               "anew after the forces were evaluated; do it only between runs and let 'run' do its "
               "setup");
  const Particles particles = pair.particles();
  budget_->remember(particles);
  move();
  budget_->add_step(dt, particles, groupbit, shift);
}

EnergyBudget::Entries FixNveCfpm::energies() {
  EnergyBudget::Entries all =
      budget_->entries(particles_of(*atom, 0, false), atom->nlocal, groupbit, inertia_factor(domain->dimension));
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, world);
  return all;
}

double FixNveCfpm::compute_scalar() { return EnergyBudget::balance(energies()); }

double FixNveCfpm::compute_vector(int n) { return energies()[static_cast<std::size_t>(n)]; }

void FixNveCfpm::write_restart(FILE *file) {
  EnergyBudget::Accumulated sums = budget_->accumulated();
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, world);
  if (comm->me != 0) return;
  const int bytes = sizeof sums;
  std::fwrite(&bytes, sizeof bytes, 1, file);
  std::fwrite(sums.data(), sizeof sums, 1, file);
}

/// Sums of all ranks, which go on as those of one.
void FixNveCfpm::restart(char *state) {
  EnergyBudget::Accumulated sums;
  std::memcpy(sums.data(), state, sizeof sums);
  if (comm->me != 0) sums = {};
  budget_->begin_with(sums);
}

/// Two particles at one place have no normal to act along, nor has one that lies in a wall. The partner has not been
/// moved yet, or it would have been found first.
void FixNveCfpm::fail_without_position(int i, const Vec3 &before) const {
  char text[300];
  std::snprintf(text, sizeof text,
                "fix nve/cfpm: particle %d has no finite position after the step; expected no centre in a wall, and "
                "finite velocities and forces",
                atom->tag[i]);
  for (int j = 0; j < atom->nlocal + atom->nghost; ++j)
    if (j != i && atom->x[j][0] == before.x && atom->x[j][1] == before.y && atom->x[j][2] == before.z)
      std::snprintf(text, sizeof text,
                    "fix nve/cfpm: particle %d has no finite position after the step; it and particle %d were at one "
                    "place, (%.6g, %.6g, %.6g); expected particles with different centres",
                    atom->tag[i], atom->tag[j], before.x, before.y, before.z);
  error->one(FLERR, text);
}

void FixNveCfpm::pre_neighbor() {
  if (force_reneighbor) foresight_.list(atom->x, atom->nlocal);
}

void FixNveCfpm::post_integrate() {
  if (force_reneighbor && look_ahead()) next_reneighbor = update->ntimestep;
}

/// What begins inside the coming step is sought among the listed pairs: those that were nearer than
/// contact_distance_factor and the skin say when they were listed. Of the skin one half belongs to each partner, a wall
/// or mesh too. Primitive walls list all particles within the skin, whatever the factor. What a mesh moves by is taken
/// from the reach of all particles, of two steps: it moves in the coming one, and the host lists it anew one step after
/// it has used up its half of the skin. Whether neighbours are to be listed anew.
bool FixNveCfpm::look_ahead() {
  double of_meshes = 0.0;
  for (const FixWallGranCfpm *wall : mesh_walls_)
    of_meshes = std::max(of_meshes, update->dt * wall->largest_mesh_speed());
  const double half_skin = 0.5 * neighbor->skin;
  const double part_of_radius = neighbor->contactDistanceFactor - 1.0;
  const auto reach = [&](int i) {
    const double beyond_half_skin = part_of_radius * atom->radius[i] - 2.0 * of_meshes;
    return half_skin + (primitive_walls_ ? std::min(beyond_half_skin, half_skin) : beyond_half_skin);
  };
  const Foresight::Look look = foresight_.look(atom->x, atom->v, atom->radius, atom->nlocal, update->dt, reach);
  int found[2] = {look.outdated, look.too_long};
  MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_INT, MPI_MAX, world);
  if (found[1] && !long_moves_told_ && comm->me == 0)
    error->warning(FLERR, LongMoves::first("fix nve/cfpm", static_cast<long>(update->ntimestep)).c_str());
  long_moves_told_ = long_moves_told_ || found[1];
  return found[0] != 0;
}

void FixNveCfpm::post_run() {
  if (!long_moves_told_) return;
  long_moves_told_ = false;
  LongMoves all = foresight_.take_long_moves();
  MPI_Allreduce(MPI_IN_PLACE, &all.count, 1, MPI_LONG, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, &all.passing, 1, MPI_LONG, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, &all.missing, 1, MPI_DOUBLE, MPI_MAX, world);
  if (comm->me == 0) error->warning(FLERR, all.text("fix nve/cfpm").c_str());
}

} // namespace cfpm::liggghts
