// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_arguments.h"
#include "host.h"
#include "predicted_contacts.h"

#include <memory>
#include <string>
#include <vector>

namespace cfpm::lammps {

struct NeighborHistory;

/// pair_style gran/cfpm: predicted contacts around the host's gran/hooke/history or gran/hertz/history.
/// The host's style keeps the neighbour list, the contact history with its way through exchange and
/// restart, and the cutoffs; this one computes the mean forces over the coming step. With "predict none"
/// the host's style does that too.
class PairGranCfpm : public LAMMPS_NS::Pair {
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
  double atom2cut(int i) override { return host_style_->atom2cut(i); }
  double radii2cut(double ri, double rj) override { return host_style_->radii2cut(ri, rj); }

  /// The predictor in force, or nullptr for "predict none".
  const Predictor *predictor() const { return arguments_.predictor; }
  const ContactArguments &arguments() const { return arguments_; }
  /// The dt over which the forces now in f are means; 0 before the first evaluation with these settings.
  double predicted_step() const { return predicted_step_; }

private:
  [[noreturn]] void fail(const std::string &what) const;
  void apply(const std::vector<std::string> &words);
  void compute_with_host_style(int eflag, int vflag);
  void disown_tallies();
  ListedPairs listed_pairs() const;

  const std::string law_;
  ContactArguments arguments_;
  std::string command_line_; ///< the law and its arguments, each with a final 0
  std::unique_ptr<LAMMPS_NS::Pair> host_style_;
  std::string host_style_name_;
  bool tallies_are_the_hosts_ = false;
  NeighborHistory *history_ = nullptr; ///< of the host's style
  std::unique_ptr<PredictedContacts> contacts_;
  int frozen_ = 0; ///< group bit of fix freeze
  double predicted_step_ = 0.0;
};

} // namespace cfpm::lammps
