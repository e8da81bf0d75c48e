// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/vec3.h"

namespace cfpm {

/// What a method makes of a contact over a step, before levers: on the first body, the second gets the opposite force.
struct MeanForce {
  Vec3 force;            ///< [N]
  Vec3 torque_per_lever; ///< n cross friction: the torque on either body is minus its lever times this [N]
  Vec3 shift{};          ///< see ContactAction [kg m]
};

} // namespace cfpm
