// SPDX-License-Identifier: GPL-2.0-or-later
// Cohesion that is part of a linear law: a pull that grows as the overlap softens the spring of the contact, and is
// predicted with it.
#pragma once

#include "host_contact_models.h"

#include <algorithm>

namespace cfpm::liggghts {

/// Whether a cohesion model of the host pulls in proportion to the overlap, nearly, and not where bodies are apart.
constexpr bool grows_with_overlap(int cohesion_id) {
  return cohesion_id == LIGGGHTS::ContactModels::COHESION_SJKR ||
         cohesion_id == LIGGGHTS::ContactModels::COHESION_SJKR2;
}

/// What of the pull of such a model is taken into the law, as a stiffness [N/m]: its slope at the touch. Not where
/// bodies would hardly repel each other any more. contact: the types, radii and kind of a contact, the rest of it is
/// overwritten; stiffness: of the law [N/m].
inline double predicted_cohesion(LIGGGHTS::ContactModels::CohesionModelBase &model,
                                 LIGGGHTS::ContactModels::SurfacesIntersectData contact, double stiffness) {
  constexpr double most = 0.75; // of the stiffness
  const double overlap = 1e-6 * contact.radi;
  contact.deltan = overlap;
  contact.r = (contact.is_wall ? contact.radi : contact.radi + contact.radj) - overlap;
  contact.area_ratio = 1.0;
  contact.en[0] = 1.0;
  contact.en[1] = contact.en[2] = 0.0;
  contact.contact_flags = nullptr;
  LIGGGHTS::ContactModels::ForceData i_forces;
  LIGGGHTS::ContactModels::ForceData j_forces;
  model.surfacesIntersect(contact, i_forces, j_forces);
  return std::min(most * stiffness, -i_forces.delta_F[0] / overlap);
}

} // namespace cfpm::liggghts
