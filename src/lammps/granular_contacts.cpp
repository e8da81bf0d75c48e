// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_contacts.h"

#include "contacts_of_law.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace cfpm::lammps {

namespace {

using SelfSimilar = HertzMindlinLaw<DampingExponent::quarter>;
using Viscoelastic = HertzMindlinLaw<DampingExponent::half>;

/// With what else a law has of which nothing is known.
template <class R> struct MaterialOfAnyLaw {
  GranularMaterial<R> forces;
  BasicAreaSpring<R> area_spring;
  AdhesiveMaterial<R> adhesion;
};

/// Law of two bodies, see made_steps.h. Law: what is known of it.
template <class Law> struct LawOfGranular {
  template <class R> using Material =
      std::conditional_t<Law::law_kind == LawKind::any, MaterialOfAnyLaw<R>, GranularMaterial<R>>;

  std::shared_ptr<const GranularPairs> coefficients;

  Material<double> material(int type_i, int type_j) const {
    const GranularCoefficients &c = of_types(*coefficients, type_i, type_j);
    if constexpr (Law::law_kind == LawKind::any)
      return {material_of(c), area_spring_of(c), adhesion_of(c)};
    else
      return material_of(c);
  }
  template <class R>
  [[gnu::always_inline]] auto law(const MaterialOfAnyLaw<R> &material, const PairSizes<R> &sizes) const {
    BasicGranularLaw<R> law = granular_law(material.forces, sizes);
    law.area_spring = material.area_spring;
    law.adhesion = material.adhesion.of(sizes);
    return law;
  }
  template <class R>
  [[gnu::always_inline]] auto law(const GranularMaterial<R> &material, const PairSizes<R> &sizes) const {
    const BasicGranularLaw<R> law = granular_law(material, sizes);
    if constexpr (Law::law_kind == LawKind::linear)
      return as_linear(law);
    else if constexpr (Law::law_kind == LawKind::self_similar)
      return as_self_similar(law);
    else
      return as_viscoelastic(law);
  }
  Law operator()(const ContactPartners &p) const { return law(material(p.type_i, p.type_j), sizes_of(p)); }
};

/// Of one kind of pairs in one row, as at a wall.
TurnResistances turn_resistances_of(const GranularPairs &pairs) {
  using Resistance = TurnResistances::Resistance;
  if (pairs.size() == 1) return {1, {turn_resistance_of(pairs.begin()->second)}};
  int rows = 0;
  for (const auto &[types, c] : pairs) rows = std::max(rows, types.second + 1);
  const auto width = static_cast<std::size_t>(rows);
  std::vector<Resistance> by_types(width * width);
  const auto place = [&](int i, int j) -> Resistance & {
    return by_types[static_cast<std::size_t>(i) * width + static_cast<std::size_t>(j)];
  };
  for (const auto &[types, c] : pairs)
    place(types.first, types.second) = place(types.second, types.first) = turn_resistance_of(c);
  return {rows, std::move(by_types)};
}

BesideForces beside_forces(const GranularPairs &pairs) {
  BesideForces beside;
  beside.wider_history = ask_for_wider_history(pairs);
  if (std::any_of(pairs.begin(), pairs.end(), [](const auto &p) { return p.second.resists_turns(); }))
    beside.turn_resistances = turn_resistances_of(pairs);
  return beside;
}

template <class Law>
std::unique_ptr<PredictedContacts> make(const Method &method, std::shared_ptr<const GranularPairs> coefficients) {
  return std::make_unique<ContactsOfLaw<Law, LawOfGranular<Law>, GranularMethods>>(
      method, LawOfGranular<Law>{coefficients}, [coefficients] { return beside_forces(*coefficients); });
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
