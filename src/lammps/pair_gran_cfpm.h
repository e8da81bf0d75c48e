// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host_versions.h"
#include "pair_law.h"
#include "predicted_contacts.h"

#include "core/deck/method_and_step.h"
#include "core/step/near_pairs.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cfpm::lammps {

class FixContactCounts;

/// pair_style gran/cfpm and granular/cfpm: predicted contacts around the style of the host that has the law.
/// The host's style keeps the neighbour list, the contact history with its way through exchange and
/// restart, and the cutoffs; this one computes the mean forces over the coming step. With "predict verlet"
/// it computes the forces of the host's style, to the last bit and several contacts at a time, or leaves them to that.
class PairGranCfpm : public PairAroundHostStyle {
public:
  /// model: in front of the arguments of settings(), for a name of the style that says it.
  PairGranCfpm(LAMMPS_NS::LAMMPS *lmp, std::unique_ptr<PairLaw> law, std::string model = "");
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

  const Method &method() const { return *arguments_.method; }
  const PairLaw &law() const { return *law_; }
  /// Whether contacts that a method solves, of pairs or at a wall, begin inside a step.
  bool onset_of(const Method &method) const { return begins_inside(method, arguments_.options.onset); }
  /// What the run before had, until this one begins.
  const MethodAndStep &ran() const { return ran_; }
  /// contact_time: the shortest, infinite without particles [s]
  void begin_run(double contact_time);
  /// What chooses the method, null where the command names it.
  const AutoMethod *automatic() const { return auto_ ? &*auto_ : nullptr; }
  /// Also in a later run.
  bool may_predict() const {
    return auto_ ? AutoMethod::at_few_steps(law_->kind_for_auto()).predicted : method().predicted;
  }
  StepState &step() { return step_; }
  const StepState &step() const { return step_; }
  /// Why forces of one instant are left to the host's style, or "" if they are not, see reason_for_host_style().
  const std::string &left_to_host() const { return left_to_host_; }
  /// The group bit of fix freeze, or 0.
  int frozen() const { return frozen_; }
  Particles particles() const;

private:
  [[noreturn]] void fail(const std::string &what) const;
  void apply(const std::vector<std::string> &words, Command made);
  void use_method();
  void follow_auto();
  void compute_with_host_style(int eflag, int vflag);
  void compute_forces_of_instant(int eflag, int vflag);
  Tally begin_tally(int eflag, int vflag);
  void disown_tallies();
  void take_over_columns();
  void create_host_style();
  /// The arguments of a pair_coeff, with the pairs of types for which it is in force.
  struct Coefficients {
    std::vector<std::string> words;
    TypePairs pairs;
  };
  void give_coefficients(Coefficients &given);
  void repeat_coefficients();
  void make_contacts();
  void begin_impulses();
  void prepare_energies();
  void leave_budget();
  void add_forces(int eflag, int vflag);
  void add_energies(EnergyBudget &budget);
  PairList pair_list() const;
  PairList pairs_to_evaluate();

  const std::unique_ptr<PairLaw> law_;
  const std::string model_;
  MethodArguments arguments_;
  std::vector<std::string> words_;         ///< the arguments of the law, always with a method
  std::vector<Coefficients> coefficients_; ///< in the order in which they were given
  std::optional<AutoMethod> auto_;         ///< with "predict auto"
  std::string host_style_name_;
  bool host_predicted_ = false; ///< it was made for a method that predicts
  LawKind contacts_kind_ = LawKind::any;
  double host_step_ = 0.0; ///< by which the host's style moves springs on [s]
  std::string left_to_host_;
  bool tallies_are_the_hosts_ = false;
  NeighborHistory *history_ = nullptr; ///< of the host's style
  std::unique_ptr<PredictedContacts> contacts_;
  int history_size_ = 0; ///< values of a contact
  int frozen_ = 0;       ///< group bit of fix freeze
  NearPairs near_;
  StepState step_;
  EnergyBudget *given_back_ = nullptr; ///< to particles on other ranks, in place of impulses
  MethodAndStep ran_;
  /// Whose contact history a restart file holds, until the host has it.
  struct {
    const Method *method = nullptr;
    int history_size = 0;
  } restored_;
  FixContactCounts *counts_ = nullptr; ///< if impulses are given
};

} // namespace cfpm::lammps
