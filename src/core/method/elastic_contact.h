// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace cfpm {

/// What the springs of a contact hold, as far as a method knows of it.
struct ElasticContact {
  double energy;               ///< of the normal one [J]
  double tangential_stiffness; ///< [N/m], 0 without tangential spring
};

} // namespace cfpm
