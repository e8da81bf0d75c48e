// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact_geometry.h"

#include <algorithm>

namespace cfpm {

/// The overlap at which a contact, at rest, would have the mean force that really acts over the step [m].
///
/// A contact at rest overlaps by more than the load over the stiffness: its mean force over a step, not the force of
/// its overlap, carries the load. Whoever takes a force, an area or a stiffness from the overlap would see too much.
/// The law at rest, kn d^a1, has the mean force F in place of its force f now at d (F/f)^(1/a1), which tends to d with
/// the step. Where the law has no force now that pushes, as late in a rebound, there is nothing to compare, and the
/// overlap stays.
///
/// M: a method; parameters: what its parameters() gives for the bodies; normal: what its normal() makes of the contact.
template <class M, class Parameters>
[[gnu::always_inline]] inline double equivalent_overlap(const M &method, const Parameters &parameters,
                                                        const typename M::Normal &normal, const ContactGeometry &g) {
  const double force_now = method.force_now(parameters, normal, g);
  if (!(force_now > 0.0)) return g.overlap;
  return g.overlap * M::Law::overlap_factor(std::max(0.0, normal.mean() / force_now));
}

} // namespace cfpm
