// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "host.h"
#include "method_arguments.h"
#include "predicted_contacts.h"

#include "core/law/law_kind.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cfpm::lammps {

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
  /// Of two bodies that meet at that speed [m/s], on which it has no influence for a linear law; empty if not known.
  virtual std::optional<Collision> collision(const ContactPartners &partners, double impact_speed) const = 0;

  virtual const char *host_style() const = 0;
  /// The arguments of pair_style that the host's style is to be given.
  virtual std::vector<std::string> for_host_style() const = 0;
  /// Values of a contact in a history, of which those of the law come first, then those of the spring.
  int history_size(const Method &method) const { return law_history() + method.spring_values; }
  virtual int law_history() const = 0;
  /// Makes the history of the host's style, which has been given its arguments, that large; false if something is not
  /// where it is expected.
  virtual bool set_history_size(LAMMPS_NS::Pair &host_style, int size) const = 0;

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
