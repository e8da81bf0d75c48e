// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace cfpm {

/// Where contacts keep what some laws ask for beside the tangential spring, counted from there on. A host that lists
/// two particles in the other order turns the sign of all that it keeps of them but of number 3. So it does of what is
/// along the spring or a relative rotation; what has no sign is kept there, or is read without it.
struct WiderHistory {
  static constexpr int twist = 3;  ///< how far the bodies have turned about the normal [-]
  static constexpr int rolled = 4; ///< vector, about the tangent plane; see resisted_turn.h [-]
  static constexpr int area = 7;   ///< root of the overlap before, without its sign, see BasicAreaSpring [m^(1/2)]
  static constexpr int size = 8;
};

} // namespace cfpm
