// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_gran_cfpm.h"

#include "companions.h"
#include "model_arguments.h"
#include "time_step_report.h"
#include "wider_contact_distance.h"

#include "core/deck/restart_command.h"

#include "fix_property_atom.h"

#include <algorithm>
#include <cstring>

namespace cfpm::liggghts {

namespace models = LIGGGHTS::ContactModels;

namespace {
constexpr const char *style_name = "gran/cfpm";

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

/// The host makes a new object for every pair_style command; what was run before goes over from the old one.
struct {
  const LAMMPS_NS::LAMMPS *host = nullptr;
  MethodAndStep ran;
  LAMMPS_NS::bigint from = 0;
} last;
} // namespace

PairGranCfpm::PairGranCfpm(LAMMPS_NS::LAMMPS *host) : PairGranProxy(host) {
  // after the command clear time begins again; a run has made at least a step
  if (last.host != lmp || update->ntimestep <= last.from) return;
  ran_ = last.ran;
  ran_from_ = last.from;
}

PairGranCfpm::~PairGranCfpm() {
  last = {lmp, ran_, ran_from_};
  if (step_.budget) step_.budget->forget();
}

void PairGranCfpm::begin_run(double contact_time) {
  const MethodAndStep now{method_, update->dt};
  cfpm::begin_run(step_.crowd_step(), ran_, now, contact_time);
  ran_ = now;
  ran_from_ = update->ntimestep;
}

void PairGranCfpm::settings(int narg, char **arg) {
  // the host does not tell a style that its name in the deck has no suffix
  apply({arg, arg + narg}, std::string(lmp->input->arg[0]) == "gran" ? Command::suffixed : Command::named);
}

void PairGranCfpm::apply(std::vector<std::string> words, Command made) {
  std::vector<char *> pointers;
  pointers.reserve(words.size());
  for (std::string &word : words) pointers.push_back(word.data());
  arguments_ = std::make_unique<ModelArguments>(lmp, command(), static_cast<int>(pointers.size()), pointers.data(), 0,
                                                nullptr, made);
  method_ = arguments_->given_method();
  auto_.reset();
  if (!method_) method_ = &auto_.emplace(arguments_->law(), false).method();
  words_ = words;
  if (std::find(words.begin(), words.end(), "predict") == words.end())
    words_.insert(words_.end(), {"predict", auto_ ? AutoMethod::name : method_->name});
  PairGranProxy::settings(arguments_->count(), arguments_->values());
}

void PairGranCfpm::init_style() {
  const auto fail = [this](const std::string &what) {
    error->all(FLERR, (std::string(command()) + ": " + what).c_str());
  };
  if (!atom->sphere_flag) fail("particles have no radius; expected 'atom_style sphere' (or granular)");
  if (history && force->newton_pair) fail("a contact model with history needs 'newton off' before the box is defined");
  if (auto_) choose_method();
  const std::string &setting = arguments_->setting_without_prediction();
  if (method_->predicted && !setting.empty())
    fail("setting '" + setting + "' has no predicted form; switch it off or use 'predict none'");
  require_companions(*lmp, *this);
  step_.prepare(any_impulses(*lmp), any_onset(*lmp), arguments_->options().split);
  if (step_.gives_impulses && force->newton_pair)
    fail("'predict impulse' needs 'newton off' before the box is defined");
  if (step_.gives_impulses) {
    fix_before_ = property_of_particles(*lmp, "cfpmContactsBefore");
    fix_contacts_ = property_of_particles(*lmp, "cfpmContacts");
  }
  // the host finds the owner of contact history by the exact name of its own style
  publish_style("gran");
  PairGranProxy::init_style();
}

/// Contact times are known to the contact model once the host's properties are connected to it; that is done here for a
/// method that wants nothing of the host, and in PairGranProxy::init_style() for the one that is chosen.
void PairGranCfpm::choose_method() {
  method_ = &Verlet::method;
  init_granular();
  auto_->choose(shortest_contact(*lmp), update->dt);
  method_ = &auto_->method();
}

void PairGranCfpm::init_list(int id, LAMMPS_NS::NeighList *list) {
  PairGranProxy::init_list(id, list);
  left_to_host_ = reason_for_host_loop();
  publish_style(style_name); // every fix is initialised by now; a restart file must name this style
}

void PairGranCfpm::publish_style(const char *name) {
  delete[] force->pair_style;
  const std::size_t size = std::strlen(name) + 1;
  force->pair_style = new char[size];
  std::copy_n(name, size, force->pair_style);
}

// The host keeps only the models in a restart file, and then runs with the initial values of their settings,
// which are not the defaults.
void PairGranCfpm::write_restart_settings(FILE *file) {
  write_command(with_step(words_, ran_.dt), file);
  if (auto_) write_command(auto_->words(), file);
}

void PairGranCfpm::read_restart_settings(FILE *file, int, int) {
  const auto next_command = [&] {
    return read_command(comm->me == 0 ? file : nullptr,
                        [this](void *data, int bytes) { MPI_Bcast(data, bytes, MPI_BYTE, 0, world); });
  };
  std::vector<std::string> words = next_command();
  const double dt = take_step(words);
  if (words.empty())
    error->all(FLERR, "pair_style gran/cfpm: the restart file does not hold the settings of this style");
  apply(words, Command::named);
  if (auto_) auto_->restore(next_command());
  if (dt > 0.0) ran_ = {auto_ ? &auto_->method() : method_, dt};
  ran_from_ = update->ntimestep - 1; // or earlier
}

bool PairGranCfpm::host_loop_needed(int eflag, int vflag, int addflag) {
  if (!computeflag() || eflag || vflag || (addflag && cpl()) || feeds_others()) return true;
  // where a state is evaluated again, springs stay as they are
  return method_->predicted ? contact_model_->has_host_models() : !left_to_host_.empty() || !shearupdate();
}

bool PairGranCfpm::feeds_others() {
  return storeContactForces() || storeContactForcesStress() || storeSumDelta() || store_sum_normal_force() ||
         modify->n_fixes_style("relax_contacts") > 0 || modify->n_fixes_style("insert/stream/predefined") > 0;
}

std::string PairGranCfpm::reason_for_host_loop() {
  const std::string &setting = arguments_->setting_without_prediction();
  if (!setting.empty()) return "setting '" + setting + "' is on";
  if (fr_pair()) return "rigid bodies give their particles the masses of bodies";
  if (feeds_others()) return "another command takes more of contacts than their forces";
  // such a pair's contact ends as soon as it parts
  if (neighbor->contactDistanceFactor > 1.0) return "another command looks at pairs that are close";
  return contact_model_->reason_for_host_loop();
}

Particles PairGranCfpm::particles() { return particles_of(*atom, freeze_group_bit(), force->newton_pair != 0); }

PairList PairGranCfpm::pair_list() {
  const bool has_history = listgranhistory != nullptr;
  PairList pairs = pair_list_of(*list, NEIGHMASK);
  pairs.flags = has_history ? listgranhistory->firstneigh : nullptr;
  pairs.history = has_history ? listgranhistory->firstdouble : nullptr;
  pairs.history_size = dnum();
  pairs.spring_offset = contact_model_->spring_offset();
  pairs.spring_now_offset = contact_model_->spring_now_offset();
  pairs.touching = models::CONTACT_NORMAL_MODEL | models::CONTACT_TANGENTIAL_MODEL;
  pairs.remembers = !method_->predicted;
  return pairs;
}

/// For the loop over all of them, once in an evaluation.
PairList PairGranCfpm::pairs_to_evaluate() {
  if (neighbor->ago == 0) near_.forget(); // the host has listed its pairs anew
  PairList pairs = pair_list();
  pairs.near = &near_;
  return pairs;
}

std::vector<PairOverlap> PairGranCfpm::overlaps() {
  if (list->inum == 0) return {};
  return contact_model_->equivalent_overlaps(particles(), pair_list());
}

void PairGranCfpm::begin_impulses() {
  const int all = atom->nlocal + atom->nghost;
  step_.begin_impulses(all, fix_contacts_->vector_atom, fix_before_->vector_atom, !shearupdate(),
                       [this] { fix_before_->do_forward_comm(); });
}

void PairGranCfpm::compute_force(int eflag, int vflag, int addflag) {
  EnergyBudget *const budget = computeflag() ? step_.budget.get() : nullptr;
  if (!budget) return add_forces(eflag, vflag, addflag);
  const Particles all = particles();
  budget->begin_evaluation(atom->nlocal, all.count);
  budget->before_contacts(all, atom->nlocal);
  add_forces(eflag, vflag, addflag);
  budget->after_contacts(all, atom->nlocal);
  if (list->inum > 0) contact_model_->add_pair_energies(all, pair_list(), *budget);
}

std::string PairGranCfpm::reason_against_energy() {
  if (force->newton_pair) return "'newton on'; expected 'newton off' before the box is defined";
  const std::string &setting = arguments_->setting_without_prediction();
  if (!setting.empty()) return std::string(command()) + ": setting '" + setting + "' is on; expected it off";
  if (fr_pair()) return "bodies of several particles; expected single particles";
  if (contact_model_->has_host_models())
    return std::string(command()) + ": cohesion or rolling friction, whose energy is not told; expected neither";
  return "";
}

void PairGranCfpm::add_forces(int eflag, int vflag, int addflag) {
  if (computeflag()) {
    const int all = atom->nlocal + atom->nghost;
    step_.begin(update->dt, atom->nlocal, atom->v, all);
    smallest_radius_ = step_.foresees && all > 0 ? *std::min_element(atom->radius, atom->radius + all)
                                                 : std::numeric_limits<double>::infinity();
    if (step_.gives_impulses) begin_impulses();
  }
  if (host_loop_needed(eflag, vflag, addflag)) {
    near_.forget();
    // the host's loop does not see them before the next neighbour build, and a pair that meets again by then would
    // find its old spring
    if (method_->predicted && computeflag() && list->inum > 0) end_separated_contacts(particles(), pair_list());
    // not for output, where the host has counted rows within its own factor
    const double factor = computeflag() ? 1.0 + 0.5 * step_.ahead / smallest_radius_ : 1.0;
    const WiderContactDistance wider(*neighbor, factor);
    PairGranProxy::compute_force(eflag, vflag, addflag);
  } else {
    evflag = vflag_fdotr = 0;
    // both loops give the same forces to the last bit; this one carries nothing along for output or further models
    if (list->inum > 0) contact_model_->add_pair_forces(particles(), pairs_to_evaluate(), shearupdate() != 0);
  }
  if (!computeflag()) return;
  if (step_.gives_impulses) step_.take_pair_forces(atom->f, atom->nlocal);
  contact_model_->all_evaluated();
}

} // namespace cfpm::liggghts
