// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host_heat.h"

namespace cfpm::liggghts {

/// fix heat/gran/conduction/cfpm and heat/gran/cfpm: the host's heat conduction between spheres through contact areas
/// that belong to the forces between them. At rest the method enlarges the overlaps from which the host takes them.
class FixHeatGranCfpm : public LAMMPS_NS::FixHeatGranCond {
public:
  FixHeatGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  void init() override;
  void post_force(int vflag) override;
  void cpl_evaluate(LAMMPS_NS::ComputePairGranLocal *caller) override;

private:
  /// Whether the host's loop is right, as areas do not come from overlaps, or overlaps are not enlarged.
  bool host_loop_is_right() const;
  template <class Give> void conduct(const Give &give);
  double contact_area(int i, int j, double overlap) const;

  bool areas_from_overlaps_ = true;
};

} // namespace cfpm::liggghts
