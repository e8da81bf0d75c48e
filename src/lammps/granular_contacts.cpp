// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_contacts.h"

#include "contacts_of_law.h"

#include <utility>

namespace cfpm::lammps {

namespace {

using Predicting = MethodList<PredictedForce<Exact>, PredictedForce<Trapezoid>, PredictedForce<RungeKutta2>,
                              PredictedForce<RungeKutta4>, PredictedImpulse>;
using SelfSimilar = HertzMindlinLaw<DampingExponent::quarter>;
using Viscoelastic = HertzMindlinLaw<DampingExponent::half>;

template <class Law> std::unique_ptr<PredictedContacts> make(const Method &method, LawOfPartners<Law> law_of) {
  return std::make_unique<ContactsOfLaw<Law, LawOfPartners<Law>, Predicting>>(method, std::move(law_of));
}

} // namespace

std::unique_ptr<PredictedContacts> make_granular_contacts(const Method &method, LawKind kind,
                                                          LawOfPartners<GranularLaw> law_of) {
  if (kind == LawKind::linear)
    return make<LinearLaw>(method, [law_of](const ContactPartners &p) { return as_linear(law_of(p)); });
  if (kind == LawKind::self_similar)
    return make<SelfSimilar>(method, [law_of](const ContactPartners &p) { return as_self_similar(law_of(p)); });
  if (kind == LawKind::viscoelastic)
    return make<Viscoelastic>(method, [law_of](const ContactPartners &p) { return as_viscoelastic(law_of(p)); });
  return make<GranularLaw>(method, std::move(law_of));
}

} // namespace cfpm::lammps
