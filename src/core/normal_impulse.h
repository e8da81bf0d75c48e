// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace cfpm {

/// That a step in contact is divided into where bodies collide.
inline constexpr int parts_of_step = 4;

/// What an isolated contact does along its normal over a span of time; nothing if it was released before.
struct NormalImpulse {
  double impulse = 0.0;       ///< J, the integral of the force [N s]
  double moment = 0.0;        ///< M, of the force times the time left to the end of the span [N s^2]
  double contact_time = 0.0;  ///< how long the bodies were in contact [s]
  double force = 0.0;         ///< at the beginning [N]
  double end_force = 0.0;     ///< at the end, 0 if released [N]
  double mean_overlap = 0.0;  ///< while in contact, for a law whose tangential part depends on it [m]
  double closing_speed = 0.0; ///< at the beginning, as the contact counts it [m/s]
};

/// The same over a part of a contact.
struct NormalPart {
  double impulse;              ///< [N s]
  double overlap;              ///< its mean [m]
  double end_force;            ///< [N]
  double tangential_stiffness; ///< at the end, 0 without tangential spring [N/m]
};

} // namespace cfpm
