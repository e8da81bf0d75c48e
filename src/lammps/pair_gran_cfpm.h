// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_arguments.h"
#include "host_versions.h"
#include "predicted_contacts.h"
#include "shared_step.h"

#include <memory>
#include <string>
#include <vector>

namespace cfpm::lammps {

class ContactCounts;

/// pair_style gran/cfpm: predicted contacts around the host's gran/hooke/history or gran/hertz/history.
/// The host's style keeps the neighbour list, the contact history with its way through exchange and
/// restart, and the cutoffs; this one computes the mean forces over the coming step. With "predict none"
/// the host's style does that too.
class PairGranCfpm : public PairAroundHostStyle {
public:
  /// law: in front of the arguments of settings(), for a name of the style that says it.
  explicit PairGranCfpm(LAMMPS_NS::LAMMPS *lmp, std::string law = "");
  PairGranCfpm(const PairGranCfpm &) = delete;
  PairGranCfpm &operator=(const PairGranCfpm &) = delete;
  ~PairGranCfpm() override;

  void settings(int narg, char **arg) override;
  void coeff(int narg, char **arg) override;
  void init_style() override;
  void init_list(int id, LAMMPS_NS::NeighList *list) override;
  double init_one(int i, int j) override;
  void setup() override;
  void reset_dt() override;
  void compute(int eflag, int vflag) override;
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul, double factor_lj,
                double &fforce) override;
  void write_restart(FILE *file) override;
  void read_restart(FILE *file) override;
  double memory_usage() override { return host_style_->memory_usage(); }
  int pack_forward_comm(int count, int *particles, double *buffer, int, int *) override;
  void unpack_forward_comm(int count, int first, double *buffer) override;
  int pack_reverse_comm(int count, int first, double *buffer) override;
  void unpack_reverse_comm(int count, int *particles, double *buffer) override;

  /// The predictor in force, or nullptr for "predict none".
  const Predictor *predictor() const { return arguments_.predictor; }
  const ContactArguments &arguments() const { return arguments_; }
  /// The dt over which the forces now in f are means; 0 before the first evaluation with these settings.
  double predicted_step() const { return predicted_step_; }
  /// Whether pairs or walls give impulses, which shift positions beyond the mean forces.
  bool gives_impulses() const { return gives_impulses_; }
  const SharedStep &shared_step() const { return shared_step_; }
  /// The group bit of fix freeze, or 0.
  int frozen() const { return frozen_; }

private:
  [[noreturn]] void fail(const std::string &what) const;
  void apply(const std::vector<std::string> &words);
  void compute_with_host_style(int eflag, int vflag);
  void disown_tallies();
  bool has_impulses() const { return predictor() && predictor()->impulse; }
  void create_host_style();
  void repeat_coefficients();
  void begin_shared_step();
  ListedPairs listed_pairs() const;

  const std::string law_;
  ContactArguments arguments_;
  std::string command_line_; ///< the law and its arguments, each with a final 0
  std::string host_style_name_;
  bool tallies_are_the_hosts_ = false;
  NeighborHistory *history_ = nullptr; ///< of the host's style
  std::unique_ptr<PredictedContacts> contacts_;
  int history_size_ = 0; ///< values of a contact
  int frozen_ = 0;       ///< group bit of fix freeze
  double predicted_step_ = 0.0;
  bool gives_impulses_ = false;
  SharedStep shared_step_;
  std::vector<double> shift_;       ///< three values a particle, of this rank and of neighbours on others
  ContactCounts *counts_ = nullptr; ///< if impulses are given
};

} // namespace cfpm::lammps
