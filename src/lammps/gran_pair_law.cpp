// SPDX-License-Identifier: GPL-2.0-or-later
#include "gran_pair_law.h"

#include "host_versions.h"
#include "instant_forces.h"

namespace cfpm::lammps {

MethodArguments GranPairLaw::read(LAMMPS_NS::LAMMPS &lmp, const std::vector<std::string> &words, Command made) {
  arguments_ = read_contact_arguments(lmp, command(), ContactOwner::pairs, words, made);
  if (!arguments_.rest.empty())
    lmp.error->all(FLERR, std::string(command()) + ": unknown argument '" + arguments_.rest[0] +
                              "'; expected hooke|hooke/nohistory|hertz Kn Kt gamma_n gamma_t xmu dampflag "
                              "[limit_damping] [predict ... [split c] [onset on|off]]");
  return arguments_;
}

std::vector<Collision> GranPairLaw::collisions(const ContactPartners &partners, double impact_speed) const {
  return {collision(arguments_, partners, impact_speed)};
}

bool GranPairLaw::set_history_size(LAMMPS_NS::Pair &host_style, int size) const {
  return cfpm::lammps::set_history_size(host_style, arguments_, size);
}

std::unique_ptr<PredictedContacts> GranPairLaw::predicted_contacts(const Method &method) const {
  ContactArguments solved = arguments_;
  solved.method = &method;
  return make_predicted_contacts(solved);
}

void GranPairLaw::add_instant_forces(const Particles &particles, const PairList &pairs, double dt,
                                     const Tally &tally) const {
  cfpm::lammps::add_instant_forces(arguments_, particles, pairs, dt, tally);
}

} // namespace cfpm::lammps
