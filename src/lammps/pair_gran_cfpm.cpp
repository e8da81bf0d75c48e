// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_gran_cfpm.h"

#include "companions.h"
#include "contact_counts.h"
#include "host_versions.h"

#include "citeme.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace cfpm::lammps {

namespace {

constexpr int longest_command = 1 << 16; // in a restart file; anything else is not of this style

constexpr int spring_size = 3;
/// Contact histories of another size get another number, so that none is taken for one of this size in a restart file.
constexpr int number_of_impulses = 1000000;

constexpr const char *paper = R"(pair_style gran/cfpm command:

@Article{Tokoro2005,
 author =  {C. Tokoro and K. Okaya and J. Sadaki},
 title =   {A Fast Algorithm for the Discrete Element Method by Contact Force Prediction},
 journal = {KONA Powder and Particle Journal},
 year =    2005,
 volume =  23
}

)";

/// The group bit of fix freeze, or 0.
int frozen_group(LAMMPS_NS::Modify &modify) {
  for (const LAMMPS_NS::Fix *fix : fixes(modify))
    if (std::string(fix->style).rfind("freeze", 0) == 0) return fix->groupbit;
  return 0;
}

} // namespace

PairGranCfpm::PairGranCfpm(LAMMPS_NS::LAMMPS *lmp, std::string law) : PairAroundHostStyle(lmp), law_(std::move(law)) {
  // what the host's granular styles say of themselves
  single_enable = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = LAMMPS_NS::CENTROID_NOTAVAIL;
  finitecutflag = 1;
  comm_forward = 1;
  comm_reverse = 4;
  if (lmp->citeme) lmp->citeme->add(paper);
}

PairGranCfpm::~PairGranCfpm() {
  disown_tallies();
  if (ContactCounts::find(*modify)) modify->delete_fix(ContactCounts::name);
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
  error->all(FLERR, "pair_style gran/cfpm: " + what);
  std::abort(); // not reached
}

void PairGranCfpm::settings(int narg, char **arg) {
  std::vector<std::string> words(arg, arg + narg);
  if (!law_.empty()) words.insert(words.begin(), law_);
  apply(words);
}

void PairGranCfpm::apply(const std::vector<std::string> &words) {
  arguments_ = read_contact_arguments(*lmp, "pair_style gran/cfpm", ContactOwner::pairs, words);
  if (!arguments_.rest.empty())
    fail("unknown argument '" + arguments_.rest[0] +
         "'; expected hooke|hertz Kn Kt gamma_n gamma_t xmu dampflag [limit_damping] [predict ... [split c] [onset "
         "on|off]]");
  command_line_.clear();
  for (const std::string &word : words) command_line_ += word + '\0';

  disown_tallies();
  const int history_size = has_impulses() ? 2 * spring_size : spring_size;
  const bool another = !host_style_ || host_style_name_ != arguments_.host_style() || history_size_ != history_size;
  history_size_ = history_size;
  if (another) create_host_style();
  std::vector<char *> for_host_style;
  for (std::string &word : arguments_.for_host_style) for_host_style.push_back(word.data());
  host_style_->settings(static_cast<int>(for_host_style.size()), for_host_style.data());
  if (another && has_impulses() && !set_history_size(*host_style_, arguments_, history_size_))
    fail("the contact history of the host's style is not where it is expected; this host was built with other headers");
  if (another) repeat_coefficients();
  single_extra = host_style_->single_extra;
  svector = host_style_->svector;
  contacts_ = predictor() ? make_predicted_contacts(arguments_) : nullptr;
  predicted_step_ = 0.0; // what is in f is of other settings
}

void PairGranCfpm::create_host_style() {
  const auto found = force->pair_map->find(arguments_.host_style());
  if (found == force->pair_map->end())
    fail(std::string("this LAMMPS lacks pair_style ") + arguments_.host_style() + "; expected package GRANULAR");
  host_style_.reset();
  // the two are one style: contact history is stored under the number of the instance
  const int instances = instance_total;
  instance_total = instance_me + (has_impulses() ? number_of_impulses : 0);
  host_style_.reset(found->second(lmp));
  instance_total = instances;
  host_style_name_ = arguments_.host_style();
}

void PairGranCfpm::coeff(int narg, char **arg) {
  host_style_->coeff(narg, arg);
  const int types = atom->ntypes;
  if (!allocated) {
    memory->create(setflag, types + 1, types + 1, "pair:setflag");
    memory->create(cutsq, types + 1, types + 1, "pair:cutsq");
    allocated = 1;
  }
  for (int i = 1; i <= types; ++i)
    for (int j = i; j <= types; ++j) setflag[i][j] = host_style_->setflag[i][j];
}

/// Where the pair style is given again with another law or method, pairs of types that have coefficients keep them, as
/// in the host's styles: of the new style of the host they are the same, for they hold no values.
void PairGranCfpm::repeat_coefficients() {
  if (!allocated) return;
  for (int i = 1; i <= atom->ntypes; ++i)
    for (int j = i; j <= atom->ntypes; ++j) {
      if (!setflag[i][j]) continue;
      std::string first = std::to_string(i);
      std::string second = std::to_string(j);
      char *types[] = {first.data(), second.data()};
      host_style_->coeff(2, types);
    }
}

void PairGranCfpm::init_style() {
  frozen_ = frozen_group(*modify);
  host_style_->init_style();
  host_style_->list = list; // of the run before: newer hosts hand over only lists that have changed
  if (hand_over_requests(*neighbor, host_style_.get(), this) != 1)
    fail("the neighbour list of the host's style is not where it is expected; this host was built with other headers");
  // not earlier: what a restart file holds for a fix is given to it in the first init
  const bool wanted = any_impulses(*lmp, *this);
  const bool there = ContactCounts::find(*modify) != nullptr;
  if (there && !wanted) modify->delete_fix(ContactCounts::name);
  if (wanted && !there) modify->add_fix(std::string(ContactCounts::name) + " all " + ContactCounts::name);
  gives_impulses_ = gives_impulses_ && wanted; // if not, nothing is counted from here on
  counts_ = wanted ? ContactCounts::find(*modify) : nullptr;
  history_ = find_history(*modify, host_style_.get());
  if (!history_)
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
  gives_impulses_ = any_impulses(*lmp, *this);
  shared_step_ = {};
  shared_step_.onset = arguments_.impulse_options.onset;
  if (contacts_) contacts_->prepare(inertia_dimension(*lmp));
  host_style_->setup();
}

void PairGranCfpm::reset_dt() { host_style_->reset_dt(); }

void PairGranCfpm::compute(int eflag, int vflag) {
  if (!predictor()) return compute_with_host_style(eflag, vflag);
  disown_tallies();
  ev_init(eflag, vflag);
  shared_step_.particles = atom->nlocal;
  Tally tally;
  if (evflag)
    tally = [this](int i, int j, const Vec3 &f, const Vec3 &separation) {
      ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, 0.0, 0.0, f.x, f.y, f.z, separation.x, separation.y,
                   separation.z);
    };
  if (gives_impulses_) begin_shared_step();
  if (list->inum > 0) contacts_->add_pair_forces(listed_pairs(), update->dt, !update->setupflag, tally);
  if (gives_impulses_ && force->newton_pair) reverse(*comm, this);
  predicted_step_ = update->dt;
}

/// What pairs and then walls add to. The other contacts of a particle are those of the step before: walls count after
/// the pairs have been evaluated.
void PairGranCfpm::begin_shared_step() {
  const auto count = static_cast<std::size_t>(atom->nlocal) + static_cast<std::size_t>(atom->nghost);
  shift_.assign(3 * count, 0.0);
  shared_step_.shift = VectorRows(shift_.data());
  // asked for in each step: the deck may have taken it away before a "run" without setup
  counts_ = ContactCounts::find(*modify);
  if (!counts_) fail(std::string("fix ") + ContactCounts::name + " is gone; expected a 'run' that does its setup");
  if (shared_step_.onset) shared_step_.ahead = largest_approach(atom->v, atom->nlocal + atom->nghost, update->dt);
  shared_step_.contacts = counts_->now();
  if (!update->setupflag) std::copy_n(counts_->now(), atom->nlocal, counts_->before()); // else the same step again
  forward(*comm, this);
  std::fill_n(shared_step_.contacts, count, 0.0);
  shared_step_.crowd = {counts_->before(), arguments_.impulse_options.split};
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
    next = std::copy_n(shared_step_.shift[i], 3, next);
    *next++ = shared_step_.contacts[i];
  }
  return static_cast<int>(next - buffer);
}

void PairGranCfpm::unpack_reverse_comm(int count, int *particles, double *buffer) {
  for (int k = 0; k < count; ++k, buffer += 4) {
    add(vec3(buffer), shared_step_.shift[particles[k]]);
    shared_step_.contacts[particles[k]] += buffer[3];
  }
}

void PairGranCfpm::compute_with_host_style(int eflag, int vflag) {
  host_style_->compute(eflag, vflag);
  evflag = host_style_->evflag;
  eng_vdwl = host_style_->eng_vdwl;
  eng_coul = host_style_->eng_coul;
  std::copy_n(host_style_->virial, 6, virial);
  eatom = host_style_->eatom;
  vatom = host_style_->vatom;
  tallies_are_the_hosts_ = true;
}

ListedPairs PairGranCfpm::listed_pairs() const {
  ListedPairs pairs;
  pairs.x = VectorRows(atom->x);
  pairs.v = VectorRows(atom->v);
  pairs.omega = VectorRows(atom->omega);
  pairs.f = VectorRows(atom->f);
  pairs.torque = VectorRows(atom->torque);
  pairs.shift = shared_step_.shift;
  pairs.radius = atom->radius;
  pairs.mass = atom->rmass;
  if (has_impulses()) pairs.crowd = shared_step_.crowd;
  pairs.contacts = shared_step_.contacts;
  pairs.ahead = shared_step_.ahead;
  pairs.type = atom->type;
  pairs.group = atom->mask;
  pairs.frozen = frozen_;
  pairs.receiving = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
  pairs.count = list->inum;
  pairs.first = list->ilist;
  pairs.neighbor_count = list->numneigh;
  pairs.neighbors = list->firstneigh;
  pairs.index_mask = NEIGHMASK;
  pairs.flags = history_->flags;
  pairs.history = history_->values;
  pairs.history_size = history_size_;
  pairs.spring_offset = 0;
  pairs.spring_now_offset = has_impulses() ? spring_size : -1;
  pairs.touching = 1;
  return pairs;
}

double PairGranCfpm::single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                            double &fforce) {
  const double energy = host_style_->single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce);
  const double reach = atom->radius[i] + atom->radius[j];
  if (!predictor() || rsq >= reach * reach) return energy;

  // what acts over the step in place of the host's force of one instant; its velocities stay
  const ListedPairs pairs = listed_pairs();
  const Vec3 separation = vec3(pairs.x[i]) - vec3(pairs.x[j]);
  const double distance = std::sqrt(dot(separation, separation));
  const auto motion = [&pairs](int k) { return Motion{vec3(pairs.v[k]), vec3(pairs.omega[k])}; };
  const ContactGeometry geometry =
      touching_spheres(separation, distance, pairs.radius[i], pairs.radius[j], motion(i), motion(j));
  const int *const neighbors = pairs.neighbors[i];
  const int *const end = neighbors + pairs.neighbor_count[i];
  const int *const found = std::find_if(neighbors, end, [&](int k) { return (k & pairs.index_mask) == j; });
  if (found == end) // on this rank alone
    error->one(FLERR, std::string("pair_style gran/cfpm: the force of a pair that is not in its neighbour list"));
  const int jj = static_cast<int>(found - neighbors);
  const ContactForce force =
      contacts_->force_of(partners(pairs.body(i), pairs.body(j)), geometry, pairs.spring(i, jj),
                          pairs.spring_now(i, jj), pairs.others(i) + pairs.others(j), predicted_step_);
  fforce = force.normal / distance;
  set(force.tangential, svector);
  svector[3] = norm(force.tangential);
  return energy;
}

void PairGranCfpm::write_restart(FILE *file) {
  const int length = static_cast<int>(command_line_.size());
  std::fwrite(&length, sizeof length, 1, file);
  std::fwrite(command_line_.data(), 1, command_line_.size(), file);
  host_style_->write_restart(file);
}

void PairGranCfpm::read_restart(FILE *file) {
  int length = 0;
  std::string text;
  if (comm->me == 0) {
    bool readable = std::fread(&length, sizeof length, 1, file) == 1 && length > 0 && length < longest_command;
    text.resize(readable ? static_cast<std::size_t>(length) : 0);
    readable = readable && std::fread(text.data(), 1, text.size(), file) == text.size() && text.back() == '\0';
    if (!readable) length = 0;
  }
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  if (length == 0) fail("the restart file does not hold the settings of this style");
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, world);
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size(); at += words.back().size() + 1) words.emplace_back(&text[at]);
  apply(words);
  host_style_->read_restart(file);
  char all[] = "*";
  char *every_pair[] = {all, all};
  coeff(2, every_pair);
}

} // namespace cfpm::lammps
