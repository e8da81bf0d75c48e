// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>

namespace cfpm {

/// How many contacts each particle had in the step before: as a method that gives impulses knows of the other
/// contacts while it looks at one.
struct Crowd {
  const double *contacts = nullptr; ///< null: nobody had any
  double split = 0.0;               ///< c, from 0 to 1

  /// Of a particle, how many others hold it besides a contact, over its mass [1/kg]. The contact itself is taken to be
  /// one of those of the step before; in the step in which it begins that is one too few.
  double others(int i, double mass) const { return contacts ? std::max(0.0, contacts[i] - 1.0) / mass : 0.0; }
  /// What each contact sees of the mass of particle i with n contacts: m over 1 + c (n - 1) [kg].
  double share(int i, double mass) const {
    return contacts && split > 0.0 ? mass / (1.0 + split * std::max(0.0, contacts[i] - 1.0)) : mass;
  }
};

/// How many times as strong as alone a contact is felt where the others that hold its bodies act with it: each of them
/// adds m*/m of the body times the cosine between the two, 1/2 on the mean. 1 for an isolated contact. others: of both
/// bodies together, see Crowd [1/kg]; reduced_mass: m* [kg].
/// R: double, or a Pack of several contacts' numbers.
template <class R> [[gnu::always_inline]] inline R crowding(const R &others, const R &reduced_mass) {
  return 1.0 + 0.5 * reduced_mass * others;
}

} // namespace cfpm
