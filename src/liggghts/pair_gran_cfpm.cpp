// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_gran_cfpm.h"

#include "companions.h"
#include "model_arguments.h"

#include "fix_property_atom.h"

#include <algorithm>
#include <cstring>

namespace cfpm::liggghts {

namespace models = LIGGGHTS::ContactModels;

namespace {
constexpr const char *style_name = "gran/cfpm";
constexpr int longest_command = 1 << 16; // in a restart file; anything else is not of this style

/// A value of each particle that goes with it from rank to rank and into restart files; 0 at first.
LAMMPS_NS::FixPropertyAtom *property_of_particles(LAMMPS_NS::LAMMPS &lmp, const char *name) {
  LAMMPS_NS::Modify &modify = *lmp.modify;
  if (!modify.find_fix_property(name, "property/atom", "scalar", 0, 0, "pair_style gran/cfpm", false)) {
    std::vector<std::string> words{name, "all", "property/atom", name, "scalar", "yes", "yes", "no", "0.0"};
    std::vector<char *> pointers;
    pointers.reserve(words.size());
    for (std::string &word : words) pointers.push_back(word.data());
    modify.add_fix(static_cast<int>(pointers.size()), pointers.data());
  }
  return static_cast<LAMMPS_NS::FixPropertyAtom *>(
      modify.find_fix_property(name, "property/atom", "scalar", 0, 0, "pair_style gran/cfpm"));
}
} // namespace

void PairGranCfpm::settings(int narg, char **arg) {
  ModelArguments arguments(lmp, command(), narg, arg, 0);
  command_line_.clear();
  for (int k = 0; k < narg; ++k) command_line_ += std::string(arg[k]) + '\0';
  options_ = arguments.impulse_options();
  predictor_ = arguments.prediction().value_or(default_predictor(arguments.law()));
  setting_without_prediction_ = arguments.setting_without_prediction();
  PairGranProxy::settings(arguments.count(), arguments.values());
}

void PairGranCfpm::init_style() {
  const auto fail = [this](const std::string &what) {
    error->all(FLERR, (std::string(command()) + ": " + what).c_str());
  };
  if (!atom->sphere_flag) fail("particles have no radius; expected 'atom_style sphere' (or granular)");
  if (history && force->newton_pair) fail("a contact model with history needs 'newton off' before the box is defined");
  if (predictor_ && !setting_without_prediction_.empty())
    fail("setting '" + setting_without_prediction_ + "' has no predicted form; switch it off or use 'predict none'");
  require_companions(*lmp, *this);
  gives_impulses_ = any_impulses(*lmp);
  if (gives_impulses_ && force->newton_pair) fail("'predict impulse' needs 'newton off' before the box is defined");
  if (gives_impulses_ && options_.onset && (neighbor->delay > 0 || neighbor->every > 1))
    fail("contacts that begin inside a step are found only with neighbor lists that are never late; expected "
         "'neigh_modify delay 0 every 1', or 'onset off'");
  shared_step_ = {};
  shared_step_.onset = options_.onset;
  shared_step_.crowd.split = options_.split;
  if (gives_impulses_) {
    fix_before_ = property_of_particles(*lmp, "cfpmContactsBefore");
    fix_contacts_ = property_of_particles(*lmp, "cfpmContacts");
  }
  // the host finds the owner of contact history by the exact name of its own style
  publish_style("gran");
  PairGranProxy::init_style();
}

void PairGranCfpm::init_list(int id, LAMMPS_NS::NeighList *list) {
  PairGranProxy::init_list(id, list);
  publish_style(style_name); // every fix is initialised by now; a restart file must name this style
}

void PairGranCfpm::publish_style(const char *name) {
  delete[] force->pair_style;
  const std::size_t size = std::strlen(name) + 1;
  force->pair_style = new char[size];
  std::copy_n(name, size, force->pair_style);
}

// The host keeps only the models in a restart file, and then runs with the initial values of their settings,
// which are not the defaults. Here the whole command is kept.
void PairGranCfpm::write_restart_settings(FILE *file) {
  const int length = static_cast<int>(command_line_.size());
  std::fwrite(&length, sizeof length, 1, file);
  std::fwrite(command_line_.data(), 1, command_line_.size(), file);
}

void PairGranCfpm::read_restart_settings(FILE *file, int, int) {
  int length = 0;
  std::string text;
  if (comm->me == 0) {
    bool readable = std::fread(&length, sizeof length, 1, file) == 1 && length > 0 && length < longest_command;
    text.resize(readable ? static_cast<std::size_t>(length) : 0);
    readable = readable && std::fread(text.data(), 1, text.size(), file) == text.size() && text.back() == '\0';
    if (!readable) length = 0;
  }
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  if (length == 0) error->all(FLERR, "pair_style gran/cfpm: the restart file does not hold the settings of this style");
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, world);
  std::vector<char *> arguments;
  for (std::size_t at = 0; at < text.size(); at += std::strlen(&text[at]) + 1) arguments.push_back(&text[at]);
  settings(static_cast<int>(arguments.size()), arguments.data());
}

bool PairGranCfpm::host_loop_needed(int eflag, int vflag, int addflag) {
  return !predictor_ || !computeflag() || eflag || vflag || (addflag && cpl()) || contacts_->has_host_models() ||
         storeContactForces() || storeContactForcesStress() || storeSumDelta() || store_sum_normal_force() ||
         modify->n_fixes_style("relax_contacts") > 0 || modify->n_fixes_style("insert/stream/predefined") > 0;
}

ListedPairs PairGranCfpm::listed_pairs() {
  const bool has_history = listgranhistory != nullptr;
  ListedPairs pairs;
  pairs.x = VectorRows(atom->x);
  pairs.v = VectorRows(atom->v);
  pairs.omega = VectorRows(atom->omega);
  pairs.f = VectorRows(atom->f);
  pairs.torque = VectorRows(atom->torque);
  pairs.shift = shared_step_.shift;
  pairs.radius = atom->radius;
  pairs.mass = atom->rmass;
  if (predictor_->impulse) pairs.crowd = shared_step_.crowd;
  pairs.contacts = shared_step_.contacts;
  pairs.ahead = shared_step_.ahead;
  pairs.type = atom->type;
  pairs.group = atom->mask;
  pairs.frozen = freeze_group_bit();
  pairs.receiving = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
  pairs.count = list->inum;
  pairs.first = list->ilist;
  pairs.neighbor_count = list->numneigh;
  pairs.neighbors = list->firstneigh;
  pairs.index_mask = NEIGHMASK;
  pairs.flags = has_history ? listgranhistory->firstneigh : nullptr;
  pairs.history = has_history ? listgranhistory->firstdouble : nullptr;
  pairs.history_size = dnum();
  pairs.spring_offset = contacts_->spring_offset();
  pairs.spring_now_offset = contacts_->spring_now_offset();
  pairs.touching = models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL;
  return pairs;
}

/// What pairs and then walls add to. The other contacts of a particle are those of the step before: walls count after
/// the pairs have been evaluated.
void PairGranCfpm::begin_shared_step() {
  const auto count = static_cast<std::size_t>(atom->nlocal);
  shift_.assign(3 * count, 0.0);
  shared_step_.shift = VectorRows(shift_.data());
  if (shared_step_.onset) shared_step_.ahead = largest_approach(atom->v, atom->nlocal + atom->nghost, update->dt);
  double *const contacts = fix_contacts_->vector_atom;
  if (shearupdate()) std::copy_n(contacts, count, fix_before_->vector_atom); // else the same step again
  fix_before_->do_forward_comm();
  std::fill_n(contacts, count, 0.0);
  shared_step_.crowd.contacts = fix_before_->vector_atom;
  shared_step_.contacts = contacts;
}

void PairGranCfpm::compute_force(int eflag, int vflag, int addflag) {
  if (computeflag() && gives_impulses_) begin_shared_step();
  if (host_loop_needed(eflag, vflag, addflag)) {
    // the host's loop does not see them before the next neighbour build, and a pair that meets again by then would
    // find its old spring
    if (predictor_ && computeflag() && list->inum > 0) end_separated_contacts(listed_pairs());
    PairGranProxy::compute_force(eflag, vflag, addflag);
  } else {
    evflag = vflag_fdotr = 0;
    // both loops give the same forces to the last bit; this one carries nothing along for output or further models
    if (list->inum > 0) contacts_->add_pair_forces(listed_pairs(), shearupdate() != 0);
  }
  if (!computeflag()) return;
  predicted_step_ = update->dt;
  predicted_particles_ = atom->nlocal;
  ++predictions_;
  contacts_->all_evaluated();
}

} // namespace cfpm::liggghts
