// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_gran_cfpm.h"

#include "companions.h"
#include "pair_gran_cfpm.h"

namespace cfpm::liggghts {

FixWallGranCfpm::FixWallGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg)
    : ModelArguments(lmp, std::string("fix wall/gran/cfpm (id ") + arg[0] + ")", narg, arg, 3),
      FixWallGran(lmp, ModelArguments::count(), ModelArguments::values()) {}

void FixWallGranCfpm::init() {
  require_cfpm_pair(*lmp, command());
  if (predictor() && !setting_without_prediction().empty())
    error->fix_error(
        FLERR, this,
        ("setting '" + setting_without_prediction() + "' has no predicted form; switch it off or use 'predict none'")
            .c_str());
  FixWallGran::init();
}

void FixWallGranCfpm::post_force(int vflag) {
  FixWallGran::post_force(vflag);
  contacts_->all_evaluated();
}

const Predictor *FixWallGranCfpm::predictor() const {
  if (prediction()) return *prediction();
  const auto *pair = dynamic_cast<const PairGranCfpm *>(force->pair);
  const Predictor *of_pairs = pair ? pair->predictor() : nullptr;
  const bool no_form = of_pairs && !of_pairs->predicts(law());
  return no_form ? default_predictor(law()) : of_pairs;
}

const SharedStep &FixWallGranCfpm::shared_step() const {
  return static_cast<const PairGranCfpm *>(force->pair)->shared_step();
}

} // namespace cfpm::liggghts
