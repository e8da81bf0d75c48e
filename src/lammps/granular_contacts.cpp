// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_contacts.h"

#include "contacts_of_law.h"

#include <algorithm>
#include <utility>

namespace cfpm::lammps {

namespace {

using SelfSimilar = HertzMindlinLaw<DampingExponent::quarter>;
using Viscoelastic = HertzMindlinLaw<DampingExponent::half>;

/// Law of two bodies, see made_steps.h. Law: what is known of it.
template <class Law> struct LawOfGranular {
  template <class R> using Material = GranularMaterial<R>;

  std::shared_ptr<const GranularPairs> coefficients;

  GranularMaterial<double> material(int type_i, int type_j) const {
    return material_of(of_types(*coefficients, type_i, type_j));
  }
  template <class R>
  [[gnu::always_inline]] auto law(const GranularMaterial<R> &material, const PairSizes<R> &sizes) const {
    const BasicGranularLaw<R> law = granular_law(material, sizes);
    if constexpr (Law::law_kind == LawKind::linear)
      return as_linear(law);
    else if constexpr (Law::law_kind == LawKind::self_similar)
      return as_self_similar(law);
    else if constexpr (Law::law_kind == LawKind::viscoelastic)
      return as_viscoelastic(law);
    else
      return law;
  }
  Law operator()(const ContactPartners &p) const { return law(material(p.type_i, p.type_j), sizes_of(p)); }
};

template <class Law>
std::unique_ptr<PredictedContacts> make(const Method &method, std::shared_ptr<const GranularPairs> coefficients) {
  return std::make_unique<ContactsOfLaw<Law, LawOfGranular<Law>, GranularMethods>>(
      method, LawOfGranular<Law>{std::move(coefficients)});
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
                                                          std::shared_ptr<const GranularPairs> coefficients) {
  if (kind == LawKind::linear) return make<LinearLaw>(method, std::move(coefficients));
  if (kind == LawKind::self_similar) return make<SelfSimilar>(method, std::move(coefficients));
  if (kind == LawKind::viscoelastic) return make<Viscoelastic>(method, std::move(coefficients));
  return make<GranularLaw>(method, std::move(coefficients));
}

} // namespace cfpm::lammps
