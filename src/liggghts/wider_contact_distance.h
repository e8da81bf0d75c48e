// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"

#include <algorithm>

namespace cfpm::liggghts {

/// The host's loops hand bodies that are apart to the contact model within contact_distance_factor of their radii. As
/// long as this lives they do it within at least that factor, of what is in their lists.
class WiderContactDistance {
public:
  WiderContactDistance(LAMMPS_NS::Neighbor &neighbor, double factor)
      : neighbor_(neighbor), kept_(neighbor.contactDistanceFactor) {
    neighbor.contactDistanceFactor = std::max(kept_, factor);
  }
  WiderContactDistance(const WiderContactDistance &) = delete;
  WiderContactDistance &operator=(const WiderContactDistance &) = delete;
  ~WiderContactDistance() { neighbor_.contactDistanceFactor = kept_; }

private:
  LAMMPS_NS::Neighbor &neighbor_;
  double kept_;
};

} // namespace cfpm::liggghts
