// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_gran_cfpm.h"

#include "companions.h"
#include "fix_contact_counts.h"
#include "host_versions.h"
#include "move_fixes.h"
#include "time_step_report.h"

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/wider_history.h"
#include "core/deck/finite_number.h"
#include "core/deck/restart_command.h"
#include "core/step/energy_budget.h"

#include "citeme.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

namespace cfpm::lammps {

namespace {

/// Contact histories of another size get another number, so that none is taken for one of this size in a restart file.
constexpr int number_of_larger = 1000000;

constexpr const char *paper = R"(pair_style gran/cfpm command:

@Article{Tokoro2005,
 author =  {C. Tokoro and K. Okaya and J. Sadaki},
 title =   {A Fast Algorithm for the Discrete Element Method by Contact Force Prediction},
 journal = {KONA Powder and Particle Journal},
 year =    2005,
 volume =  23
}

)";

/// As the host takes the arguments of a command.
std::vector<char *> pointers_to(std::vector<std::string> &words) {
  std::vector<char *> pointers;
  pointers.reserve(words.size());
  for (std::string &word : words) pointers.push_back(word.data());
  return pointers;
}

/// The group bit of fix freeze, or 0.
int frozen_group(LAMMPS_NS::Modify &modify) {
  for (const LAMMPS_NS::Fix *fix : fixes(modify))
    if (std::string(fix->style).rfind("freeze", 0) == 0) return fix->groupbit;
  return 0;
}

} // namespace

PairGranCfpm::PairGranCfpm(LAMMPS_NS::LAMMPS *lmp, std::unique_ptr<PairLaw> law, std::string model)
    : PairAroundHostStyle(lmp), law_(std::move(law)), model_(std::move(model)) {
  // what the host's granular styles say of themselves
  single_enable = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = LAMMPS_NS::CENTROID_NOTAVAIL;
  finitecutflag = 1;
  comm_forward = 1;
  comm_reverse = static_cast<int>(EnergyBudget::values_per_particle); // or fewer: shift, contact force and count
  if (lmp->citeme) lmp->citeme->add(paper);
}

PairGranCfpm::~PairGranCfpm() {
  disown_tallies();
  leave_budget();
  if (FixContactCounts::find(*modify)) modify->delete_fix(FixContactCounts::name);
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

/// Per-particle energy and virial belong to the host's style while it computes them.
void PairGranCfpm::disown_tallies() {
  if (!tallies_are_the_hosts_) return;
  eatom = nullptr;
  vatom = nullptr;
  tallies_are_the_hosts_ = false;
}

void PairGranCfpm::fail(const std::string &what) const {
  error->all(FLERR, std::string(law_->command()) + ": " + what);
  std::abort(); // not reached
}

void PairGranCfpm::settings(int narg, char **arg) {
  std::vector<std::string> words(arg, arg + narg);
  if (!model_.empty()) words.insert(words.begin(), model_);
  apply(words, model_.empty() ? Command::named : Command::suffixed);
}

void PairGranCfpm::apply(const std::vector<std::string> &words, Command made) {
  arguments_ = law_->read(*lmp, words, made);
  const std::vector<std::string> words_before = std::exchange(words_, words);
  if (!arguments_.method_given)
    words_.insert(words_.end(), {"predict", arguments_.automatic ? AutoMethod::name : arguments_.method->name});
  // given once more as it is, a command keeps what has been chosen for it
  if (!arguments_.automatic) auto_.reset();
  if (arguments_.automatic && (!auto_ || words_ != words_before))
    auto_.emplace(law_->kind_for_auto(), law_->damped_friction());
  if (auto_) arguments_.method = &auto_->method();
  use_method();
}

/// After each change of the arguments.
void PairGranCfpm::use_method() {
  disown_tallies();
  const int history_size = law_->history_size(method());
  const bool larger = history_size != law_->history_size(Verlet::method);
  const bool another = !host_style_ || host_style_name_ != law_->host_style(method()) ||
                       history_size_ != history_size ||
                       (law_->has_coefficients() && host_predicted_ != method().predicted);
  history_size_ = history_size;
  if (another) create_host_style();
  std::vector<std::string> words = law_->for_host_style();
  std::vector<char *> pointers = pointers_to(words);
  host_style_->settings(static_cast<int>(pointers.size()), pointers.data());
  if (another && larger && !law_->set_history_size(*host_style_, history_size_))
    fail("the contact history of the host's style is not where it is expected; this host was built with other headers");
  repeat_coefficients();
  take_over_columns();
  make_contacts();
  step_.dt = 0.0; // what is in f is of other settings
  leave_budget();
}

void PairGranCfpm::leave_budget() {
  if (step_.budget) step_.budget->forget();
  step_.budget = nullptr;
}

void PairGranCfpm::make_contacts() {
  contacts_kind_ = law_->kind();
  contacts_ = method().predicted ? law_->predicted_contacts(method()) : nullptr;
}

void PairGranCfpm::repeat_coefficients() {
  if (allocated)
    for (int i = 1; i <= atom->ntypes; ++i) std::fill_n(setflag[i] + 1, atom->ntypes, 0);
  for (Coefficients &given : coefficients_) {
    TypePairs in_force = given.pairs;
    give_coefficients(given);
    given.pairs = std::move(in_force);
  }
}

/// The contact history of the host's style is as large as the method wants it: a change begins it anew.
void PairGranCfpm::follow_auto() {
  if (arguments_.method == &auto_->method()) return;
  arguments_.method = &auto_->method();
  use_method();
}

/// What single() gives beside the force; newer hosts know how many there are in their init_style() only.
void PairGranCfpm::take_over_columns() {
  single_extra = host_style_->single_extra;
  svector = host_style_->svector;
}

void PairGranCfpm::create_host_style() {
  const std::string name = law_->host_style(method());
  const auto found = force->pair_map->find(name);
  if (found == force->pair_map->end()) fail("this LAMMPS lacks pair_style " + name + "; expected package GRANULAR");
  const auto with_history = fixes(*modify);
  host_style_.reset();
  const auto others = fixes(*modify);
  // the two are one style: contact history is stored under the number of the instance
  const int instances = instance_total;
  instance_total = instance_me + (history_size_ == law_->history_size(Verlet::method) ? 0 : number_of_larger);
  host_style_.reset(found->second(lmp));
  instance_total = instances;
  // What keeps contact history stays where it was. Behind a fix that adds particles it would find these where the
  // neighbours across borders stood, and lose their contacts.
  const auto place = std::mismatch(others.begin(), others.end(), with_history.begin()).first;
  move_fixes(*modify, *atom, static_cast<int>(others.size()), static_cast<int>(place - others.begin()));
  host_style_name_ = name;
  host_predicted_ = method().predicted;
}

/// The words are kept: where the pair style is given again, pairs of types that have coefficients keep them, as in the
/// host's styles, also where another one of the host's has to take them over; and a restart file holds them, for the
/// host's granular of 2021 does not find all of its own there.
void PairGranCfpm::coeff(int narg, char **arg) {
  const int size_before = law_->history_size(method());
  Coefficients given{{arg, arg + narg}, {}};
  give_coefficients(given);
  const auto is_given_anew = [&](const std::pair<int, int> &types) {
    return std::find(given.pairs.begin(), given.pairs.end(), types) != given.pairs.end();
  };
  bool too_large = false;
  for (Coefficients &earlier : coefficients_) {
    const auto kept = std::remove_if(earlier.pairs.begin(), earlier.pairs.end(), is_given_anew);
    too_large = too_large || (kept != earlier.pairs.end() && law_->enlarges_history(earlier.words));
    earlier.pairs.erase(kept, earlier.pairs.end());
  }
  coefficients_.erase(std::remove_if(coefficients_.begin(), coefficients_.end(),
                                     [](const Coefficients &earlier) { return earlier.pairs.empty(); }),
                      coefficients_.end());
  coefficients_.push_back(std::move(given));
  if (!method().predicted || (!too_large && law_->history_size(method()) == size_before)) return;
  // made anew: else the history that former words asked for would stay, or of some types none be asked for
  host_style_name_.clear();
  use_method();
}

/// To the host's style; which types it has taken them for is read off its flags.
void PairGranCfpm::give_coefficients(Coefficients &given) {
  const int types = atom->ntypes;
  if (!allocated) {
    memory->create(setflag, types + 1, types + 1, "pair:setflag");
    memory->create(cutsq, types + 1, types + 1, "pair:cutsq");
    for (int i = 0; i <= types; ++i) std::fill_n(setflag[i], types + 1, 0);
    allocated = 1;
  }
  if (host_style_->allocated)
    for (int i = 1; i <= types; ++i)
      for (int j = i; j <= types; ++j) host_style_->setflag[i][j] = 0;
  std::vector<std::string> words = law_->for_host_style(given.words, method());
  std::vector<char *> pointers = pointers_to(words);
  host_style_->coeff(static_cast<int>(pointers.size()), pointers.data());
  given.pairs.clear();
  for (int i = 1; i <= types; ++i)
    for (int j = i; j <= types; ++j) {
      if (host_style_->setflag[i][j]) given.pairs.emplace_back(i, j);
      setflag[i][j] = host_style_->setflag[i][j] = host_style_->setflag[i][j] || setflag[i][j];
    }
  beyond_contact = host_style_->beyond_contact;
  law_->take_coefficients(given.words, given.pairs);
}

void PairGranCfpm::init_style() {
  frozen_ = frozen_group(*modify);
  if (auto_) {
    auto_->choose(report_time_step(*lmp, *this).shortest(), update->dt);
    follow_auto();
  }
  const std::string wrong = law_->complete(atom->ntypes, method());
  if (!wrong.empty()) fail(wrong);
  if (law_->kind() != contacts_kind_) make_contacts();
  if (restored_.method && !law_->numbers_histories() && restored_.history_size != history_size_)
    fail(std::string("the contact history of 'predict ") + restored_.method->name +
         "' in the restart file has another size than that of 'predict " + method().name +
         "' with these pair_coeff; expected 'predict " + restored_.method->name +
         "' and what the file holds of pair_coeff up to a first 'run', which may be of 0 steps");
  restored_ = {};
  host_style_->init_style();
  take_over_columns();
  host_step_ = update->dt;
  host_style_->list = list; // of the run before: newer hosts hand over only lists that have changed
  if (hand_over_requests(*neighbor, host_style_.get(), this) != 1)
    fail("the neighbour list of the host's style is not where it is expected; this host was built with other headers");
  // not earlier: what a restart file holds for a fix is given to it in the first init
  const bool wanted = any_impulses(*lmp, *this);
  const bool there = FixContactCounts::find(*modify) != nullptr;
  if (there && !wanted) modify->delete_fix(FixContactCounts::name);
  if (wanted && !there) modify->add_fix(std::string(FixContactCounts::name) + " all " + FixContactCounts::name);
  step_.gives_impulses = step_.gives_impulses && wanted; // if not, nothing is counted from here on
  counts_ = wanted ? FixContactCounts::find(*modify) : nullptr;
  history_ = find_history(*modify, host_style_.get());
  const bool computed = law_->reason_for_host_style().empty() && law_->instant_history() > 0;
  const bool needed = method().predicted || computed;
  if (needed && !history_)
    fail("the contact history of the host's style is not where it is expected; this host was built with other headers");
}

void PairGranCfpm::init_list(int id, LAMMPS_NS::NeighList *new_list) {
  list = new_list;
  host_style_->init_list(id, new_list);
}

double PairGranCfpm::init_one(int i, int j) { return host_style_->init_one(i, j); }

void PairGranCfpm::setup() {
  // not in init_style(): commands such as balance initialise the host before the deck is complete
  require_companions(*lmp, *this);
  left_to_host_ = reason_for_host_style(*lmp);
  if (left_to_host_.empty()) left_to_host_ = law_->reason_for_host_style();
  step_.prepare(any_impulses(*lmp, *this), any_onset(*lmp, *this), arguments_.options.split);
  step_.budget = find_budget(*lmp);
  if (step_.budget) prepare_energies();
  if (contacts_) contacts_->prepare(inertia_dimension(*lmp), onset_of(method()));
  host_style_->setup();
}

void PairGranCfpm::begin_run(double contact_time) {
  const MethodAndStep now{&method(), update->dt};
  cfpm::begin_run(step_.crowd_step(), ran_, now, contact_time);
  ran_ = now;
}

void PairGranCfpm::reset_dt() {
  host_style_->reset_dt();
  host_step_ = update->dt;
}

/// Where a deck asks for a budget of energy.
void PairGranCfpm::prepare_energies() {
  std::string wrong = reason_against_energy(*lmp, *this);
  if (wrong.empty() && !law_->reason_against_energy(method()).empty())
    wrong = std::string(law_->command()) + ": " + law_->reason_against_energy(method());
  if (wrong.empty() && !method().predicted && !reason_for_host_style(*lmp).empty())
    wrong = std::string(law_->command()) + ": " + reason_for_host_style(*lmp);
  if (!wrong.empty()) error->all(FLERR, "fix nve/cfpm: 'energy yes' beside " + wrong);
  if (!contacts_) contacts_ = law_->predicted_contacts(method());
}

void PairGranCfpm::compute(int eflag, int vflag) {
  EnergyBudget *const budget = step_.budget.get();
  if (budget) {
    const Particles all = particles();
    budget->begin_evaluation(atom->nlocal, all.count);
    budget->before_contacts(all, all.receiving);
  }
  add_forces(eflag, vflag);
  if (budget) add_energies(*budget);
}

void PairGranCfpm::add_energies(EnergyBudget &budget) {
  const Particles all = particles();
  budget.after_contacts(all, all.receiving);
  if (list->inum > 0) contacts_->add_pair_energies(all, pair_list(), step_, budget);
  if (!force->newton_pair) return;
  given_back_ = &budget;
  reverse(*comm, this);
  given_back_ = nullptr;
}

void PairGranCfpm::add_forces(int eflag, int vflag) {
  // in its setup the host's style leaves springs as they are
  if (!method().predicted && (update->setupflag || !left_to_host_.empty()))
    return compute_with_host_style(eflag, vflag);
  if (!method().predicted) return compute_forces_of_instant(eflag, vflag);
  const Tally tally = begin_tally(eflag, vflag);
  step_.begin(update->dt, atom->nlocal, atom->v, atom->nlocal + atom->nghost);
  if (step_.gives_impulses) begin_impulses();
  if (list->inum > 0) contacts_->add_pair_forces(particles(), pairs_to_evaluate(), step_, !update->setupflag, tally);
  if (step_.gives_impulses) {
    step_.take_pair_forces(atom->f, atom->nlocal + atom->nghost);
    if (force->newton_pair) reverse(*comm, this);
  }
}

void PairGranCfpm::compute_forces_of_instant(int eflag, int vflag) {
  const Tally tally = begin_tally(eflag, vflag);
  if (list->inum > 0) law_->add_instant_forces(particles(), pairs_to_evaluate(), host_step_, tally);
}

/// Begins an evaluation whose forces are tallied here. Empty where nobody asks for them.
Tally PairGranCfpm::begin_tally(int eflag, int vflag) {
  disown_tallies();
  ev_init(eflag, vflag);
  if (!evflag) return {};
  return [this](int i, int j, const Vec3 &f, const Vec3 &separation) {
    ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, 0.0, 0.0, f.x, f.y, f.z, separation.x, separation.y,
                 separation.z);
  };
}

void PairGranCfpm::begin_impulses() {
  // asked for in each step: the deck may have taken it away before a "run" without setup
  counts_ = FixContactCounts::find(*modify);
  if (!counts_) fail(std::string("fix ") + FixContactCounts::name + " is gone; expected a 'run' that does its setup");
  step_.begin_impulses(atom->nlocal + atom->nghost, counts_->now(), counts_->before(), update->setupflag != 0,
                       [this] { forward(*comm, this); });
}

/// How many contacts they had in the step before, to neighbours on other ranks.
int PairGranCfpm::pack_forward_comm(int count, int *particles, double *buffer, int, int *) {
  for (int k = 0; k < count; ++k) buffer[k] = counts_->before()[particles[k]];
  return count;
}

void PairGranCfpm::unpack_forward_comm(int count, int first, double *buffer) {
  std::copy_n(buffer, count, counts_->before() + first);
}

/// What contacts did to neighbours on other ranks, back to these.
int PairGranCfpm::pack_reverse_comm(int count, int first, double *buffer) {
  double *next = buffer;
  for (int i = first; i < first + count; ++i) {
    if (given_back_) {
      next = std::copy_n(given_back_->row(i), EnergyBudget::values_per_particle, next);
      continue;
    }
    next = std::copy_n(step_.shift[i], 3, next);
    next = std::copy_n(step_.contact_force[i], 3, next);
    *next++ = step_.contact_counts[i];
  }
  return static_cast<int>(next - buffer);
}

void PairGranCfpm::unpack_reverse_comm(int count, int *particles, double *buffer) {
  if (given_back_) {
    for (int k = 0; k < count; ++k) {
      double *const row = given_back_->row(particles[k]);
      for (std::size_t value = 0; value < EnergyBudget::values_per_particle; ++value) row[value] += *buffer++;
    }
    return;
  }
  for (int k = 0; k < count; ++k, buffer += 7) {
    add(vec3(buffer), step_.shift[particles[k]]);
    add(vec3(buffer + 3), step_.contact_force[particles[k]]);
    step_.contact_counts[particles[k]] += buffer[6];
  }
}

void PairGranCfpm::compute_with_host_style(int eflag, int vflag) {
  near_.forget();
  host_style_->compute(eflag, vflag);
  evflag = host_style_->evflag;
  eng_vdwl = host_style_->eng_vdwl;
  eng_coul = host_style_->eng_coul;
  std::copy_n(host_style_->virial, 6, virial);
  eatom = host_style_->eatom;
  vatom = host_style_->vatom;
  tallies_are_the_hosts_ = true;
}

Particles PairGranCfpm::particles() const { return particles_of(*atom, frozen_, force->newton_pair != 0); }

PairList PairGranCfpm::pair_list() const {
  PairList pairs = pair_list_of(*list, NEIGHMASK);
  if (!history_) return pairs;
  pairs.flags = history_->flags;
  pairs.history = history_->values;
  const bool predicted = method().predicted;
  pairs.history_size = predicted ? law_->host_history_size(method(), atom->ntypes) : law_->instant_history();
  pairs.spring_offset = law_->law_history();
  pairs.spring_values = (predicted ? history_size_ : pairs.history_size) - pairs.spring_offset;
  pairs.spring_now_offset = method().wants_crowd ? pairs.spring_offset + 3 : -1;
  pairs.places = law_->instant_places();
  pairs.touching = 1;
  return pairs;
}

/// For the loop over all of them, once in an evaluation.
PairList PairGranCfpm::pairs_to_evaluate() {
  if (neighbor->ago == 0) near_.forget(); // the host has listed its pairs anew
  PairList pairs = pair_list();
  pairs.near = &near_;
  return pairs;
}

double PairGranCfpm::single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                            double &fforce) {
  const double energy = host_style_->single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  const double reach = atom->radius[i] + atom->radius[j];
  if (!method().predicted || rsq >= reach * reach) return energy;

  // what acts over the step in place of the host's force of one instant; its velocities stay
  const Particles all = particles();
  const PairList pairs = pair_list();
  const Vec3 separation = vec3(all.x[i]) - vec3(all.x[j]);
  const double distance = std::sqrt(dot(separation, separation));
  const int *const neighbors = pairs.neighbors[i];
  const int *const end = neighbors + pairs.neighbor_count[i];
  const int *const found = std::find_if(neighbors, end, [&](int k) { return (k & pairs.index_mask) == j; });
  if (found == end) // on this rank alone
    error->one(FLERR, std::string("pair_style gran/cfpm: the force of a pair that is not in its neighbour list"));
  const int jj = static_cast<int>(found - neighbors);
  const Crowd crowd = method().wants_crowd ? step_.crowd : Crowd{};
  const Contact contact{
      touching_spheres(separation, distance, all.radius[i], all.radius[j], all.motion(i), all.motion(j)),
      step_.dt,
      all.others(i, crowd) + all.others(j, crowd),
      {pairs.spring(i, jj), step_.dt, false, pairs.spring_now(i, jj)}};
  const ContactAction action = contacts_->action_of(partners(all.body(i, crowd), all.body(j, crowd)), contact, step_);
  fforce = action.normal_force / distance;
  const Vec3 tangential = action.mean.force - action.normal_force * contact.geometry.normal;
  set(tangential, svector);
  svector[3] = norm(tangential);
  if (history_size_ == WiderHistory::size) {
    // of a force at the reduced radius that the couple is taken for, and about the normal
    const Vec3 &n = contact.geometry.normal;
    const Vec3 couple = contacts_->couple_of(all, i, j, contact, action.mean.force, step_);
    const Vec3 rolling = (1.0 / all.radius[i] + 1.0 / all.radius[j]) * cross(tangential_part(couple, n), n);
    set(rolling, svector + 4);
    svector[7] = norm(rolling);
    svector[8] = dot(couple, n);
  }
  return energy;
}

void PairGranCfpm::write_restart(FILE *file) {
  write_command(with_step(words_, ran_.dt), file);
  if (auto_) write_command(auto_->words(), file);
  write_command({std::to_string(coefficients_.size())}, file);
  for (const Coefficients &given : coefficients_) write_command(given.words, file);
}

void PairGranCfpm::read_restart(FILE *file) {
  const auto next_command = [&] {
    return read_command(comm->me == 0 ? file : nullptr,
                        [this](void *data, int bytes) { MPI_Bcast(data, bytes, MPI_BYTE, 0, world); });
  };
  std::vector<std::string> words = next_command();
  const double dt = take_step(words);
  if (words.empty()) fail("the restart file does not hold the settings of this style");
  apply(words, Command::named);
  if (auto_) {
    auto_->restore(next_command());
    follow_auto();
  }
  if (dt > 0.0) ran_ = {&method(), dt};
  const std::vector<std::string> count = next_command();
  const std::optional<double> given = count.size() == 1 ? finite_number(count[0]) : std::nullopt;
  constexpr const char *without =
      "the restart file does not hold every pair_coeff of this style; expected one that this "
      "version of the plugin has written";
  if (!given) fail(without);
  for (int k = 0; k < *given; ++k) {
    std::vector<std::string> coefficients = next_command();
    if (coefficients.size() < 2) fail(without);
    std::vector<char *> pointers = pointers_to(coefficients);
    coeff(static_cast<int>(pointers.size()), pointers.data());
  }
  restored_ = {&method(), law_->history_size(method())};
}

} // namespace cfpm::lammps
