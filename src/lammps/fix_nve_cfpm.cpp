// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_nve_cfpm.h"

#include "companions.h"
#include "fix_contact_counts.h"
#include "host_versions.h"
#include "pair_gran_cfpm.h"
#include "setup_facts.h"
#include "time_step_report.h"

#include "core/contact/inertia.h"
#include "core/step/move_sphere.h"
#include "core/step/particles.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace cfpm::lammps {

FixNveCfpm::FixNveCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  std::vector<char *> words(arg, arg + 3);
  for (int k = 3; k < narg; ++k) {
    const std::string word = arg[k];
    if (word == "energy") {
      take_energy(++k < narg ? arg[k] : "nothing");
      continue;
    }
    if (word != "disc")
      error->all(FLERR, "fix nve/cfpm: unknown argument '" + word + "'; expected disc, energy yes|no or nothing");
    if (domain->dimension != 2)
      error->all(FLERR, std::string("fix nve/cfpm: disc in three dimensions; expected 'dimension 2'"));
    dimension_ = 2;
    words.push_back(arg[k]);
  }
  require_spheres(*lmp, "fix nve/cfpm");
  std::string host_style = "nve/sphere";
  words[2] = host_style.data();
  verlet_.reset(modify->fix_map->at(host_style)(lmp, static_cast<int>(words.size()), words.data()));
  time_integrate = 1;
  next_reneighbor = -1;
  dynamic_group_allow = 1;
}

void FixNveCfpm::take_energy(const std::string &value) {
  if (value != "yes" && value != "no")
    error->all(FLERR, "fix nve/cfpm: found '" + value + "' behind energy; expected yes or no");
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
  return INITIAL_INTEGRATE | POST_INTEGRATE | POST_NEIGHBOR | FINAL_INTEGRATE;
}

void FixNveCfpm::init() {
  int points = 0;
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit && atom->radius[i] <= 0.0) points = 1;
  MPI_Allreduce(MPI_IN_PLACE, &points, 1, MPI_INT, MPI_MAX, world);
  if (points) error->all(FLERR, std::string("fix nve/cfpm: a particle of the group has radius 0; expected spheres"));
  verlet_->init();
  if (budget_) budget_->begin_run();
  const PairGranCfpm *pair = find_pair(*lmp);
  predicted_ = !pair || pair->method().predicted;
  force_reneighbor = pair && any_onset(*lmp, *pair) && is_first();
}

void FixNveCfpm::setup(int) {
  report();
  if (force_reneighbor) look_ahead();
}

/// The first integrator does for all of them what is to be done once.
bool FixNveCfpm::is_first() const {
  for (const LAMMPS_NS::Fix *fix : fixes(*modify))
    if (dynamic_cast<const FixNveCfpm *>(fix)) return fix == this;
  return false;
}

void FixNveCfpm::report() {
  if (!is_first()) {
    particles_reported_ = true;
    return;
  }
  PairGranCfpm &pair = require_pair(*lmp, "fix nve/cfpm");
  const TimeStepReport report = report_time_step(*lmp, pair);
  pair.begin_run(report.shortest());
  particles_reported_ = report.has_particles();
  tell_facts(*lmp, report);
  if (report.text() == last_report_) return;
  last_report_ = report.text();
  if (comm->me != 0) return;
  LAMMPS_NS::utils::logmesg(lmp, last_report_);
  for (const std::string &warning : report.warnings()) error->warning(FLERR, "fix nve/cfpm: " + warning);
  if (report.too_large())
    error->warning(FLERR, std::string("fix nve/cfpm: time step too large for the predictor; see the nt and their "
                                      "limits above"));
}

void FixNveCfpm::final_integrate() {
  if (predicted_) return;
  if (const PairGranCfpm *pair = budget_ ? find_pair(*lmp) : nullptr)
    tell_energy(0.5 * update->dt, *pair, nullptr, [&] { verlet_->final_integrate(); });
  else
    verlet_->final_integrate();
}

void FixNveCfpm::reset_dt() { verlet_->reset_dt(); }

void FixNveCfpm::initial_integrate(int vflag) {
  if (!particles_reported_ && atom->natoms > 0) report(); // poured after the run began
  const double dt = update->dt;
  const PairGranCfpm *pair = find_pair(*lmp); // "run pre no" may find another one
  if (!predicted_ && pair && !pair->method().predicted)
    return tell_energy(0.5 * dt, *pair, nullptr, [&] { verlet_->initial_integrate(vflag); });
  if (!predicted_ || !pair || pair->step().dt != dt)
    error->all(FLERR, std::string("fix nve/cfpm: the time step or the pair style changed after the forces over it were "
                                  "predicted; change them only between runs and let 'run' do its setup"));
  const StepState &step = pair->step();
  if (step.particles != atom->nlocal)
    error->one(FLERR, std::string("fix nve/cfpm: particles were added or removed after the forces over the step were "
                                  "predicted; do it only between runs and let 'run' do its setup"));
  const bool counted = step.gives_impulses && FixContactCounts::find(*modify); // a deck may have taken it away
  const int frozen = pair->frozen();                                           // whose forces fix freeze has cleared
  const double inertia = inertia_factor(dimension_);
  const int nlocal = igroup == atom->firstgroup ? atom->nfirst : atom->nlocal;
  if (atom->nlocal == 0) return tell_energy(dt, *pair, nullptr, [] {});
  const VectorRows x(atom->x), v(atom->v), omega(atom->omega), f(atom->f), torque(atom->torque);
  const bool shifts = step.gives_impulses;
  tell_energy(dt, *pair, shifts ? &step.shift : nullptr, [&] {
    for (int i = 0; i < nlocal; ++i) {
      if (!(atom->mask[i] & groupbit)) continue;
      const Vec3 before = vec3(x[i]);
      if (counted) step.count_load(i, f[i]);
      move_sphere(dt, atom->rmass[i], atom->radius[i], inertia, f[i], torque[i],
                  shifts && !(atom->mask[i] & frozen) ? step.shift[i] : nullptr, x[i], v[i], omega[i]);
      if (!is_finite(vec3(x[i]))) fail_without_position(i, before);
    }
  });
}

/// Moves particles by what has been evaluated, over a time dt [s], and tells what does the work where a deck asks for
/// it. shift: of positions, or null.
template <class Move>
void FixNveCfpm::tell_energy(double dt, const PairGranCfpm &pair, const VectorRows *shift, const Move &move) {
  if (!budget_) return move();
  if (!budget_->is_for(atom->nlocal))
    error->one(FLERR,
               std::string(
                   "fix nve/cfpm: 'energy yes' was given, particles were added or removed, or the pair style was given "
                   "anew after the forces were evaluated; do it only between runs and let 'run' do its "
                   "setup"));
  const Particles particles = pair.particles();
  budget_->remember(particles);
  move();
  budget_->add_step(dt, particles, groupbit, shift);
}

EnergyBudget::Entries FixNveCfpm::energies() {
  EnergyBudget::Entries all =
      budget_->entries(particles_of(*atom, 0, false), atom->nlocal, groupbit, inertia_factor(dimension_));
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

/// Here, as the host looks at positions only when it lists neighbours anew, and what is not finite spreads from contact
/// to contact until then. Two centres at one place are a frequent reason: their contact has no direction. The other one
/// has not been moved yet, else it would have been found first, and neighbours on other ranks are where they were.
void FixNveCfpm::fail_without_position(int i, const Vec3 &before) const {
  const std::string step = std::to_string(static_cast<long long>(update->ntimestep));
  std::string what = "fix nve/cfpm: particle " + std::to_string(static_cast<long long>(atom->tag[i])) +
                     " has no finite position after step " + step;
  const int all = atom->nlocal + atom->nghost;
  int other = 0;
  while (other < all && (other == i || !(vec3(atom->x[other]) == before))) ++other;
  if (other < all)
    what += ": it was at one place with particle " + std::to_string(static_cast<long long>(atom->tag[other])) +
            ", where their contact has no direction; expected particles apart from each other";
  else
    what += "; expected finite forces, velocities and masses, and particles whose centre is on no wall; forces without "
            "end also come of too large a time step";
  error->one(FLERR, what);
  std::abort(); // not reached
}

void FixNveCfpm::post_neighbor() {
  if (force_reneighbor) foresight_.list(atom->x, atom->nlocal);
}

void FixNveCfpm::post_integrate() {
  if (force_reneighbor && look_ahead()) next_reneighbor = update->ntimestep;
}

/// What begins inside the coming step is sought among the listed pairs: those that were nearer than the skin when they
/// were listed. No other pair can touch while no particle comes farther from there than half of the skin. Whether
/// neighbours are to be listed anew.
bool FixNveCfpm::look_ahead() {
  const double half_skin = 0.5 * neighbor->skin;
  const Foresight::Look look =
      foresight_.look(atom->x, atom->v, atom->radius, atom->nlocal, update->dt, [half_skin](int) { return half_skin; });
  int found[2] = {look.outdated, look.too_long};
  MPI_Allreduce(MPI_IN_PLACE, found, 2, MPI_INT, MPI_MAX, world);
  if (found[1] && !long_moves_told_ && comm->me == 0)
    error->warning(FLERR, LongMoves::first("fix nve/cfpm", static_cast<long>(update->ntimestep)));
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
  if (comm->me == 0) error->warning(FLERR, all.text("fix nve/cfpm"));
}

} // namespace cfpm::lammps
