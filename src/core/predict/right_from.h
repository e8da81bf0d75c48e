// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>

namespace cfpm {

/// From how many steps per contact time, nt = tc/dt, results come out right, for each use that grains are put to. What
/// right means, and the numbers, are of the results of these commands, all with linear contacts.
struct RightFrom {
  static constexpr double unmeasured = 0.0; ///< there is no such result, and nothing is said

  double beds;     ///< density of packings within 0.5 % and two standard errors: ./cfpm validate packing, beyond
  double flows;    ///< discharge from a bin within two standard errors: ./cfpm validate discharge, beyond
  double agitated; ///< energy of a cooling gas within 3 % and two standard errors: ./cfpm validate agitated

  /// For a deck whose use is not known; of numbers that have all been measured.
  constexpr double for_any() const { return std::max({beds, flows, agitated}); }
};

/// Whether nt steps per contact are as many as a measured number of them. The step of a deck comes of rounded figures,
/// and no result is as sharp as that.
inline bool reaches(double nt, double right_from) { return nt >= 0.999 * right_from; }

} // namespace cfpm
