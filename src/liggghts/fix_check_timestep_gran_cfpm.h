// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host_contact_models.h"

#include "fix_check_timestep_gran.h"

#include <string>

namespace cfpm::liggghts {

class PairGranCfpm;

/// What a fix check/timestep/gran is to do: its fractions, and the keywords behind them.
struct TimestepCheck {
  double of_rayleigh_time = 0.0;
  double of_hertz_time = 0.0;
  bool warns = true;
  bool stops = false;
};

/// fix check/timestep/gran/cfpm: what "-suffix cfpm" makes of fix check/timestep/gran, with the same arguments and
/// output. The fractions of the Rayleigh and Hertz times that decks allow are meant for a conventional step: predicted
/// contacts are checked against the limit of their method instead.
class FixCheckTimestepGranCfpm : public LAMMPS_NS::FixCheckTimestepGran {
public:
  FixCheckTimestepGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  void init() override;
  void end_of_step() override;

private:
  FixCheckTimestepGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg, const TimestepCheck &check);
  std::string exceeded_fractions();
  std::string exceeded_limits(const PairGranCfpm &pair);

  TimestepCheck check_;
  bool told_ = false; ///< in this run
};

} // namespace cfpm::liggghts
