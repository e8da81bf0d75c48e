// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_contact_counts.h"

#include "host_versions.h"

namespace cfpm::lammps {

namespace {
constexpr int values_per_particle = 2;
}

FixContactCounts::FixContactCounts(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  create_attribute = 1;
  restart_peratom = 1;
  maxexchange = values_per_particle;
  FixContactCounts::grow_arrays(atom->nmax);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
  atom->add_callback(LAMMPS_NS::Atom::RESTART);
}

FixContactCounts::~FixContactCounts() {
  atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
  atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

FixContactCounts *FixContactCounts::find(LAMMPS_NS::Modify &modify) {
  for (LAMMPS_NS::Fix *fix : fixes(modify))
    if (auto *found = dynamic_cast<FixContactCounts *>(fix)) return found;
  return nullptr;
}

double FixContactCounts::memory_usage() {
  return static_cast<double>(values_per_particle * static_cast<std::size_t>(atom->nmax) * sizeof(double));
}

void FixContactCounts::grow_arrays(int particles) {
  before_.resize(static_cast<std::size_t>(particles));
  now_.resize(static_cast<std::size_t>(particles));
}

void FixContactCounts::copy_arrays(int from, int to, int) {
  before()[to] = before()[from];
  now()[to] = now()[from];
}

void FixContactCounts::set_arrays(int i) { before()[i] = now()[i] = 0.0; }

int FixContactCounts::pack_exchange(int i, double *buffer) {
  buffer[0] = before()[i];
  buffer[1] = now()[i];
  return values_per_particle;
}

int FixContactCounts::unpack_exchange(int i, double *buffer) {
  before()[i] = buffer[0];
  now()[i] = buffer[1];
  return values_per_particle;
}

int FixContactCounts::pack_restart(int i, double *buffer) {
  buffer[0] = size_restart(i);
  return 1 + pack_exchange(i, buffer + 1);
}

void FixContactCounts::unpack_restart(int i, int nth) {
  double *extra = atom->extra[i];
  for (int k = 0; k < nth; ++k) extra += static_cast<int>(extra[0]);
  unpack_exchange(i, extra + 1);
}

int FixContactCounts::size_restart(int) { return 1 + values_per_particle; }
int FixContactCounts::maxsize_restart() { return 1 + values_per_particle; }

} // namespace cfpm::lammps
