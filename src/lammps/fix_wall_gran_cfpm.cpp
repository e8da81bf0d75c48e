// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_gran_cfpm.h"

#include "companions.h"
#include "gran_wall_law.h"
#include "granular_wall_law.h"
#include "pair_gran_cfpm.h"

#include "core/step/touch.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace cfpm::lammps {

namespace {

constexpr int most_groups = 32; // that the host can have

std::string name_of(char **arg) { return std::string("fix wall/gran/cfpm (id ") + arg[0] + ")"; }

/// What a contact of the host's walls is called here; empty if there is none.
std::string our_name(const std::string &of_host) {
  if (of_host == "hooke") return "hooke/nohistory";
  if (of_host == "hooke/history") return "hooke";
  return of_host == "hertz/history" ? "hertz" : "";
}

/// The words behind the style but for those that are not of the contact. That of the host has its contact hooke,
/// hooke/history, hertz/history or granular.
WallArguments read_law(LAMMPS_NS::LAMMPS &lmp, int narg, char **arg) {
  std::vector<std::string> words(arg + 3, arg + narg);
  const std::string contact = words.empty() ? "" : words[0];
  if (contact == "granular") return read_granular_wall(lmp, name_of(arg), std::move(words));
  if (std::string(arg[2]) != "wall/gran/cfpm") {
    const std::string ours = our_name(contact);
    if (ours.empty())
      lmp.error->all(FLERR, name_of(arg) + ": fix " + arg[2] + " with '" + contact +
                                "' cannot be predicted; expected hooke, hooke/history, hertz/history or granular");
    words[0] = ours;
  }
  return read_gran_wall(lmp, name_of(arg), words);
}

/// "contacts", and "temperature" with a value, stand behind the wall and its place, which may be a region of that name.
WallArguments read(LAMMPS_NS::LAMMPS &lmp, int narg, char **arg) {
  WallArguments wall = read_law(lmp, narg, arg);
  if (wall.shape.size() < 3) return wall;
  const auto take = [&shape = wall.shape](const char *keyword, std::ptrdiff_t count) {
    const auto found = std::find(shape.begin() + 2, shape.end(), keyword);
    const auto end = shape.end() - found < count ? shape.end() : found + count;
    std::vector<std::string> taken(found, end);
    shape.erase(found, end);
    return taken;
  };
  wall.tells_contacts = !take("contacts", 1).empty();
  if (walls_conduct_heat) wall.heat = take("temperature", 2);
  return wall;
}

bool is_region(const WallArguments &wall) { return !wall.shape.empty() && wall.shape[0] == "region"; }

std::unique_ptr<LAMMPS_NS::Fix> create_host_wall(LAMMPS_NS::LAMMPS *lmp, char **arg, const WallArguments &wall) {
  std::vector<std::string> words = {arg[0], arg[1], is_region(wall) ? "wall/gran/region" : "wall/gran"};
  const std::vector<std::string> law = wall.law->for_host_wall();
  words.insert(words.end(), law.begin(), law.end());
  words.insert(words.end(), wall.shape.begin(), wall.shape.end());
  words.insert(words.end(), wall.heat.begin(), wall.heat.end());
  if (wall.tells_contacts) words.emplace_back("contacts");
  std::vector<char *> pointers;
  pointers.reserve(words.size());
  for (std::string &word : words) pointers.push_back(word.data());
  return std::unique_ptr<LAMMPS_NS::Fix>(
      lmp->modify->fix_map->at(words[2])(lmp, static_cast<int>(pointers.size()), pointers.data()));
}

/// A bit of masks that no group has, so that no particle does; 0 if all are taken.
int free_group_bit(const LAMMPS_NS::Group &group) {
  for (int k = 0; k < most_groups; ++k)
    if (!group.names[k]) return group.bitmask[k];
  return 0;
}

/// Sub-models that act on particles beyond their radius.
bool acts_from_afar(const WallLaw &law) {
  const std::vector<std::string> words = law.for_host_wall();
  return std::find(words.begin(), words.end(), "jkr") != words.end();
}

} // namespace

LAMMPS_NS::Fix *create_wall(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) {
  WallArguments wall = read(*lmp, narg, arg);
  const PairGranCfpm *pair = find_pair(*lmp);
  const bool predicted = wall.method_given ? wall.method->predicted : !pair || pair->may_predict();
  if (!predicted && wall.method_given && !is_region(wall)) return create_host_wall(lmp, arg, wall).release();
  std::unique_ptr<LAMMPS_NS::Fix> host_wall;
  const bool may_let_host_act = !predicted || (!wall.method_given && (!pair || pair->automatic()));
  if (may_let_host_act || wall.law->is_checked_by_host() || wall.tells_contacts || !wall.heat.empty()) {
    const int entries = lmp->atom->nextra_grow;
    host_wall = create_host_wall(lmp, arg, wall);
    if (lmp->atom->nextra_grow != entries + 1)
      lmp->error->all(FLERR, name_of(arg) + ": the host's wall does not keep its history as expected; this host was "
                                            "built with other headers");
  }
  return new FixWallGranCfpm(lmp, narg, arg, std::move(wall), std::move(host_wall));
}

FixWallGranCfpm::FixWallGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg, WallArguments wall,
                                 std::unique_ptr<LAMMPS_NS::Fix> host_wall)
    : Fix(lmp, narg, arg), command_(name_of(arg)), arguments_(std::move(wall)), host_wall_(std::move(host_wall)),
      spares_host_(is_region(arguments_) && !acts_from_afar(law())),
      surface_(make_wall_surface(*lmp, command_, arguments_.shape)), law_history_(law().law_history()),
      start_(update->ntimestep) {
  require_spheres(*lmp, command_);
  create_attribute = 1;
  restart_peratom = 1;
  // what a restart file holds is taken up right behind the constructor; there, the pair style is known
  const PairGranCfpm *pair = find_pair(*lmp);
  make_history(pair && pair->method().predicted ? method_beside(*pair) : *arguments_.method);
  follow(pair);
  if (host_wall_) { // has entered the fix that is being made, this one, in the host's lists of those to call
    restart_global = host_wall_->restart_global;
    peratom_flag = host_wall_->peratom_flag;
    size_peratom_cols = host_wall_->size_peratom_cols;
    peratom_freq = host_wall_->peratom_freq;
    array_atom = host_wall_->array_atom;
    return;
  }
  atom->add_callback(LAMMPS_NS::Atom::GROW);
  atom->add_callback(LAMMPS_NS::Atom::RESTART);
}

void FixWallGranCfpm::make_history(const Method &method) {
  history_ = std::make_unique<WallHistory>(surface_->most_touches(), law().history_size(method));
  maxexchange = 1 + std::max(own_exchange(), host_wall_ ? host_wall_->maxexchange : 0);
  history_->grow(atom->nmax);
  clear_places_.resize(atom->nmax);
  clear_places_.forget_all();
}

/// The one of the two walls that acts, and whose history goes along with particles, changes between runs only.
void FixWallGranCfpm::follow(const PairGranCfpm *pair) {
  const bool host_acted = std::exchange(host_acts_, host_wall_ && pair && !pair->method().predicted);
  if (host_acts_ && !host_acted)
    for (int i = 0; i < atom->nlocal; ++i) host_wall_->set_arrays(i);
  if (host_acted && !host_acts_) make_history(method_beside(*pair));
}

FixWallGranCfpm::~FixWallGranCfpm() {
  if (host_wall_) return; // takes it out of the lists
  atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
  atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

int FixWallGranCfpm::setmask() { return LAMMPS_NS::FixConst::POST_FORCE; }

void FixWallGranCfpm::init() {
  surface_->init();
  const PairGranCfpm *pair = find_pair(*lmp);
  if (host_wall_) host_wall_->init();
  follow(pair);
  // told in setup(): commands such as balance come before the deck is complete
  if (!pair || !pair->method().predicted) return;
  const Method &method = method_beside(*pair);
  if (history_->values_per_contact() != law().history_size(method)) make_history(method);
}

const Method &FixWallGranCfpm::method_beside(const PairGranCfpm &pair) const {
  return arguments_.method_given ? *arguments_.method : method_at_wall(pair.method(), law().kind());
}

void FixWallGranCfpm::setup(int vflag) {
  clear_places_.forget_all();
  if (host_acts_) return add_forces([&] { host_wall_->setup(vflag); });
  const PairGranCfpm &pair = require_pair(*lmp, command_);
  const Method &method = method_beside(pair);
  const std::string wrong = law().reason_against(method);
  if (!wrong.empty()) error->all(FLERR, command_ + ": " + wrong);
  if (!contacts_ || &method != arguments_.method) {
    arguments_.method = &method;
    contacts_ = law().predicted_contacts(method);
  }
  onset_ = pair.onset_of(method);
  contacts_->prepare(inertia_dimension(*lmp), onset_);
  post_force(vflag);
}

void FixWallGranCfpm::move_surface() {
  surface_->move_to(static_cast<double>(update->ntimestep - start_) * update->dt);
}

/// The host's wall asks its region for each particle of its group in each step. It is given, for that time, the group
/// of those that may touch: it has seen every other one without contact, and that one is still clear of the wall.
void FixWallGranCfpm::let_host_act(int vflag) {
  const int near = spares_host_ ? free_group_bit(*group) : 0;
  if (near == 0) return host_wall_->post_force(vflag);
  move_surface();
  if (!surface_->knows_clearance()) return host_wall_->post_force(vflag);
  int *const mask = atom->mask;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(mask[i] & groupbit)) continue;
    const double radius = atom->radius[i];
    const Vec3 seen = surface_->seen(vec3(atom->x[i]));
    if (clear_places_.is_clear(i, seen, radius)) continue;
    clear_places_.remember(i, seen, surface_->clearance(seen, radius));
    mask[i] |= near;
  }
  host_wall_->groupbit = near;
  host_wall_->post_force(vflag);
  host_wall_->groupbit = groupbit;
  for (int i = 0; i < atom->nlocal; ++i) mask[i] &= ~near;
}

void FixWallGranCfpm::post_force(int vflag) {
  add_forces([&] { host_acts_ ? let_host_act(vflag) : add_predicted_forces(); });
}

/// By add(); tells energies behind it where a deck asks for them.
template <class Add> void FixWallGranCfpm::add_forces(const Add &add) {
  PairGranCfpm *const pair = find_pair(*lmp);
  EnergyBudget *const budget = pair ? pair->step().budget.get() : nullptr;
  if (!budget) return add();
  const Particles particles = pair->particles();
  std::vector<Vec3> before;
  before.reserve(static_cast<std::size_t>(atom->nlocal));
  for (int i = 0; i < atom->nlocal; ++i) before.push_back(vec3(particles.f[i]));
  budget->before_contacts(particles, atom->nlocal);
  add();
  budget->after_contacts(particles, atom->nlocal);
  if (host_acts_)
    add_energies_of_host(particles, pair->step(), before);
  else
    add_energies(pair->step());
}

std::string FixWallGranCfpm::reason_against_energy(const PairGranCfpm &pair) const {
  std::string of_law = law().reason_against_energy(method_beside(pair));
  if (!of_law.empty() || is_predicted_beside(pair)) return of_law;
  if (arguments_.shape[0] == "region")
    return "with 'predict verlet' contacts with a region are not told of; expected a plane, a cylinder or predicted "
           "contacts";
  return "";
}

/// Friction at walls that rest does no work.
void FixWallGranCfpm::add_energies(const StepState &step) {
  EnergyBudget &budget = *step.budget;
  for (std::size_t k = 0; k < touching_.size(); ++k) {
    const auto &[i, partners, contact] = touching_[k];
    const ContactEnergy energy = contacts_->energy_of(partners, contact, contact.span == step.dt, step);
    budget.add_normal_force(i, energy.normal_force);
    budget.add_elastic(1.0, energy.normal, energy.tangential);
    if (velocities_[k] == Vec3{}) continue;
    const Vec3 force = contacts_->action_of(partners, contact, step).mean.force;
    budget.add_moving_wall(energy.normal_force, force - energy.normal_force, velocities_[k]);
  }
}

/// Of what the host's wall has just done: it takes the nearest place of a plane or a cylinder, and hands out the
/// springs of a particle as it does where that goes to another rank. before: the forces without those of the wall.
void FixWallGranCfpm::add_energies_of_host(const Particles &particles, const StepState &step,
                                           const std::vector<Vec3> &before) {
  if (!of_host_) {
    of_host_ = law().predicted_contacts(Verlet::method);
    of_host_->prepare(inertia_dimension(*lmp), false);
  }
  EnergyBudget &budget = *step.budget;
  std::vector<double> history(static_cast<std::size_t>(std::max(3, host_wall_->maxexchange)));
  move_surface();
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double radius = particles.radius[i];
    const std::vector<WallTouch> &touches = surface_->touches(atom->x[i], radius);
    const auto near = std::min_element(touches.begin(), touches.end(),
                                       [](const WallTouch &a, const WallTouch &b) { return a.distance < b.distance; });
    if (near == touches.end()) continue;
    host_wall_->pack_exchange(i, history.data());
    const Contact contact{touching_wall(near->normal, near->distance, radius, particles.motion(i), near->velocity),
                          step.dt,
                          0.0,
                          {history.data(), step.dt, false}};
    const ContactPartners partners = at_wall(particles.type[i], radius, particles.mass[i], near->radius);
    const ContactEnergy energy = of_host_->energy_of(partners, contact, true, step);
    const Vec3 force = vec3(particles.f[i]) - before[static_cast<std::size_t>(i)];
    budget.add_normal_force(i, energy.normal_force);
    budget.add_elastic(1.0, energy.normal, energy.tangential);
    budget.add_moving_wall(energy.normal_force, force - energy.normal_force, near->velocity);
  }
}

void FixWallGranCfpm::add_predicted_forces() {
  if (!contacts_)
    error->all(FLERR, command_ + ": given again after the last setup; expected a 'run' that does its setup");
  PairGranCfpm &pair = require_pair(*lmp, command_);
  const Particles particles = pair.particles();
  StepState &step = pair.step();
  move_surface();
  touching_.clear();
  velocities_.clear();
  places_.clear();
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double radius = particles.radius[i];
    const double ahead =
        onset_ ? step.dt * bound_of_norm(vec3(particles.v[i])) + surface_->reach(step.dt, radius) : 0.0;
    const Vec3 seen = surface_->seen(vec3(particles.x[i]));
    if (clear_places_.is_clear(i, seen, radius + ahead)) continue;
    if (find_contacts(i, radius + ahead, particles, step))
      clear_places_.forget(i);
    else
      clear_places_.remember(i, seen, surface_->clearance(seen, radius));
  }
  contacts_->add_wall_forces(touching_, particles, step, !update->setupflag);
  if (arguments_.tells_contacts) tell_contacts(step);
}

/// Into the array of the host's wall, which has it per particle: whether it touches the wall, the force on it, the
/// place of the wall that it touches, its radius. Of several contacts the last, as the host does.
void FixWallGranCfpm::tell_contacts(const StepState &step) {
  const auto columns = static_cast<std::size_t>(size_peratom_cols);
  for (int i = 0; i < atom->nlocal; ++i) std::fill_n(array_atom[i], columns, 0.0);
  for (std::size_t k = 0; k < touching_.size(); ++k) {
    const auto &[i, partners, contact] = touching_[k];
    const ContactAction action = contacts_->action_of(partners, contact, step);
    if (!action.touching) continue;
    const Vec3 &force = action.mean.force;
    const Vec3 &place = places_[k];
    const double told[] = {1.0, force.x, force.y, force.z, place.x, place.y, place.z, atom->radius[i]};
    std::copy(std::begin(told), std::end(told), array_atom[i]);
  }
}

/// Commands may change the wall before the next run, which need not do its setup.
void FixWallGranCfpm::post_run() { clear_places_.forget_all(); }

/// Of a particle with surfaces that near; false if there are none.
bool FixWallGranCfpm::find_contacts(int i, double within, const Particles &particles, const StepState &step) {
  const Method &method = *arguments_.method;
  const double radius = particles.radius[i];
  const Motion motion = particles.motion(i);
  const Crowd crowd = method.wants_crowd ? step.crowd : Crowd{};
  const double mass = crowd.share(i, particles.mass[i]);
  const double others = particles.others(i, crowd);
  const std::size_t first = touching_.size();
  surfaces_.clear();
  const std::vector<WallTouch> &all_near = surface_->touches(atom->x[i], within);
  for (const WallTouch &near : all_near) {
    const auto touch = touch_wall(near.normal, near.distance, radius, motion, near.velocity, step.dt);
    if (!touch) continue;
    if (touch->span < step.dt) { // it may pass by an edge, or by a wall that bends away from it
      const Vec3 centre = vec3(atom->x[i]) + (step.dt - touch->span) * (motion.velocity - near.velocity);
      if (!surface_->is_near(centre, (1.0 + gap_of_flat_walls) * radius)) continue;
    }
    surfaces_.push_back(near.surface);
    const ContactPartners partners = at_wall(particles.type[i], radius, mass, near.radius);
    touching_.push_back({i, partners, {touch->geometry, touch->span, others, {}}});
    if (step.budget) velocities_.push_back(near.velocity);
    if (arguments_.tells_contacts) places_.push_back(vec3(atom->x[i]) - near.distance * near.normal);
  }
  history_->keep_only(i, surfaces_);
  for (std::size_t k = 0; k < surfaces_.size(); ++k) {
    double *const values = history_->contact(i, surfaces_[k]);
    if (!values) error->one(FLERR, command_ + ": a particle touches more surfaces than the region allows");
    StoredSpring &spring = touching_[first + k].contact.spring;
    spring.values = values + law_history_;
    if (method.wants_crowd) spring.now = spring.values + 3;
  }
  return !all_near.empty();
}

double FixWallGranCfpm::memory_usage() {
  const std::size_t values = static_cast<std::size_t>(atom->nmax) * history_->values_per_particle();
  return static_cast<double>(values * sizeof(double) + clear_places_.memory()) +
         (host_wall_ ? host_wall_->memory_usage() : 0.0);
}

void FixWallGranCfpm::grow_arrays(int particles) {
  history_->grow(particles);
  clear_places_.resize(particles);
  if (!host_wall_) return;
  host_wall_->grow_arrays(particles);
  array_atom = host_wall_->array_atom;
}

void FixWallGranCfpm::copy_arrays(int from, int to, int delflag) {
  clear_places_.copy(from, to);
  if (host_acts_) return host_wall_->copy_arrays(from, to, delflag);
  history_->copy(from, to);
}

void FixWallGranCfpm::set_arrays(int i) {
  clear_places_.forget(i);
  if (host_acts_) return host_wall_->set_arrays(i);
  history_->clear(i);
}

int FixWallGranCfpm::pack_exchange(int i, double *buffer) {
  if (host_acts_) return host_wall_->pack_exchange(i, buffer);
  std::copy_n(history_->of(i), history_->values_per_particle(), buffer);
  return own_exchange();
}

int FixWallGranCfpm::unpack_exchange(int i, double *buffer) {
  clear_places_.forget(i); // of one without contacts
  if (host_acts_) return host_wall_->unpack_exchange(i, buffer);
  std::copy_n(buffer, history_->values_per_particle(), history_->of(i));
  return own_exchange();
}

int FixWallGranCfpm::pack_restart(int i, double *buffer) {
  if (host_acts_) return host_wall_->pack_restart(i, buffer);
  buffer[0] = size_restart(i);
  return 1 + pack_exchange(i, buffer + 1);
}

void FixWallGranCfpm::unpack_restart(int i, int nth) {
  if (host_acts_) return host_wall_->unpack_restart(i, nth);
  const double *extra = atom->extra[i];
  for (int k = 0; k < nth; ++k) extra += static_cast<int>(extra[0]);
  if (static_cast<int>(extra[0]) == size_restart(i))
    std::copy_n(extra + 1, history_->values_per_particle(), history_->of(i));
  else
    history_->clear(i); // of a wall with another number of surfaces
}

int FixWallGranCfpm::size_restart(int i) { return host_acts_ ? host_wall_->size_restart(i) : 1 + own_exchange(); }
int FixWallGranCfpm::maxsize_restart() { return host_acts_ ? host_wall_->maxsize_restart() : 1 + own_exchange(); }

// the host's wall keeps how its region moves
void FixWallGranCfpm::write_restart(FILE *file) {
  if (host_wall_) host_wall_->write_restart(file);
}

void FixWallGranCfpm::restart(char *state) {
  if (host_wall_) host_wall_->restart(state);
}

void FixWallGranCfpm::reset_dt() {
  if (host_wall_) host_wall_->reset_dt();
}

} // namespace cfpm::lammps
