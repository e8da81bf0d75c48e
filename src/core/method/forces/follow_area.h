// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/tangential_spring.h"
#include "core/contact/wider_history.h"
#include "core/law/follows_area.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// Of the spring that a host keeps: by a factor, and what has been kept of the area.
[[gnu::always_inline]] inline double area_before(const StoredSpring &spring) {
  return std::fabs(spring.values[WiderHistory::area]);
}
[[gnu::always_inline]] inline void stretch(const StoredSpring &spring, double factor, double area) {
  set(factor * vec3(spring.values), spring.values);
  spring.values[WiderHistory::area] = area;
}

/// Before friction reads a spring: makes it one that counts with the area of now. Where no contact has such springs
/// nothing is kept of the area either. Spring: a StoredSpring that advances, or what reads and writes those of a pack.
template <class Law, class R, class Spring> [[gnu::always_inline]] inline void
follow_area([[maybe_unused]] const Law &law, [[maybe_unused]] const R &overlap, [[maybe_unused]] const Spring &spring) {
  if constexpr (follows_area<Law>) {
    if (!law.area_spring.any_follows()) return;
    const R root = Law::root_of(overlap);
    stretch(spring, law.area_spring.stretch(area_before(spring), root), root);
  }
}

} // namespace cfpm
