// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_arguments.h"
#include "pair_law.h"

namespace cfpm::lammps {

/// Of the host's gran/hooke/history, gran/hooke and gran/hertz/history: one contact for all pairs.
class GranPairLaw : public PairLaw {
public:
  const char *command() const override { return "pair_style gran/cfpm"; }
  MethodArguments read(LAMMPS_NS::LAMMPS &lmp, const std::vector<std::string> &words, Command made) override;
  LawKind kind() const override { return arguments_.law(); }
  bool damped_friction() const override { return arguments_.damped_friction(); }
  std::vector<Collision> collisions(const ContactPartners &partners, double impact_speed) const override;
  std::string host_style(const Method &method) const override {
    return "gran/" + arguments_.host_model(method.predicted);
  }
  std::vector<std::string> for_host_style() const override { return arguments_.for_host_style; }
  int law_history() const override { return arguments_.law_history(); }
  int instant_history() const override { return arguments_.history ? PairLaw::instant_history() : 0; }
  bool set_history_size(LAMMPS_NS::Pair &host_style, int size) const override;
  std::string reason_against_energy(const Method &method) const override {
    return arguments_.reason_against_energy(method);
  }
  std::unique_ptr<PredictedContacts> predicted_contacts(const Method &method) const override;
  void add_instant_forces(const Particles &particles, const PairList &pairs, double dt,
                          const Tally &tally) const override;

private:
  ContactArguments arguments_;
};

} // namespace cfpm::lammps
