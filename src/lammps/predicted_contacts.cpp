// SPDX-License-Identifier: GPL-2.0-or-later
#include "predicted_contacts.h"

#include "contacts_of_law.h"

#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"
#include "core/law/pair_material.h"

#include <cmath>
#include <utility>

namespace cfpm::lammps {

namespace {

/// Law of two bodies, see made_steps.h: the host's damping goes with the reduced mass, both coefficients of a Hertz
/// contact with the square root of the reduced radius.
template <class Law> struct LawOfHost {
  PairMaterial<double> of_all_types;

  PairMaterial<double> material(int, int) const { return of_all_types; }
  template <class R> [[gnu::always_inline]] auto law(const PairMaterial<R> &material, const PairSizes<R> &sizes) const {
    using std::sqrt;
    R area = 1.0;
    if constexpr (Law::law_kind != LawKind::linear) area = sqrt(R(1.0 / (1.0 / sizes.radius_i + 1.0 / sizes.radius_j)));
    return material.template law<typename Law::template Over<R>>(area, area * sizes.reduced_mass);
  }
  Law operator()(const ContactPartners &p) const { return law(material(p.type_i, p.type_j), sizes_of(p)); }
};

} // namespace

ContactPartners at_wall(int type, double radius, double mass, double of_wall) {
  return {type, wall_type, radius, of_wall, mass};
}

Collision collision(const ContactArguments &arguments, const ContactPartners &partners, double impact_speed) {
  const double mass = partners.reduced_mass;
  if (arguments.hertz) {
    const HertzLaw law = LawOfHost<HertzLaw>{arguments.material()}(partners);
    return {hertz_contact_time(law.normal_stiffness, mass, impact_speed), true, restitution(law, mass)};
  }
  const LinearLaw law = LawOfHost<LinearLaw>{arguments.material()}(partners);
  return {contact_time(law.normal_stiffness, mass), false, restitution(law, mass)};
}

std::unique_ptr<PredictedContacts> make_predicted_contacts(const ContactArguments &arguments) {
  const auto make = [&](auto law_of) -> std::unique_ptr<PredictedContacts> {
    using Law = decltype(law_of(ContactPartners{}));
    return std::make_unique<ContactsOfLaw<Law, decltype(law_of)>>(*arguments.method, law_of);
  };
  if (arguments.hertz) return make(LawOfHost<HertzLaw>{arguments.material()});
  return make(LawOfHost<LinearLaw>{arguments.material()});
}

} // namespace cfpm::lammps
