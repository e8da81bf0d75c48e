// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host_contact_models.h"
#include "model_arguments.h"
#include "prediction.h"

#include "../core/pair_loop.h"

#include <string>
#include <vector>

namespace cfpm::liggghts {

/// pair_style gran/cfpm: the host's granular pair style around this plugin's contact models.
/// Writes the mean contact force over the coming step into f and torque.
class PairGranCfpm : public LAMMPS_NS::PairGranProxy, public PredictionOwner {
public:
  explicit PairGranCfpm(LAMMPS_NS::LAMMPS *lmp) : PairGranProxy(lmp) {}

  void settings(int narg, char **arg) override;
  void init_style() override;
  void init_list(int id, LAMMPS_NS::NeighList *list) override;
  void write_restart_settings(FILE *file) override;
  void read_restart_settings(FILE *file, int major, int minor) override;
  void compute_force(int eflag, int vflag, int addflag) override;

  const Predictor *predictor() const override { return predictor_; }
  void connect(PredictedContacts &contacts) override { contacts_ = &contacts; }
  const SharedStep &shared_step() const override { return shared_step_; }
  const char *command() const override { return "pair_style gran/cfpm"; }

  /// The host's neighbour list and contact history; there must be at least one particle.
  ListedPairs listed_pairs();
  PredictedContacts &contacts() const { return *contacts_; }
  /// Whether pairs or walls give impulses, which shift positions beyond the mean forces.
  bool gives_impulses() const { return gives_impulses_; }
  /// The dt over which the forces now in f are means; 0 before the first evaluation.
  double predicted_step() const { return predicted_step_; }
  /// For how many particles of this rank, and how often forces have been predicted up to now.
  int predicted_particles() const { return predicted_particles_; }
  long predictions() const { return predictions_; }

private:
  void publish_style(const char *name);
  void begin_shared_step();
  /// Whether this evaluation feeds more than f and torque, or takes host models along.
  bool host_loop_needed(int eflag, int vflag, int addflag);

  const Predictor *predictor_ = nullptr;
  PredictedContacts *contacts_ = nullptr;
  double predicted_step_ = 0.0;
  int predicted_particles_ = 0;
  long predictions_ = 0;
  bool gives_impulses_ = false;
  ImpulseOptions options_;
  SharedStep shared_step_;
  std::vector<double> shift_;                          ///< three values a particle of this rank
  LAMMPS_NS::FixPropertyAtom *fix_before_ = nullptr;   ///< contacts of each particle in the step before
  LAMMPS_NS::FixPropertyAtom *fix_contacts_ = nullptr; ///< and as they are counted
  std::string command_line_;                           ///< of the last settings(), each argument with a final 0
  std::string setting_without_prediction_;
};

} // namespace cfpm::liggghts
