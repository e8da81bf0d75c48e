// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_contacts.h"

#include "contacts_of_law.h"

#include <algorithm>
#include <utility>

namespace cfpm::lammps {

namespace {

using SelfSimilar = HertzMindlinLaw<DampingExponent::quarter>;

template <class Law> std::unique_ptr<PredictedContacts> make(const Method &method, LawOfPartners<Law> law_of) {
  return std::make_unique<ContactsOfLaw<Law, LawOfPartners<Law>, GranularMethods>>(method, std::move(law_of));
}

} // namespace

bool predicts_granular(const Method &method, LawKind kind) {
  const auto &all = GranularMethods::table;
  return method.predicts(kind) && std::find(all.begin(), all.end(), &method) != all.end();
}

std::string names_of_granular_methods(LawKind kind) {
  std::string names;
  for (const Method *method : GranularMethods::table)
    if (method->predicts(kind)) names += (names.empty() ? "" : ", ") + std::string(method->name);
  return names;
}

std::unique_ptr<PredictedContacts> make_granular_contacts(const Method &method, LawKind kind,
                                                          LawOfPartners<GranularLaw> law_of) {
  if (kind == LawKind::linear)
    return make<LinearLaw>(method, [law_of](const ContactPartners &p) { return as_linear(law_of(p)); });
  if (kind == LawKind::self_similar)
    return make<SelfSimilar>(method, [law_of](const ContactPartners &p) { return as_self_similar(law_of(p)); });
  return make<GranularLaw>(method, std::move(law_of));
}

} // namespace cfpm::lammps
