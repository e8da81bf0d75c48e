// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace cfpm {

/// Contact laws by what is known of the isolated collision, each kind harder than the one before.
enum class LawKind {
  linear,       ///< its motion over a step is a linear map
  self_similar, ///< all its collisions are one, see hertz_trajectory.h
  viscoelastic, ///< its motion is analytic, see viscoelastic_motion.h
  any
};

} // namespace cfpm
