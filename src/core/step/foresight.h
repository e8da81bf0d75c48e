// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts that begin inside a step are sought in the host's lists, of what was near a particle when they were made.
// Here it is watched whether the lists hold all that is near enough to be met in the coming step.
#pragma once

#include "core/numbers/vec3.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

namespace cfpm {

/// Moves of single particles in single steps that were longer than new lists reach. What such a particle meets beyond
/// is found when it overlaps, at the next step: as without onset, which is how conventional methods find all contacts.
struct LongMoves {
  long count = 0;       ///< of them
  long passing = 0;     ///< by more than the particle's radius: of a body in between nothing may be found at all
  double missing = 0.0; ///< reach that the longest one lacked [m]

  void add(double lacked, bool passes) {
    ++count;
    if (passes) ++passing;
    missing = std::max(missing, lacked);
  }

  /// For the log, when the first one comes; whom: the command.
  static std::string first(const std::string &whom, long step) {
    return whom + ": from step " + std::to_string(step) +
           " on, particles move farther in a step than neighbour lists reach; a contact that such a particle comes to "
           "there begins late, as with 'onset off'. The end of the run tells how many moves these were";
  }

  /// At the end of a run, of all ranks together.
  std::string text(const std::string &whom) const {
    char numbers[200];
    std::snprintf(numbers, sizeof numbers, "%ld moves of a particle in a step, %ld of them by more than its radius, ",
                  count, passing);
    char more[40];
    std::snprintf(more, sizeof more, "%.3g", 2.0 * missing); // half of the skin belongs to each of two particles
    return whom + ": " + numbers +
           "were longer than neighbour lists reach; contacts there began late, as with 'onset off'" +
           (passing > 0 ? ", or were passed by" : "") + "; expected a smaller timestep, or " + more +
           " more of skin in 'neighbor'";
  }
};

/// The particles of one rank, as they move on from where they were when the host listed its neighbours.
class Foresight {
public:
  /// What is to be done before the forces over the coming step.
  struct Look {
    int outdated = 0; ///< neighbours are to be listed anew
    int too_long = 0; ///< even new lists do not reach as far as a particle moves
  };

  /// Has them listed where they are, x: three values each [m].
  void list(const double *const *x, int count) {
    listed_at_.clear();
    if (count > 0) listed_at_.assign(x[0], x[0] + 3 * static_cast<std::size_t>(count));
  }

  /// Looks over the coming step dt [s]. reach(i): how far particle i may come from where it was listed before it can
  /// touch something that is not in its list, if others do not come farther than theirs [m].
  template <class Reach> Look look(const double *const *x, const double *const *v, const double *radius, int count,
                                   double dt, const Reach &reach) {
    Look look;
    const bool listed = listed_at_.size() == 3 * static_cast<std::size_t>(count);
    if (!listed) look.outdated = 1;
    for (int i = 0; i < count; ++i) {
      const Vec3 moved = listed ? vec3(x[i]) - vec3(&listed_at_[3 * static_cast<std::size_t>(i)]) : Vec3{};
      const Vec3 move = dt * vec3(v[i]);
      const double within = reach(i);
      // (a + b)^2 <= 2 (a^2 + b^2) spares most of them two roots
      if (within > 0.0 && 2.0 * (dot(moved, moved) + dot(move, move)) <= within * within) continue;
      const double length = norm(move);
      if (norm(moved) + length <= within) continue;
      if (!is_finite(move)) continue; // leads to no position, which is told
      look.outdated = 1;
      if (length <= within) continue;
      look.too_long = 1;
      long_moves_.add(length - within, length > radius[i]);
    }
    return look;
  }

  /// Those since they were last taken.
  LongMoves take_long_moves() {
    const LongMoves all = long_moves_;
    long_moves_ = {};
    return all;
  }

private:
  std::vector<double> listed_at_; ///< three values a particle
  LongMoves long_moves_;
};

} // namespace cfpm
