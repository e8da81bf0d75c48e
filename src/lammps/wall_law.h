// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "method_arguments.h"
#include "predicted_contacts.h"

#include "core/law/law_kind.h"

#include <memory>
#include <string>
#include <vector>

namespace cfpm::lammps {

/// The contact law of a wall: what its command says of it, and its forces.
class WallLaw {
public:
  WallLaw() = default;
  WallLaw(const WallLaw &) = delete;
  WallLaw &operator=(const WallLaw &) = delete;
  virtual ~WallLaw() = default;

  virtual LawKind kind() const = 0;
  /// See right_from().
  virtual bool damped_friction() const = 0;
  /// Of a sphere that meets the wall at that speed [m/s], see PairLaw::collisions().
  virtual std::vector<Collision> collisions(const ContactPartners &partners, double impact_speed) const = 0;

  /// Values of a contact in a history, of which those of the law come first, then those of the spring.
  virtual int history_size(const Method &method) const { return law_history() + method.spring_values; }
  virtual int law_history() const = 0;

  /// Why the method, one that predicts, cannot be used, or "".
  virtual std::string reason_against(const Method &method) const = 0;
  /// Why energies of the contacts cannot be told, or "", see PairLaw. method: also one of the host's wall.
  virtual std::string reason_against_energy(const Method &method) const = 0;
  /// Where there is no such reason.
  virtual std::unique_ptr<PredictedContacts> predicted_contacts(const Method &method) const = 0;

  /// The law in the words of the host's wall.
  virtual std::vector<std::string> for_host_wall() const = 0;
  /// Whether it is the host's wall that finds what is wrong in them.
  virtual bool is_checked_by_host() const { return false; }
};

/// What the command of a wall says.
struct WallArguments : MethodArguments {
  std::shared_ptr<const WallLaw> law;
  std::vector<std::string> shape;     ///< the words behind the law, see make_wall_surface()
  bool tells_contacts = false;        ///< "contacts" is among the words
  std::vector<std::string> heat = {}; ///< "temperature" and its value, for the host's wall; or empty
};

} // namespace cfpm::lammps
