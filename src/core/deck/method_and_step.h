// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/method/method.h"
#include "core/step/crowd_step.h"

#include <cmath>

namespace cfpm {

/// What a run has, and beds come to rest under: their overlaps under impulses depend on the step.
struct MethodAndStep {
  const Method *method = nullptr; ///< null: there was no run
  double dt = 0.0;                ///< [s]

  bool operator==(const MethodAndStep &other) const { return method == other.method && dt == other.dt; }
};

/// Whether crowds can go over from one run to the next by and by, see CrowdStep. A larger step cannot be held back so:
/// what is stiff over the step before would be unstable over it.
inline bool crowds_soften(const MethodAndStep &before, const MethodAndStep &now) {
  return before.method == &PredictedImpulse::method && now.method == before.method && now.dt < before.dt;
}

/// At the begin of a run. contact_time: the shortest, infinite without particles [s]
inline void begin_run(CrowdStep &crowds, const MethodAndStep &before, const MethodAndStep &now, double contact_time) {
  if (before == now) return; // what is on its way goes on
  if (crowds_soften(before, now) && std::isfinite(contact_time))
    crowds.soften(before.dt, now.dt, contact_time);
  else
    crowds.end();
}

} // namespace cfpm
