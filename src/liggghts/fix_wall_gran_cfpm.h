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

  /// Without "predict" in its own command a wall follows the pair style.
  const Predictor *predictor() const override;
  void connect(LawSource &source) override { law_source_ = &source; }
  const char *command() const override { return "fix wall/gran/cfpm"; }

  LawSource &law_source() const { return *law_source_; }

private:
  LawSource *law_source_ = nullptr;
};

} // namespace cfpm::liggghts
