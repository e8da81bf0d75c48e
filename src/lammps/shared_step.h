// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../core/pair_loop.h"

namespace cfpm::lammps {

/// What pairs, walls and the integrator share over a step; all but the number of particles if impulses are given.
struct SharedStep {
  int particles = 0;          ///< of this rank when the forces were evaluated
  VectorRows shift;           ///< of the position of each, see MeanForce [kg m]
  Crowd crowd;                ///< with neighbours on other ranks
  double *contacts = nullptr; ///< counted in this step; null if nobody gives impulses
  bool onset = true;          ///< whether contacts begin inside a step
  double ahead = 0.0;         ///< see ListedPairs [m]
};

} // namespace cfpm::lammps
