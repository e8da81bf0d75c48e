// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host_contact_models.h"
#include "model_arguments.h"
#include "prediction.h"

namespace cfpm::liggghts {

/// fix wall/gran/cfpm: the host's primitive and mesh walls around this plugin's contact models.
/// The arguments are a base so that they are rewritten before the host's constructor parses them.
class FixWallGranCfpm : private ModelArguments, public LAMMPS_NS::FixWallGran, public PredictionOwner {
public:
  FixWallGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  void init() override;
  void post_force(int vflag) override;

  /// Without "predict" in its own command a wall follows the pair style, with the default of its own law
  /// where the predictor of the pairs has no form for it.
  const Predictor *predictor() const override;
  void connect(PredictedContacts &contacts) override { contacts_ = &contacts; }
  const SharedStep &shared_step() const override;
  const char *command() const override { return "fix wall/gran/cfpm"; }

  PredictedContacts &contacts() const { return *contacts_; }
  /// Of the meshes that move, near the particles of this rank [m/s].
  double largest_mesh_speed() const;

private:
  PredictedContacts *contacts_ = nullptr;
};

} // namespace cfpm::liggghts
