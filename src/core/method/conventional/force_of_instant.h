// SPDX-License-Identifier: GPL-2.0-or-later
// The conventional method, "verlet": what acts over a step is the force of its beginning. The hosts' own styles compute
// it, and their order of operations is kept, so that the laws beside this file give their results to the last bit: a
// deck may go from one to the other at any step. (To rounding, where a host's compiler has fused multiplications with
// additions.)
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_geometry.h"
#include "core/contact/parameter_cache.h"
#include "core/law/coulomb.h"

#include <type_traits>
#include <utility>

namespace cfpm {

/// What a ForceOfInstant does with a pack of contacts, see compute_pack(). It has no other loop: where there are no
/// packs, it takes those of one contact.
struct PackedForceOfInstant {
  static constexpr bool takes_packs_of_one = true;

  template <Friction friction, class R, class Step, class Springs>
  [[gnu::always_inline]] static auto act(const Step &step, const BasicSpherePair<R> &pair, const Springs &springs) {
    return step.template act<friction>(pair, springs);
  }
};

/// Parameters of contacts with such a law, which holds the step too. L: LimitedWithDashpot, LimitedSpring ...
template <class L> struct ParametersOfInstant {
  using Law = L;
  template <class R> using Step = typename L::template Over<R>;

  L law;

  double dt() const { return law.dt; }
  const Step<double> &step() const { return law; }
};

/// In a loop over contacts. LawOf: law_of(partners) gives the ParametersOfInstant, or a reference to them that is valid
/// until the next call.
template <class LawOf> class ForceOfInstant {
public:
  using Law = typename std::decay_t<decltype(std::declval<const LawOf &>()(ContactPartners{}))>::Law;
  using Packed = PackedForceOfInstant;

  explicit ForceOfInstant(const LawOf &law_of) : law_of_(law_of) {}

  decltype(auto) parameters(const ContactPartners &partners) const { return law_of_(partners); }
  /// What makes those of contacts of any sizes, where it is known, see made_steps.h.
  template <class Of = LawOf> auto maker() const -> decltype(std::declval<const Of &>().maker()) {
    return law_of_.maker();
  }

private:
  const LawOf &law_of_;
};

} // namespace cfpm
