// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "wall_placement.h"

#include "core/numbers/vec3.h"

#include <vector>

namespace LAMMPS_NS {
class Domain;
class Region;
} // namespace LAMMPS_NS

namespace cfpm::lammps {

/// How far places are from the surface of a region of the host.
class RegionClearance {
public:
  /// As the region is in this step, after its prematch() if it moves.
  void look_at(LAMMPS_NS::Region &region, LAMMPS_NS::Domain &domain);
  /// Where it is.
  const WallPlacement &placement() const { return placement_; }
  /// Whether it is, of any place.
  bool is_known() const { return !shapes_.empty(); }
  /// From a place to the nearest point that a sphere may touch, or less: 0 where that is not known, so that the region
  /// is to be asked for contacts in every step. seen: as from the region; radius: of the sphere [m].
  double at(const Vec3 &seen, double radius) const;

private:
  std::vector<LAMMPS_NS::Region *> shapes_; ///< that it consists of; none where nothing is known of one
  WallPlacement placement_;
};

} // namespace cfpm::lammps
