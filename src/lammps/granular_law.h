// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "pair_law.h"

namespace cfpm::lammps {

/// Of the host's pair_style granular: sub-models for each pair of types, which pair_coeff gives. The host's style
/// computes all of them, so there are forces of one instant only.
class GranularLaw : public PairLaw {
public:
  const char *command() const override { return "pair_style granular/cfpm"; }
  MethodArguments read(LAMMPS_NS::LAMMPS &lmp, const std::vector<std::string> &words, Command made) override;
  LawKind kind() const override { return LawKind::any; }
  bool damped_friction() const override { return true; }
  std::optional<Collision> collision(const ContactPartners &, double) const override { return std::nullopt; }
  const char *host_style() const override { return "granular"; }
  std::vector<std::string> for_host_style() const override { return cutoff_; }
  int law_history() const override { return 0; }
  bool set_history_size(LAMMPS_NS::Pair &, int) const override { return false; }
  std::unique_ptr<PredictedContacts> predicted_contacts(const Method &) const override { return nullptr; }
  std::string reason_for_host_style() const override { return "pair_style granular has sub-models"; }
  void add_instant_forces(const Particles &, const PairList &, double, const Tally &) const override {}

private:
  std::vector<std::string> cutoff_; ///< or empty
};

/// "predict X" of a command with the sub-models of granular, taken out of its words: stops the run unless that leaves
/// forces of one instant.
MethodArguments take_granular_method(LAMMPS_NS::LAMMPS &lmp, const std::string &command, ContactOwner owner,
                                     std::vector<std::string> &words);

} // namespace cfpm::lammps
