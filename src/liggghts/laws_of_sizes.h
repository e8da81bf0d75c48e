// SPDX-License-Identifier: GPL-2.0-or-later
// How what the host's normal models make of a contact goes with radii and masses, see core/method/made_steps.h: its
// models are asked about two materials once, not about every contact.
#pragma once

#include "host_contact_models.h"

#include "core/contact/parameter_cache.h"
#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"
#include "core/law/pair_material.h"
#include "core/method/conventional/limited_spring.h"
#include "core/numbers/fifth_root.h"

#include <cmath>
#include <type_traits>

namespace cfpm::liggghts {

/// The law of a normal model of the host and the tangential models beside it: which powers of the
/// overlap its four coefficients go with. Coefficients: the same as the host computes it.
template <int Normal> struct LawOf;
template <> struct LawOf<LIGGGHTS::ContactModels::HOOKE> {
  using type = LinearLaw;
  template <class R> using Coefficients = HookeCoefficients<R>;
};
template <> struct LawOf<LIGGGHTS::ContactModels::HOOKE_STIFFNESS> : LawOf<LIGGGHTS::ContactModels::HOOKE> {};
template <> struct LawOf<LIGGGHTS::ContactModels::HERTZ> {
  using type = HertzMindlinLaw<DampingExponent::quarter>;
  template <class R> using Coefficients = HertzCoefficients<R>;
};
template <> struct LawOf<LIGGGHTS::ContactModels::HERTZ_STIFFNESS> {
  using type = HertzMindlinLaw<DampingExponent::half>;
  template <class R> using Coefficients = HertzStiffnessCoefficients<R>;
};

template <class R> [[gnu::always_inline]] inline R reduced_radius(const R &radius_i, const R &radius_j) {
  return radius_i * radius_j / (radius_i + radius_j);
}

/// Gives the law of two bodies, as the host's models make it. Law: see LawOf.
template <class Law> class HostLaw {
public:
  virtual Law law_of(const ContactPartners &partners) = 0;

protected:
  ~HostLaw() = default;
};

/// A law of the host as made_steps.h wants it, for pairs. Law: see LawOf; what depends on it alone is compiled once for
/// models that share it.
template <class Law> struct LawOfHost {
  HostLaw<Law> &host;
  bool of_materials;     ///< of linear models, whether it is hooke
  bool absolute_damping; ///< whether it does not go with the mass, which is a setting of hooke/stiffness

  Law operator()(const ContactPartners &p) const { return host.law_of(p); }

  /// Where all factors below are 1.
  PairMaterial<double> material(int type_i, int type_j) const {
    const Law unit = host.law_of(of_unit_size(type_i, type_j));
    return {unit.normal_stiffness,   unit.normal_damping, unit.tangential_stiffness,
            unit.tangential_damping, unit.friction,       unit.least_force};
  }

  template <class R> [[gnu::always_inline]] auto law(const PairMaterial<R> &material, const PairSizes<R> &sizes) const {
    using std::sqrt;
    using LawOver = typename Law::template Over<R>;
    const R mass = sizes.reduced_mass;
    const R radius = reduced_radius(sizes.radius_i, sizes.radius_j);
    if constexpr (Law::law_kind == LawKind::linear) {
      if (!of_materials) return material.template law<LawOver>(1.0, absolute_damping ? R(1.0) : mass);
      // as stiff as a Hertz contact at the characteristic velocity: with R^(2/5) m^(1/5)
      const R fifth = radius * radius * mass;
      const R inverse = inverse_fifth_root(fifth);
      const R stiffness = fifth * ((inverse * inverse) * (inverse * inverse));
      return material.template law<LawOver>(stiffness, sqrt(R(stiffness * mass)));
    } else {
      const R area = sqrt(radius);
      constexpr bool of_restitution = std::is_same_v<Law, LawOf<LIGGGHTS::ContactModels::HERTZ>::type>;
      return material.template law<LawOver>(area, of_restitution ? R(sqrt(R(area * mass))) : R(area * mass));
    }
  }
};

/// What gives a ForceOfInstant its parameters and makes their numbers, both to the last bit those of the host: not with
/// hooke, which takes a power of each contact. Host: a contact model.
template <int Normal, class Host> struct InstantLawOfHost {
  Host &host;
  bool absolute_damping; ///< see LawOfHost
  double dt;             ///< by which springs move on [s]

  template <class R> using Material = typename LawOf<Normal>::template Coefficients<R>;
  template <class R> using Step = LimitedSpring<LawOf<Normal>::template Coefficients, R>;

  const auto &operator()(const ContactPartners &p) const { return host.parameters_of_instant(p, dt); }
  const InstantLawOfHost &maker() const { return *this; }

  Material<double> material(int type_i, int type_j) const { return host.coefficients_of(of_unit_size(type_i, type_j)); }
  template <class R>
  [[gnu::always_inline]] bool make(const Material<R> &material, const PairSizes<R> &sizes, Step<R> &step) const {
    step = {material, dt};
    if constexpr (Normal == LIGGGHTS::ContactModels::HOOKE_STIFFNESS) {
      BasicLinearLaw<R> &law = step.coefficients.law;
      const R factor = absolute_damping ? R(1.0) : sizes.reduced_mass;
      law.normal_damping = factor * law.normal_damping;
      law.tangential_damping = factor * law.tangential_damping;
    } else {
      step.coefficients.reduced_radius = reduced_radius(sizes.radius_i, sizes.radius_j);
      step.coefficients.reduced_mass = sizes.reduced_mass;
    }
    return true;
  }
};

} // namespace cfpm::liggghts
