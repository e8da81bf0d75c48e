// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace cfpm {

/// I/(m r^2) of a solid sphere, or in two dimensions of a disc.
constexpr double inertia_factor(int dimension) { return dimension == 2 ? 0.5 : 0.4; }

/// mt from m*: 1/mt = 1/m* + ri^2/Ii + rj^2/Ij = (1 + m r^2/I)/m* [kg]. R: double, or a Pack of several contacts'
/// numbers.
template <class R> [[gnu::always_inline]] constexpr R tangential_reduced_mass(const R &reduced_mass, int dimension) {
  return reduced_mass / (1.0 + 1.0 / inertia_factor(dimension));
}

} // namespace cfpm
