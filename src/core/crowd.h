// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>

namespace cfpm {

/// How many contacts each particle had in the step before: as a method that gives impulses knows of the other
/// contacts while it looks at one.
struct Crowd {
  const double *contacts = nullptr; ///< null: nobody had any
  double split = 0.0;               ///< c, from 0 to 1

  /// Whether others hold particle i besides a contact.
  bool holds(int i) const { return contacts && contacts[i] > 1.0; }
  /// What each contact sees of the mass of particle i with n contacts: m over 1 + c (n - 1) [kg].
  double share(int i, double mass) const {
    return contacts && split > 0.0 ? mass / (1.0 + split * std::max(0.0, contacts[i] - 1.0)) : mass;
  }
};

} // namespace cfpm
