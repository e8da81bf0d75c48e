// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_model_interface.h"
#include "host_contact_models.h"
#include "model_arguments.h"

#include "core/deck/method_and_step.h"
#include "core/method/method.h"
#include "core/step/near_pairs.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cfpm::liggghts {

/// pair_style gran/cfpm: the host's granular pair style around this plugin's contact models.
/// Writes the mean contact force over the coming step into f and torque.
class PairGranCfpm : public LAMMPS_NS::PairGranProxy, public ContactModelOwner {
public:
  explicit PairGranCfpm(LAMMPS_NS::LAMMPS *host);
  PairGranCfpm(const PairGranCfpm &) = delete;
  PairGranCfpm &operator=(const PairGranCfpm &) = delete;
  ~PairGranCfpm() override;

  void settings(int narg, char **arg) override;
  void init_style() override;
  void init_list(int id, LAMMPS_NS::NeighList *list) override;
  void write_restart_settings(FILE *file) override;
  void read_restart_settings(FILE *file, int major, int minor) override;
  void compute_force(int eflag, int vflag, int addflag) override;

  const Method &method() const override { return *method_; }
  bool onset() const override { return onset_of(*method_); }
  /// Whether contacts that a method solves, of pairs or at a wall, begin inside a step.
  bool onset_of(const Method &method) const { return begins_inside(method, arguments_->options().onset); }
  /// What the run before had, until this one begins.
  const MethodAndStep &ran() const { return ran_; }
  /// contact_time: the shortest, infinite without particles [s]
  void begin_run(double contact_time);
  /// What chooses the method, null where the command names it.
  const AutoMethod *automatic() const { return auto_ ? &*auto_ : nullptr; }
  void connect(ContactModelInterface &model) override { contact_model_ = &model; }
  StepState &step() override { return step_; }
  const StepState &step() const { return step_; }
  const char *command() const override { return "pair_style gran/cfpm"; }
  /// Of all particles of this rank and their neighbours, where contacts begin inside a step; else infinite [m].
  double smallest_radius() const { return smallest_radius_; }

  /// Of who asks for a budget of energy, null for nobody.
  void tell_energies_to(std::shared_ptr<EnergyBudget> budget) { step_.budget = std::move(budget); }
  /// Why its contacts have none, and what is expected, or "".
  std::string reason_against_energy();

  /// Why forces of one instant are left to the host's loop, as text behind "as"; empty where they are not.
  const std::string &left_to_host() const { return left_to_host_; }

  /// Of the command, null before it is given.
  const ModelArguments *arguments() const { return arguments_.get(); }
  ContactModelInterface &contact_model() const { return *contact_model_; }
  Particles particles();
  /// Of all pairs that overlap, see equivalent_overlaps(), for the state whose forces were evaluated last.
  std::vector<PairOverlap> overlaps();

private:
  void apply(std::vector<std::string> words, Command made);
  void choose_method();
  void publish_style(const char *name);
  void begin_impulses();
  void add_forces(int eflag, int vflag, int addflag);
  /// The host's neighbour list and contact history; there must be at least one particle.
  PairList pair_list();
  PairList pairs_to_evaluate();
  /// Whether this evaluation feeds more than f and torque, or takes host models along.
  bool host_loop_needed(int eflag, int vflag, int addflag);
  /// Whether the deck asks for what only the host's loop does.
  bool feeds_others();
  std::string reason_for_host_loop();

  std::vector<std::string> words_; ///< of the last settings(), always with a method
  std::unique_ptr<ModelArguments> arguments_;
  std::optional<AutoMethod> auto_; ///< with "predict auto"
  const Method *method_ = nullptr;
  ContactModelInterface *contact_model_ = nullptr;
  std::string left_to_host_;
  NearPairs near_;
  StepState step_;
  MethodAndStep ran_;
  LAMMPS_NS::bigint ran_from_ = 0; ///< the first step of that run
  double smallest_radius_ = std::numeric_limits<double>::infinity();
  LAMMPS_NS::FixPropertyAtom *fix_before_ = nullptr;   ///< contacts of each particle in the step before
  LAMMPS_NS::FixPropertyAtom *fix_contacts_ = nullptr; ///< and as they are counted
};

} // namespace cfpm::liggghts
