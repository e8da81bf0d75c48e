// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace cfpm {

/// Over which step crowds answer under impulses, see SoftInCrowd: after a change to a smaller one it goes over to that
/// by and by, so that a bed at rest rises to the smaller overlaps that belong to it without being kicked.
class CrowdStep {
public:
  /// A run of steps dt begins after one of larger steps before [s]. contact_time: the shortest, undamped [s]
  void soften(double before, double dt, double contact_time) {
    before_ = before;
    steps_ = std::ceil(contact_times * contact_time / dt);
    done_ = 0.0;
  }
  void end() { steps_ = 0.0; }

  /// For the next step, of dt [s]. It changes in stages, as contacts keep what they have computed for it.
  double next(double dt) {
    if (done_ >= steps_) return dt;
    const double left = 1.0 - std::floor(stages * done_ / steps_) / stages;
    ++done_;
    return dt * std::pow(before_ / dt, left);
  }

private:
  static constexpr double contact_times =
      400.0; ///< the slower, the less a deep bed swings; waves pass some hundred layers meanwhile
  static constexpr double stages = 256.0;

  double before_ = 0.0; ///< [s]
  double steps_ = 0.0;
  double done_ = 0.0;
};

} // namespace cfpm
