// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace cfpm {

/// What "predict impulse" of a pair style does, also at its walls.
struct ImpulseOptions {
  double split = 0.0; ///< c: a particle with n contacts gives each of them its mass over 1 + c (n - 1)
  bool onset = true;  ///< contacts begin inside a step
};

} // namespace cfpm
