// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "method_arguments.h"

#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"
#include "core/law/pair_material.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::lammps {

using HertzLaw = HertzMindlinLaw<DampingExponent::half>;

/// "hooke|hooke/nohistory|hertz Kn Kt gamma_n gamma_t xmu dampflag [limit_damping] [predict X]", as the host's styles
/// gran/hooke/history, gran/hooke and gran/hertz/history take it without the first word and the last two.
struct ContactArguments : MethodArguments {
  bool hertz = false;
  bool history = true;                     ///< friction has a spring
  double kn = 0.0;                         ///< [force/distance], hertz: [force/distance^2]
  double kt = 0.0;                         ///< likewise; 0 without history
  double gamma_n = 0.0;                    ///< [1/time], hertz: [1/(time distance)]
  double gamma_t = 0.0;                    ///< likewise; 0 with dampflag 0
  double xmu = 0.0;                        ///< Coulomb coefficient
  bool limit_damping = false;              ///< the normal force never pulls
  std::vector<std::string> for_host_style; ///< the words that the host's style is to be given
  std::vector<std::string> rest;           ///< the words behind the contact

  /// Values of a contact in a history: of the law, then of the spring.
  int history_size(const Method &solved_by) const { return law_history() + solved_by.spring_values; }
  int law_history() const { return hertz ? HertzLaw::history_values : LinearLaw::history_values; }
  /// One for all types.
  PairMaterial<double> material() const { return {kn, gamma_n, kt, gamma_t, xmu, least_force()}; }
  double least_force() const {
    if (limit_damping) return without_tension;
    return with_tension;
  }
  /// See right_from().
  bool damped_friction() const { return gamma_t > 0.0; }
  LawKind law() const { return hertz ? HertzLaw::law_kind : LinearLaw::law_kind; }
  /// Why energies of such contacts cannot be told, or "".
  std::string reason_against_energy(const Method &solved_by) const {
    if (history || solved_by.predicted) return "";
    return "with 'predict verlet' contacts of hooke/nohistory are not told of; expected predicted contacts";
  }
  /// The contact in the words of the host's pair styles and walls. Predicted contacts need its history to tell which
  /// of them go on.
  std::string host_model(bool predicted) const {
    if (hertz) return "hertz/history";
    return history || predicted ? "hooke/history" : "hooke";
  }
};

/// words: from the contact model on. Stops the run with a message on anything that is wrong in the contact;
/// what stands behind it, without "predict X" and its options, is left in rest. made: how the words came about.
ContactArguments read_contact_arguments(LAMMPS_NS::LAMMPS &lmp, const std::string &command, ContactOwner owner,
                                        const std::vector<std::string> &words, Command made = Command::named);

} // namespace cfpm::lammps
