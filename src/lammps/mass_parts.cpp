// SPDX-License-Identifier: GPL-2.0-or-later
#include "mass_parts.h"

namespace cfpm::lammps {

namespace {
constexpr int values_per_particle = 2;
}

MassParts::MassParts(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
  create_attribute = 1;
  restart_peratom = 1;
  maxexchange = values_per_particle;
  MassParts::grow_arrays(atom->nmax);
  atom->add_callback(LAMMPS_NS::Atom::GROW);
  atom->add_callback(LAMMPS_NS::Atom::RESTART);
}

MassParts::~MassParts() {
  atom->delete_callback(id, LAMMPS_NS::Atom::GROW);
  atom->delete_callback(id, LAMMPS_NS::Atom::RESTART);
}

MassParts *MassParts::find(LAMMPS_NS::Modify &modify) {
  const int found = modify.find_fix(name);
  return found < 0 ? nullptr : dynamic_cast<MassParts *>(modify.fix[found]);
}

double MassParts::memory_usage() {
  return static_cast<double>(values_per_particle * static_cast<std::size_t>(atom->nmax) * sizeof(double));
}

void MassParts::grow_arrays(int particles) {
  parts_.resize(static_cast<std::size_t>(particles), 1.0);
  contacts_.resize(static_cast<std::size_t>(particles), 0.0);
}

void MassParts::copy_arrays(int from, int to, int) {
  parts()[to] = parts()[from];
  contacts()[to] = contacts()[from];
}

void MassParts::set_arrays(int i) {
  parts()[i] = 1.0;
  contacts()[i] = 0.0;
}

int MassParts::pack_exchange(int i, double *buffer) {
  buffer[0] = parts()[i];
  buffer[1] = contacts()[i];
  return values_per_particle;
}

int MassParts::unpack_exchange(int i, double *buffer) {
  parts()[i] = buffer[0];
  contacts()[i] = buffer[1];
  return values_per_particle;
}

int MassParts::pack_restart(int i, double *buffer) {
  buffer[0] = size_restart(i);
  return 1 + pack_exchange(i, buffer + 1);
}

void MassParts::unpack_restart(int i, int nth) {
  double *extra = atom->extra[i];
  for (int k = 0; k < nth; ++k) extra += static_cast<int>(extra[0]);
  unpack_exchange(i, extra + 1);
}

int MassParts::size_restart(int) { return 1 + values_per_particle; }
int MassParts::maxsize_restart() { return 1 + values_per_particle; }

} // namespace cfpm::lammps
