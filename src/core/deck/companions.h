// SPDX-License-Identifier: GPL-2.0-or-later
// Which fixes may act beside predicted contacts. A mean force over the coming step and a force at one instant cannot be
// told apart by their receiver, so a wrong combination would run and be wrong.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace cfpm {

/// A fix of a deck, as far as these rules see it.
struct Companion {
  enum class Role {
    other,
    integrator,         ///< fix nve/cfpm, which does the step that the pair style is made for
    foreign_integrator, ///< moves particles by the forces that it finds
    rigid_bodies,       ///< likewise bodies of several particles
    prescribed_motion,  ///< moves particles and reads no force
    predicted_wall,     ///< fix wall/gran/cfpm with a method that predicts
    conventional_wall,  ///< the same with forces of one instant
    foreign_wall,       ///< another granular wall
    changes_time_step
  };
  std::string name; ///< for messages, as "fix nve/sphere (id 1)"
  Role role;

  bool integrates() const {
    return role == Role::integrator || role == Role::foreign_integrator || role == Role::prescribed_motion;
  }
};

/// The first fix that moves particles by forces, where fix nve/cfpm moves none: its name, else "".
inline std::string sole_mover(const std::vector<Companion> &fixes) {
  std::string first;
  for (const Companion &fix : fixes) {
    if (fix.role == Companion::Role::integrator) return "";
    if (first.empty() && (fix.role == Companion::Role::foreign_integrator || fix.role == Companion::Role::rigid_bodies))
      first = fix.name;
  }
  return first;
}

/// What is wrong with a pair style gran/cfpm among these fixes, in their order, or "" if nothing is.
/// predicted: whether its forces are; share_particles(k, l): whether two fixes act on a particle in common, asked on
/// all ranks in the same order.
template <class ShareParticles> std::string wrong_companion(const std::vector<Companion> &fixes, bool predicted,
                                                            const ShareParticles &share_particles) {
  using Role = Companion::Role;
  bool moved = false;
  for (std::size_t k = 0; k < fixes.size(); ++k) {
    const Companion &fix = fixes[k];
    if (!predicted) {
      if (fix.role == Role::predicted_wall)
        return fix.name + ": predicted beside a pair style with 'predict none'; use the same for both";
      continue;
    }
    moved = moved || fix.role == Role::integrator;
    if (fix.role == Role::changes_time_step)
      return fix.name + ": changes the time step between a prediction and its use; it cannot be used with pair_style "
                        "gran/cfpm";
    if (fix.role == Role::conventional_wall)
      return fix.name + ": 'predict none' at a wall beside predicted pairs; use the same for both";
    if (fix.role == Role::foreign_wall)
      return fix.name + ": not predicted, beside pair_style gran/cfpm; expected fix wall/gran/cfpm with a predictor";
    if (fix.role == Role::foreign_integrator)
      return fix.name + ": would integrate step-mean forces as forces of one instant; expected fix nve/cfpm beside "
                        "pair_style gran/cfpm";
    if (fix.role == Role::rigid_bodies)
      return fix.name + ": moves bodies of several particles, which have no predicted form; expected single particles "
                        "and fix nve/cfpm beside pair_style gran/cfpm, or the host's own styles";
    if (!fix.integrates()) continue;
    for (std::size_t l = 0; l < k; ++l)
      if (fixes[l].integrates() && share_particles(k, l))
        return fix.name + ": integrates particles that " + fixes[l].name + " integrates too; expected disjoint groups";
  }
  if (predicted && !moved)
    return "pair_style gran/cfpm: its step-mean forces need the matching integrator; expected 'fix ID group nve/cfpm'";
  return "";
}

} // namespace cfpm
