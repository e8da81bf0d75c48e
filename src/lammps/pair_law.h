// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"
#include "method_arguments.h"
#include "predicted_contacts.h"

#include "core/contact/history_places.h"
#include "core/law/law_kind.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cfpm::lammps {

using TypePairs = std::vector<std::pair<int, int>>;

/// The contact law of a pair style: what the deck says of it, the style of the host that has it, and its forces.
class PairLaw {
public:
  PairLaw() = default;
  PairLaw(const PairLaw &) = delete;
  PairLaw &operator=(const PairLaw &) = delete;
  virtual ~PairLaw() = default;

  /// "pair_style ...", for messages.
  virtual const char *command() const = 0;
  /// Takes over the arguments of pair_style, complete. Stops the run with a message on anything that is wrong in them.
  virtual MethodArguments read(LAMMPS_NS::LAMMPS &lmp, const std::vector<std::string> &words, Command made) = 0;
  virtual LawKind kind() const = 0;
  /// See right_from().
  virtual bool damped_friction() const = 0;
  /// What "predict auto" takes it for.
  virtual LawKind kind_for_auto() const { return kind(); }
  /// Of two bodies of any types that meet at that speed [m/s], on which it has no influence for a linear law. Of all
  /// pairs of types for which it is known.
  virtual std::vector<Collision> collisions(const ContactPartners &partners, double impact_speed) const = 0;

  /// Whether pair_coeff says anything of the law: then the host's style is made anew for predicted contacts, so that
  /// its history has what pair_coeff in force says alone.
  virtual bool has_coefficients() const { return false; }
  /// Whether such words ask the host's style for a larger history than predicted contacts have.
  virtual bool enlarges_history(const std::vector<std::string> & /*coefficients*/) const { return false; }
  /// pairs: of types, i <= j, for which the host has taken the words of that pair_coeff.
  virtual void take_coefficients(const std::vector<std::string> &, const TypePairs &) {}
  /// Before a run, with all coefficients known. Why the method cannot be used, or "".
  virtual std::string complete(int /*types*/, const Method &) { return ""; }

  /// The one to be had for that method.
  virtual std::string host_style(const Method &method) const = 0;
  /// The arguments of pair_style that the host's style is to be given.
  virtual std::vector<std::string> for_host_style() const = 0;
  /// Likewise of a pair_coeff: where contacts are predicted the host keeps their history all the same.
  virtual std::vector<std::string> for_host_style(const std::vector<std::string> &coefficients,
                                                  const Method & /*method*/) const {
    return coefficients;
  }
  /// Values of a contact in a history, of which those of the law come first, then those of the spring.
  virtual int history_size(const Method &method) const { return law_history() + method.spring_values; }
  /// That of the host's style, which may be larger, with so many types of particles.
  virtual int host_history_size(const Method &method, int /*types*/) const { return history_size(method); }
  virtual int law_history() const = 0;
  /// Of a contact in the history that the host's style keeps for forces of one instant, 0 if it keeps none: those of
  /// the law, of the spring, then what else there is.
  virtual int instant_history() const { return history_size(Verlet::method); }
  /// Of what else there is.
  virtual HistoryPlaces instant_places() const { return {}; }
  /// Makes the history of the host's style, which has been given its arguments, that large; false if something is not
  /// where it is expected.
  virtual bool set_history_size(LAMMPS_NS::Pair &host_style, int size) const = 0;
  /// Whether the host's style stores it under the number of its instance, so that in a restart file none is taken for
  /// one of another size.
  virtual bool numbers_histories() const { return true; }

  /// Why energies of the contacts cannot be told, or "". Where they can, predicted_contacts() tells them of any method.
  virtual std::string reason_against_energy(const Method &) const { return ""; }
  /// The method must be one that predicts.
  virtual std::unique_ptr<PredictedContacts> predicted_contacts(const Method &method) const = 0;
  /// Why forces of one instant are left to the host's style, as text behind "as", or "" if they are not.
  virtual std::string reason_for_host_style() const { return ""; }
  /// Adds what the host's style does in a step, to the last bit. dt: by which springs move on [s]; tally: empty, or
  /// called for every contact.
  virtual void add_instant_forces(const Particles &particles, const PairList &pairs, double dt,
                                  const Tally &tally) const = 0;
};

} // namespace cfpm::lammps
