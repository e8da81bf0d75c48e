// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "predicted_contacts.h"

#include "core/contact/turn_resistance.h"
#include "core/law/adhesion.h"
#include "core/law/granular_law.h"
#include "core/method/conventional/granular_sub_models.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cfpm::lammps {

/// What a pair_coeff of pair_style granular says of the contacts of two types, as far as they are predicted.
struct GranularCoefficients {
  enum class Normal { hooke, hertz };
  enum class Damping { velocity, mass_velocity, viscoelastic, tsuji, coeff_restitution };
  enum class Tangential { linear, mindlin };
  enum class Twisting { none, sds, marshall };

  Normal normal = Normal::hooke;
  double stiffness = 0.0;      ///< k of the force k d, or k (R* d)^(1/2) d of Hertz [N/m, Pa]
  double young = 0.0;          ///< of hertz/material and dmt [Pa], else 0
  double poisson = 0.0;        ///< likewise [-]
  bool adheres = false;        ///< dmt, else as hertz/material
  double surface_energy = 0.0; ///< of dmt [J/m^2]
  Damping damping = Damping::viscoelastic;
  double damping_coefficient = 0.0; ///< behind the stiffness, in the units of its model; of the last two a restitution
  double damping_ratio = 0.0;       ///< of these two: of the damping to (m* kn)^(1/2) [-]
  Tangential tangential = Tangential::linear;
  double tangential_stiffness = 0.0; ///< [N/m], of Mindlin k of k (R* d)^(1/2) [Pa]; below 0: of the material, NULL
  double tangential_damping = 0.0;   ///< over the normal one [-]
  double friction = 0.0;             ///< Coulomb coefficient [-]
  bool has_spring = true;            ///< in the tangent plane, though its stiffness may be 0
  bool keeps_force = false;          ///< mindlin/force and mindlin_rescale/force, see BasicAreaSpring
  bool rescales = false;             ///< mindlin_rescale and mindlin_rescale/force, likewise
  bool limit_damping = false;
  bool rolls = false;             ///< rolling sds
  double rolling_stiffness = 0.0; ///< [N/m]
  double rolling_damping = 0.0;   ///< [kg/s]
  double rolling_friction = 0.0;  ///< [-]
  Twisting twisting = Twisting::none;
  double twisting_stiffness = 0.0; ///< of sds, as these [N m]
  double twisting_damping = 0.0;   ///< [N m s]
  double twisting_friction = 0.0;  ///< [m]
  std::string unpredicted;         ///< the first sub-model without a predicted form, as it is written, else ""
  std::string unknown;             ///< likewise without a form of one instant here

  bool follows_area() const { return (keeps_force || rescales) && tangential_stiffness != 0.0; }
  bool resists_twisting() const { return twisting != Twisting::none; }
  bool resists_turns() const { return rolls || resists_twisting(); }
  /// "rolling sds", "twisting marshall", or "" if it does not.
  std::string resistance() const;
};

/// By pairs of types, i <= j; or of a wall, the same for all particles, as of two wall_type.
using GranularPairs = std::map<std::pair<int, int>, GranularCoefficients>;

/// Of types in any order, or of a type and wall_type.
const GranularCoefficients &of_types(const GranularPairs &pairs, int type_i, int type_j);

/// words: of a pair_coeff that the host has taken; first: of them behind the types.
GranularCoefficients read_granular_coefficients(const std::vector<std::string> &words, std::size_t first);

/// Of two types that have no pair_coeff in common: geometric means, but for the stiffness of two materials, as in
/// LAMMPS since 2023. Their sub-models must be the same, or no predicted form is left.
GranularCoefficients mixed(const GranularCoefficients &a, const GranularCoefficients &b);

GranularMaterial<double> material_of(const GranularCoefficients &coefficients);
BasicAreaSpring<double> area_spring_of(const GranularCoefficients &coefficients);
AdhesiveMaterial<double> adhesion_of(const GranularCoefficients &coefficients);
BasicTurnResistance<double> turn_resistance_of(const GranularCoefficients &coefficients);

/// What its forces of one instant have beside those of material_of().
GranularSubModels<double> sub_models_of(const GranularCoefficients &coefficients);
/// Whether there is any but rolling.
bool has_more_sub_models(const GranularCoefficients &coefficients);

/// Whether predicted contacts of any keep more than a tangential spring, see WiderHistory.
bool ask_for_wider_history(const GranularPairs &pairs);

/// Why energies of such contacts cannot be told, or "".
std::string reason_against_energy(const GranularPairs &pairs, const Method &method);

/// Which of them have a predicted form, for messages.
constexpr const char *predicted_sub_models = "hooke, hertz, hertz/material or dmt with linear_nohistory, "
                                             "linear_history or a mindlin, rolling sds, twisting sds or "
                                             "marshall";

/// Of two bodies.
GranularLaw law_of(const GranularCoefficients &coefficients, const ContactPartners &partners);

/// What is known of a law with these sub-models.
LawKind kind_of(const GranularCoefficients &coefficients);

/// Of two bodies that meet at that speed [m/s], which has no influence for hooke. All must be predicted.
Collision collision(const GranularCoefficients &coefficients, const ContactPartners &partners, double impact_speed);

} // namespace cfpm::lammps
