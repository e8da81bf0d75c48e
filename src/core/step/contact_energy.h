// SPDX-License-Identifier: GPL-2.0-or-later
// What an EnergyBudget asks of contacts: a pass of its own behind the one that made their forces, so that this need not
// know of it.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/law/coulomb.h"
#include "core/step/contact_kinds.h"
#include "core/step/energy_budget.h"
#include "core/step/made_chunk.h"
#include "core/step/pair_list.h"
#include "core/step/particles.h"
#include "core/step/step_state.h"
#include "core/step/touch.h"

#include <cmath>

namespace cfpm {

struct ContactEnergy {
  Vec3 normal_force; ///< mean over the step, on i [N]
  double normal;     ///< elastic energy at the beginning of the step [J]
  double tangential; ///< likewise
};

/// Of a contact that has acted; its spring is as this left it, and stays so. touched: whether the bodies overlapped at
/// the beginning of the step.
template <Friction friction, class M, class Parameters>
ContactEnergy energy_of(const M &method, const Parameters &parameters, const Contact &c, bool touched) {
  const auto normal = method.normal(parameters, c.geometry, c.span, c.others);
  ContactEnergy energy{normal.mean() * method.acts_along(normal, c.geometry), 0.0, 0.0};
  if (!touched) return energy;
  const ElasticContact elastic = method.elastic(parameters, normal, c.geometry);
  energy.normal = elastic.energy;
  if constexpr (has_spring(friction)) {
    const Vec3 spring = method.spring_now(c.spring, c.geometry);
    energy.tangential = 0.5 * elastic.tangential_stiffness * dot(spring, spring);
  }
  return energy;
}

/// Of all listed pairs. spring: how to read springs, with values left open. See add_pair_forces().
template <Friction friction, class M> void add_pair_energies(const Particles &particles, const PairList &pairs,
                                                             const StepState &step, StoredSpring spring,
                                                             const M &method, EnergyBudget &budget) {
  const Crowd crowd = M::wants_crowd ? step.crowd : Crowd{};
  const auto body = [&](int i) { return particles.body(i, crowd); };
  const bool made = makes_steps<M> && BodyClasses(particles.count, body).are_too_many();
  for (int ii = 0; ii < pairs.count; ++ii) {
    const int i = pairs.first[ii];
    for (int jj = 0; jj < pairs.neighbor_count[i]; ++jj) {
      const int j = pairs.neighbors[i][jj] & pairs.index_mask;
      const Vec3 separation = vec3(particles.x[i]) - vec3(particles.x[j]);
      Meeting meeting{separation, dot(separation, separation), step.dt};
      const double reach = M::Law::touch_distance(particles.radius[i], particles.radius[j]);
      const bool touched = meeting.squared < reach * reach;
      if (!touched) {
        if constexpr (!M::wants_onset) continue;
        if (!(meeting.squared < (reach + step.ahead) * (reach + step.ahead)) ||
            !move_to_touch(meeting, vec3(particles.v[i]) - vec3(particles.v[j]), reach))
          continue;
      }
      spring.values = pairs.spring(i, jj);
      spring.now = pairs.spring_now(i, jj);
      const Contact contact{touching_spheres(meeting.separation, std::sqrt(meeting.squared), particles.radius[i],
                                             particles.radius[j], particles.motion(i), particles.motion(j)),
                            meeting.span, particles.others(i, crowd) + particles.others(j, crowd), spring};
      const ContactEnergy energy =
          energy_of<friction>(method, parameters_of(method, partners(body(i), body(j)), made), contact, touched);
      budget.add_normal_force(i, energy.normal_force);
      const bool whole = j < particles.receiving; // else the other rank has the same contact
      if (whole) budget.add_normal_force(j, -energy.normal_force);
      budget.add_elastic(whole ? 1.0 : 0.5, energy.normal, energy.tangential);
    }
  }
}

} // namespace cfpm
