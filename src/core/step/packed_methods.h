// SPDX-License-Identifier: GPL-2.0-or-later
// Whose contacts can be computed in packs: those that are found where they overlap, of the paper's predictors,
// those that have forces of one instant, and of impulses those in crowds. Said once to code that is compiled for a
// method, and once to code that is not.
#pragma once

#include "core/contact/parameter_cache.h"
#include "core/law/law_kind.h"
#include "core/method/forces/mean_of_two_forces.h"
#include "core/method/method.h"

#include <type_traits>
#include <utility>

namespace cfpm {

/// M: a method as a loop has it.
template <class M> using ParametersOf = std::decay_t<decltype(std::declval<const M &>().parameters(ContactPartners{}))>;

/// Parameters with those numbers that contacts in a crowd are computed from.
template <class Parameters> struct InCrowd {
  template <class R> using Step = typename Parameters::template CrowdStep<R>;
};
/// What has the numbers that packs are made of.
template <class M> using PackedParametersOf =
    std::conditional_t<M::wants_crowd, InCrowd<ParametersOf<M>>, ParametersOf<M>>;

/// Whether it says what a pack of contacts does and has parameters that are numbers alone, of which packs are made.
template <class M, class = void> inline constexpr bool has_packs = false;
template <class M> inline constexpr bool
    has_packs<M, std::void_t<typename M::Packed, typename PackedParametersOf<M>::template Step<double>>> = true;

/// begins_inside: whether contacts do, see begins_inside().
inline bool is_packed(const Method &method, LawKind law, bool begins_inside) {
  return !method.predicted || (method.predicts(law) && (method.wants_crowd || !begins_inside));
}

} // namespace cfpm
