// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/method/equivalent_overlap.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"

#include <cmath>
#include <vector>

namespace cfpm {

/// Two particles of a host that overlap.
struct PairOverlap {
  int i;
  int j;
  double overlap; ///< see equivalent_overlap() [m]
};

/// Of all listed pairs that overlap, in the order of the list, with the forces that they have in this step: for who
/// reads contacts of his own accord. To be asked while positions and velocities are those of the evaluation.
template <class M> std::vector<PairOverlap> equivalent_overlaps(const Particles &particles, const PairList &pairs,
                                                                const StepState &step, const M &method) {
  std::vector<PairOverlap> overlaps;
  const Crowd crowd = M::wants_crowd ? step.crowd : Crowd{};
  for (int ii = 0; ii < pairs.count; ++ii) {
    const int i = pairs.first[ii];
    for (int jj = 0; jj < pairs.neighbor_count[i]; ++jj) {
      const int j = pairs.neighbors[i][jj] & pairs.index_mask;
      const Vec3 separation = vec3(particles.x[i]) - vec3(particles.x[j]);
      const double squared = dot(separation, separation);
      const double reach = M::Law::touch_distance(particles.radius[i], particles.radius[j]);
      if (squared >= reach * reach) continue;
      const ContactGeometry g = touching_spheres(separation, std::sqrt(squared), particles.radius[i],
                                                 particles.radius[j], particles.motion(i), particles.motion(j));
      const auto &parameters = method.parameters(partners(particles.body(i, crowd), particles.body(j, crowd)));
      const auto normal =
          method.normal(parameters, g, step.dt, particles.others(i, crowd) + particles.others(j, crowd));
      overlaps.push_back({i, j, equivalent_overlap(method, parameters, normal, g)});
    }
  }
  return overlaps;
}

} // namespace cfpm
