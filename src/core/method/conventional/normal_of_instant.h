// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/parameter_cache.h"
#include "core/law/law_kind.h"
#include "core/law/linear_law.h"
#include "core/method/elastic_contact.h"
#include "core/numbers/vec3.h"

#include <type_traits>
#include <utility>

namespace cfpm {

/// The normal part of what a ForceOfInstant or the host's own style has done, for who tells energies: to rounding what
/// acts there. LawOf: law_of(partners) gives a law of which at(overlap) is a LinearLaw, or one itself.
template <class LawOf> class NormalOfInstant {
public:
  using Law = std::decay_t<decltype(std::declval<const LawOf &>()(ContactPartners{}))>;
  static constexpr bool wants_onset = false;
  static constexpr bool wants_crowd = false;

  explicit NormalOfInstant(const LawOf &law_of) : law_of_(law_of) {}

  struct Normal {
    LinearLaw law;
    double force;
    double mean() const { return force; } ///< [N]
  };

  Law parameters(const ContactPartners &partners) const { return law_of_(partners); }

  Normal normal(const Law &law, const ContactGeometry &g, double, double) const {
    const LinearLaw now = at(law, g.overlap);
    return {now, now.limited(now.normal_force(g.overlap, g.closing_speed))};
  }

  Vec3 acts_along(const Normal &, const ContactGeometry &g) const { return g.normal; }
  ElasticContact elastic(const Law &law, const Normal &normal, const ContactGeometry &g) const {
    return {law.spring_energy(g.overlap), normal.law.tangential_stiffness};
  }
  /// The hosts keep the one that acts.
  Vec3 spring_now(const StoredSpring &stored, const ContactGeometry &) const { return vec3(stored.values); }

private:
  static LinearLaw at(const Law &law, [[maybe_unused]] double overlap) {
    if constexpr (Law::law_kind == LawKind::linear)
      return law;
    else
      return law.at(overlap);
  }

  const LawOf &law_of_;
};

} // namespace cfpm
