// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_gran_cfpm.h"

#include "companions.h"
#include "pair_gran_cfpm.h"

#include "core/step/touch.h"

#include <algorithm>
#include <utility>

namespace cfpm::lammps {

namespace {

std::string name_of(char **arg) { return std::string("fix wall/gran/cfpm (id ") + arg[0] + ")"; }

/// The contact and what follows it, also where the command is the host's.
std::vector<std::string> words_of(LAMMPS_NS::LAMMPS &lmp, int narg, char **arg) {
  std::vector<std::string> words(arg + 3, arg + narg);
  if (std::string(arg[2]) == "wall/gran/cfpm") return words;
  const std::string contact = words.empty() ? "" : words[0];
  if (contact != "hooke/history" && contact != "hertz/history")
    lmp.error->all(FLERR, name_of(arg) + ": fix " + arg[2] + " with '" + contact +
                              "' cannot be predicted; expected hooke/history or hertz/history");
  words[0].resize(contact.find('/'));
  return words;
}

LAMMPS_NS::Fix *create_host_wall(LAMMPS_NS::LAMMPS *lmp, char **arg, const ContactArguments &contact) {
  const bool region = !contact.rest.empty() && contact.rest[0] == "region";
  std::vector<std::string> words = {arg[0], arg[1], region ? "wall/gran/region" : "wall/gran",
                                    contact.hertz ? "hertz/history" : "hooke/history"};
  words.insert(words.end(), contact.for_host_style.begin(), contact.for_host_style.end());
  words.insert(words.end(), contact.rest.begin(), contact.rest.end());
  std::vector<char *> pointers;
  pointers.reserve(words.size());
  for (std::string &word : words) pointers.push_back(word.data());
  return lmp->modify->fix_map->at(words[2])(lmp, static_cast<int>(pointers.size()), pointers.data());
}

} // namespace

LAMMPS_NS::Fix *create_wall(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  const ContactArguments contact =
      read_contact_arguments(*lmp, name_of(arg), ContactOwner::wall, words_of(*lmp, narg, arg));
  const PairGranCfpm *pair = find_pair(*lmp);
  const bool predicted = contact.method_given ? contact.method->predicted : !pair || pair->method().predicted;
  if (!predicted) return create_host_wall(lmp, arg, contact);
  return new FixWallGranCfpm(lmp, narg, arg, contact);
}

FixWallGranCfpm::FixWallGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg, ContactArguments contact)
    : Fix(lmp, narg, arg), command_(name_of(arg)), arguments_(std::move(contact)),
      surface_(make_wall_surface(*lmp, command_, arguments_.rest)), start_(update->ntimestep) {
  require_spheres(*lmp, command_);
  create_attribute = 1;
  restart_peratom = 1;
  // what a restart file holds is taken up right behind the constructor; there, the pair style is known
  const PairGranCfpm *pair = find_pair(*lmp);
  make_history(pair && pair->method().predicted ? method_beside(*pair) : *arguments_.method);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
  atom->add_callback(LAMMPS_NS::Atom::RESTART);
}

void FixWallGranCfpm::make_history(const Method &method) {
  history_ = std::make_unique<WallHistory>(surface_->most_touches(), arguments_.history_size(method));
  maxexchange = static_cast<int>(history_->values_per_particle());
  history_->grow(atom->nmax);
}

FixWallGranCfpm::~FixWallGranCfpm() {
  atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
  atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

int FixWallGranCfpm::setmask() { return LAMMPS_NS::FixConst::POST_FORCE; }

void FixWallGranCfpm::init() {
  surface_->init();
  const PairGranCfpm *pair = find_pair(*lmp);
  // told in setup(): commands such as balance come before the deck is complete
  if (!pair || !pair->method().predicted) return;
  const Method &method = method_beside(*pair);
  if (history_->values_per_contact() != arguments_.history_size(method)) make_history(method);
}

const Method &FixWallGranCfpm::method_beside(const PairGranCfpm &pair) const {
  return arguments_.method_given ? *arguments_.method : method_at_wall(pair.method(), arguments_.law());
}

void FixWallGranCfpm::setup(int vflag) {
  const Method &method = method_beside(require_predicted_pair(*lmp, command_));
  if (!contacts_ || &method != arguments_.method) {
    arguments_.method = &method;
    contacts_ = make_predicted_contacts(arguments_);
  }
  contacts_->prepare(inertia_dimension(*lmp));
  post_force(vflag);
}

void FixWallGranCfpm::post_force(int) {
  if (!contacts_)
    error->all(FLERR, command_ + ": given again after the last setup; expected a 'run' that does its setup");
  PairGranCfpm &pair = require_predicted_pair(*lmp, command_);
  const Particles particles = pair.particles();
  StepState &step = pair.step();
  surface_->move_to(static_cast<double>(update->ntimestep - start_) * update->dt);
  touching_.clear();
  for (int i = 0; i < atom->nlocal; ++i)
    if (atom->mask[i] & groupbit) find_contacts(i, particles, step);
  contacts_->add_wall_forces(touching_, particles, step, !update->setupflag);
}

void FixWallGranCfpm::find_contacts(int i, const Particles &particles, const StepState &step) {
  const Method &method = *arguments_.method;
  const double radius = particles.radius[i];
  const Motion motion = particles.motion(i);
  const bool onset = method.wants_onset && step.onset;
  const double ahead = onset ? step.dt * bound_of_norm(motion.velocity) + surface_->reach(step.dt, radius) : 0.0;
  const Crowd crowd = method.wants_crowd ? step.crowd : Crowd{};
  const ContactPartners partners = at_wall(particles.type[i], radius, crowd.share(i, particles.mass[i]));
  const double others = particles.others(i, crowd);
  const std::size_t first = touching_.size();
  surfaces_.clear();
  for (const WallTouch &near : surface_->touches(atom->x[i], radius + ahead)) {
    const auto touch = touch_wall(near.normal, near.distance, radius, motion, near.velocity, step.dt);
    if (!touch) continue;
    surfaces_.push_back(near.surface);
    touching_.push_back({i, partners, {touch->geometry, touch->span, others, {}}});
  }
  history_->keep_only(i, surfaces_);
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    double *const values = history_->contact(i, surfaces_[k]);
    if (!values) error->one(FLERR, command_ + ": a particle touches more surfaces than the region allows");
    StoredSpring &spring = touching_[first + k].contact.spring;
    spring.values = values + arguments_.law_history();
    if (method.wants_crowd) spring.now = spring.values + 3;
  }
}

double FixWallGranCfpm::memory_usage() {
  return static_cast<double>(static_cast<std::size_t>(atom->nmax) * history_->values_per_particle() * sizeof(double));
}

void FixWallGranCfpm::grow_arrays(int particles) { history_->grow(particles); }
void FixWallGranCfpm::copy_arrays(int from, int to, int) { history_->copy(from, to); }
void FixWallGranCfpm::set_arrays(int i) { history_->clear(i); }

int FixWallGranCfpm::pack_exchange(int i, double *buffer) {
  std::copy_n(history_->of(i), history_->values_per_particle(), buffer);
  return maxexchange;
}

int FixWallGranCfpm::unpack_exchange(int i, double *buffer) {
  std::copy_n(buffer, history_->values_per_particle(), history_->of(i));
  return maxexchange;
}

int FixWallGranCfpm::pack_restart(int i, double *buffer) {
  buffer[0] = size_restart(i);
  return 1 + pack_exchange(i, buffer + 1);
}

void FixWallGranCfpm::unpack_restart(int i, int nth) {
  const double *extra = atom->extra[i];
  for (int k = 0; k < nth; ++k) extra += static_cast<int>(extra[0]);
  if (static_cast<int>(extra[0]) == size_restart(i))
    std::copy_n(extra + 1, history_->values_per_particle(), history_->of(i));
  else
    history_->clear(i); // of a wall with another number of surfaces
}

int FixWallGranCfpm::size_restart(int) { return 1 + maxexchange; }
int FixWallGranCfpm::maxsize_restart() { return 1 + maxexchange; }

} // namespace cfpm::lammps
