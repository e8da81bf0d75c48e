// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "granular_coefficients.h"
#include "pair_law.h"

#include <map>
#include <memory>

namespace cfpm::lammps {

/// Of the host's pair_style granular: sub-models for each pair of types, which pair_coeff gives. Some of them can be
/// predicted; the host's style computes the forces of one instant of all.
class GranularPairLaw : public PairLaw {
public:
  const char *command() const override { return "pair_style granular/cfpm"; }
  MethodArguments read(LAMMPS_NS::LAMMPS &lmp, const std::vector<std::string> &words, Command made) override;
  LawKind kind() const override { return kind_; }
  LawKind kind_for_auto() const override { return LawKind::any; }
  bool damped_friction() const override { return damped_friction_; }
  std::vector<Collision> collisions(const ContactPartners &partners, double impact_speed) const override;
  bool has_coefficients() const override { return true; }
  bool enlarges_history(const std::vector<std::string> &coefficients) const override;
  void take_coefficients(const std::vector<std::string> &words, const TypePairs &pairs) override;
  std::string complete(int types, const Method &method) override;
  const char *host_style() const override { return "granular"; }
  std::vector<std::string> for_host_style() const override { return cutoff_; }
  std::vector<std::string> for_host_style(const std::vector<std::string> &coefficients,
                                          const Method &method) const override;
  int law_history() const override { return 0; }
  /// What pair_coeff says of the sub-models decides, see for_host_style().
  bool set_history_size(LAMMPS_NS::Pair &, int) const override { return true; }
  bool numbers_histories() const override { return false; }
  std::unique_ptr<PredictedContacts> predicted_contacts(const Method &method) const override;
  std::string reason_for_host_style() const override { return "pair_style granular has sub-models"; }
  void add_instant_forces(const Particles &, const PairList &, double, const Tally &) const override {}

private:
  /// By pairs of types, i <= j.
  using Coefficients = std::map<std::pair<int, int>, GranularCoefficients>;

  std::vector<std::string> cutoff_; ///< or empty
  Coefficients given_;
  std::shared_ptr<Coefficients> complete_ = std::make_shared<Coefficients>(); ///< with those that are mixed
  LawKind kind_ = LawKind::any;
  bool damped_friction_ = true;
};

/// "predict X" of a command with the sub-models of granular, taken out of its words.
MethodArguments take_granular_method(LAMMPS_NS::LAMMPS &lmp, const std::string &command, ContactOwner owner,
                                     std::vector<std::string> &words);

} // namespace cfpm::lammps
