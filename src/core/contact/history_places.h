// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

namespace cfpm {

/// Where a host keeps what its contacts carry from step to step beside the tangential spring, counted from there on.
/// A place that nothing is kept at may be that of something else.
struct HistoryPlaces {
  static constexpr std::ptrdiff_t area = 3; ///< radius of the contact area before [m]
  std::ptrdiff_t rolling = 0;               ///< vector, the spring of rolling [m]
  std::ptrdiff_t twist = 0;                 ///< how far the bodies have turned about the normal [-]
};

} // namespace cfpm
