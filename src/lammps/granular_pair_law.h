// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "granular_coefficients.h"
#include "granular_history.h"
#include "instant_forces.h"
#include "pair_law.h"

#include <memory>
#include <string>
#include <vector>

namespace cfpm::lammps {

/// Of the host's pair_style granular: sub-models for each pair of types, which pair_coeff gives. Some of them can be
/// predicted, and their forces of one instant computed; the host's style computes those of all.
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
  std::string host_style(const Method &) const override { return "granular"; }
  std::vector<std::string> for_host_style() const override { return cutoff_; }
  std::vector<std::string> for_host_style(const std::vector<std::string> &coefficients,
                                          const Method &method) const override;
  int law_history() const override { return 0; }
  int history_size(const Method &method) const override;
  int host_history_size(const Method &method, int types) const override;
  /// What pair_coeff says of the sub-models decides, see for_host_style().
  bool set_history_size(LAMMPS_NS::Pair &, int) const override { return true; }
  bool numbers_histories() const override { return false; }
  std::string reason_against_energy(const Method &method) const override;
  std::unique_ptr<PredictedContacts> predicted_contacts(const Method &method) const override;
  int instant_history() const override { return instant_.history.size; }
  HistoryPlaces instant_places() const override { return instant_.history.places; }
  std::string reason_for_host_style() const override { return left_to_host_; }
  void add_instant_forces(const Particles &particles, const PairList &pairs, double dt,
                          const Tally &tally) const override;

private:
  void find_reason_for_host_style(int types);
  bool keeps_more(const Method &method) const { return method.predicted && ask_for_wider_history(coefficients_); }

  std::vector<std::string> cutoff_; ///< or empty
  GranularPairs coefficients_;
  std::shared_ptr<GranularPairs> complete_ = std::make_shared<GranularPairs>(); ///< with those that are mixed
  // of any pair_coeff, also of one that another is in force for: the host's style may keep its history as they ask for
  std::vector<GranularCoefficients> given_;
  struct {
    GranularHistory history;
    InstantLoop loop = InstantLoop::plain;
  } instant_; ///< of those in force
  std::string left_to_host_;
  LawKind kind_ = LawKind::any;
  bool damped_friction_ = true;
};

/// What of these sub-models a method has no form for whose law may be one that it predicts, as it is written, and which
/// methods have one; empty if there is nothing.
struct WithoutForm {
  std::string sub_model;
  std::string methods;
};
WithoutForm without_form(const GranularCoefficients &coefficients, const Method &method);

/// "predict X" of a command with the sub-models of granular, taken out of its words.
MethodArguments take_granular_method(LAMMPS_NS::LAMMPS &lmp, const std::string &command, ContactOwner owner,
                                     std::vector<std::string> &words);

} // namespace cfpm::lammps
