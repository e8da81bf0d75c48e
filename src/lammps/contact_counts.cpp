// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact_counts.h"

#include "host_versions.h"

namespace cfpm::lammps {

namespace {
constexpr int values_per_particle = 2;
}

ContactCounts::ContactCounts(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  create_attribute = 1;
  restart_peratom = 1;
  maxexchange = values_per_particle;
  ContactCounts::grow_arrays(atom->nmax);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
  atom->add_callback(LAMMPS_NS::Atom::RESTART);
}

ContactCounts::~ContactCounts() {
  atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
  atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

ContactCounts *ContactCounts::find(LAMMPS_NS::Modify &modify) {
  for (LAMMPS_NS::Fix *fix : fixes(modify))
    if (auto *found = dynamic_cast<ContactCounts *>(fix)) return found;
  return nullptr;
}

double ContactCounts::memory_usage() {
  return static_cast<double>(values_per_particle * static_cast<std::size_t>(atom->nmax) * sizeof(double));
}

void ContactCounts::grow_arrays(int particles) {
  before_.resize(static_cast<std::size_t>(particles));
  now_.resize(static_cast<std::size_t>(particles));
}

void ContactCounts::copy_arrays(int from, int to, int) {
  before()[to] = before()[from];
  now()[to] = now()[from];
}

void ContactCounts::set_arrays(int i) { before()[i] = now()[i] = 0.0; }

int ContactCounts::pack_exchange(int i, double *buffer) {
  buffer[0] = before()[i];
  buffer[1] = now()[i];
  return values_per_particle;
}

int ContactCounts::unpack_exchange(int i, double *buffer) {
  before()[i] = buffer[0];
  now()[i] = buffer[1];
  return values_per_particle;
}

int ContactCounts::pack_restart(int i, double *buffer) {
  buffer[0] = size_restart(i);
  return 1 + pack_exchange(i, buffer + 1);
}

void ContactCounts::unpack_restart(int i, int nth) {
  double *extra = atom->extra[i];
  for (int k = 0; k < nth; ++k) extra += static_cast<int>(extra[0]);
  unpack_exchange(i, extra + 1);
}

int ContactCounts::size_restart(int) { return 1 + values_per_particle; }
int ContactCounts::maxsize_restart() { return 1 + values_per_particle; }

} // namespace cfpm::lammps
