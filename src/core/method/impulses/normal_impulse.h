// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/linear_law.h"

#include <algorithm>
#include <cmath>

namespace cfpm {

/// That friction divides a contact time into where bodies collide: parts of a twelfth of the whole collision, and at
/// least four of them.
inline int parts_of_contact(double contact_time, double duration) {
  constexpr double of_collision = 12.0;
  constexpr double least = 4.0;
  return static_cast<int>(std::clamp(std::ceil(of_collision * contact_time / duration), least, of_collision));
}

/// What an isolated contact does along its normal over a span of time; nothing if it was released before.
/// R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicNormalImpulse {
  R impulse = 0.0;       ///< J, the integral of the force [N s]
  R time_moment = 0.0;   ///< M, of the force times the time left to the end of the span [N s^2]
  R contact_time = 0.0;  ///< how long the bodies were in contact [s]
  R force = 0.0;         ///< at the beginning [N]
  R mean_overlap = 0.0;  ///< while in contact, for a law whose tangential part depends on it [m]
  R closing_speed = 0.0; ///< at the beginning, as the contact counts it [m/s]
  R duration = 0.0;      ///< of the whole collision that it is a part of, from touch to release [s]
};

using NormalImpulse = BasicNormalImpulse<double>;

/// The same over a part of a contact.
struct NormalPart {
  double impulse;    ///< [N s]
  double overlap;    ///< its mean [m]
  double end_force;  ///< [N]
  LinearLaw law;     ///< what acts at the mean overlap, by which it sticks
  LinearLaw end_law; ///< at the overlap of the end
};

} // namespace cfpm
