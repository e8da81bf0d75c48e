// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/law/coulomb.h"
#include "core/method/equivalent_overlap.h"
#include "core/step/step_state.h"

#include <type_traits>

namespace cfpm {

/// For contacts that nothing presses together beside their law.
struct NoCohesion {};
inline constexpr NoCohesion no_cohesion{};

/// What a contact does to its bodies over the step: the one place for pairs and walls of all hosts. Moves the spring
/// on. M: the method, such as MeanOfTwoForces; parameters: what method.parameters() gives for the bodies;
/// cohesion(mean normal force [N], equivalent overlap [m]): what else presses the bodies together as far as Coulomb's
/// limit counts it [N], see equivalent_overlap().
template <Friction friction, class M, class Parameters, class Cohesion> [[gnu::always_inline]] inline ContactAction
act(const M &method, const Parameters &parameters, const Contact &c, const Cohesion &cohesion) {
  const auto normal = method.normal(parameters, c.geometry, c.span, c.others);
  double cohesive = 0.0;
  if constexpr (!std::is_same_v<Cohesion, NoCohesion>)
    cohesive = cohesion(normal.mean(), equivalent_overlap(method, parameters, normal, c.geometry));
  return {method.template mean_force<friction>(parameters, normal, c.geometry, c.span, c.spring, cohesive),
          normal.mean(), normal.in_contact()};
}

/// Beside force and couple a contact shifts its bodies and counts as one of theirs. sign: 1 for i, -1 for j.
template <class M> void share(StepState &step, int body, const ContactAction &action, double sign) {
  if constexpr (M::wants_crowd) add(sign * action.mean.shift, step.shift[body]);
  if (step.contact_counts && action.touching) ++step.contact_counts[body];
}

/// The same of a contact with a wall, which acts when what the pairs gave has been taken.
template <class M> void share_at_wall(StepState &step, int body, const ContactAction &action) {
  share<M>(step, body, action, 1.0);
  if (step.contact_counts) add(action.mean.force, step.contact_force[body]);
}

} // namespace cfpm
