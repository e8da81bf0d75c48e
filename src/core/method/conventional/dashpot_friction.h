// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/numbers/pack.h"
#include "core/numbers/vec3.h"

namespace cfpm {

/// Friction of a dashpot alone [N], at most Coulomb's limit. damping: [kg/s]; limit: [N]; velocity: at which the
/// surfaces slip [m/s]. R: double, or a Pack of several contacts' numbers.
template <class R> [[gnu::always_inline]] inline BasicVec3<R> dashpot_friction(const R &damping, const R &limit,
                                                                               const BasicVec3<R> &velocity) {
  const R speed = norm(velocity);
  return -select(speed != R(0.0), smaller(R(damping * speed), limit) / speed, R(0.0)) * velocity;
}

} // namespace cfpm
