// SPDX-License-Identifier: GPL-2.0-or-later
// The law of two bodies of any sizes: what belongs to their materials, and how it goes with radii and masses.
#pragma once

#include "core/numbers/pack.h"

namespace cfpm {

/// Two bodies that touch, apart from their materials. R: double, or a Pack of several contacts' numbers.
template <class R> struct PairSizes {
  R radius_i;     ///< [m]
  R radius_j;     ///< [m], of a wall its radius of curvature, see ContactPartners
  R reduced_mass; ///< m* [kg]
};

/// The coefficients of a law between two materials, each over its factor of the sizes. R: as above.
template <class R> struct PairMaterial {
  R normal_stiffness, normal_damping;
  R tangential_stiffness, tangential_damping;
  R friction;    ///< Coulomb coefficient mu [-]
  R least_force; ///< see without_tension [N]

  /// The law of bodies with these factors. LawOver: a law over R that consists of such coefficients.
  template <class LawOver> [[gnu::always_inline]] LawOver law(const R &of_stiffness, const R &of_damping) const {
    return {of_stiffness * normal_stiffness,
            of_damping * normal_damping,
            of_stiffness * tangential_stiffness,
            of_damping * tangential_damping,
            friction,
            least_force};
  }
};

} // namespace cfpm
