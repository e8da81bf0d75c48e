// SPDX-License-Identifier: GPL-2.0-or-later
// Whose contacts can be computed in packs: those of the paper's predictors with the linear law that are found where
// they overlap. Said once to code that is compiled for a method, and once to code that is not.
#pragma once

#include "core/contact/parameter_cache.h"
#include "core/law/law_kind.h"
#include "core/method/forces/linear_prediction.h"
#include "core/method/method.h"

#include <type_traits>
#include <utility>

namespace cfpm {

/// M: a method as a loop has it, such as MeanOfTwoForces.
template <class M> inline constexpr bool has_packs =
    !M::wants_onset &&
    std::is_same_v<decltype(std::declval<const M &>().parameters(ContactPartners{})), const LinearPrediction &>;

/// begins_inside: whether contacts do, see begins_inside().
inline bool is_packed(const Method &method, LawKind law, bool begins_inside) {
  return method.predicted && !method.wants_crowd && law == LawKind::linear && !begins_inside;
}

} // namespace cfpm
