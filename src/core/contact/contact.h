// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/contact/contact_geometry.h"
#include "core/contact/tangential_spring.h"
#include "core/numbers/vec3.h"

namespace cfpm {

/// A body i and a body j, or i and a wall, that touch at the beginning of a step or will before its end.
struct Contact {
  ContactGeometry geometry; ///< at the beginning, or where they touch
  double span;              ///< from there to the end of the step [s]
  double others;            ///< that hold its bodies, see Crowd [1/kg]
  StoredSpring spring;
};

/// What a contact gives over a step, before levers. R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicMeanForce {
  BasicVec3<R> force;            ///< its mean on i; on j acts the opposite [N]
  BasicVec3<R> torque_per_lever; ///< n cross friction, see couple() [N]
  /// What the displacement of i over the step is short of with the mean force acting all the time, times the mass; of j
  /// the opposite: the integral of the force times the time that is left, less dt^2/2 times its mean. 0 in the method
  /// of the paper [kg m].
  BasicVec3<R> shift{};

  /// Mean torque on a body about its centre. lever: from there to the contact point [m]
  [[gnu::always_inline]] BasicVec3<R> couple(const R &lever) const { return -lever * torque_per_lever; }
};

using MeanForce = BasicMeanForce<double>;

/// The same of two spheres.
template <class R> struct BasicPairForce {
  BasicMeanForce<R> mean;
  R lever_i;       ///< centre of i to the contact point [m]
  R lever_j;       ///< [m]
  R counted = 1.0; ///< 1 where it counts as a contact of its bodies, else 0
};

/// The same with a couple that resists rolling.
template <class R> struct BasicRollingPairForce {
  BasicPairForce<R> pair;
  BasicVec3<R> couple; ///< on i; on j acts the opposite [N m]
};

/// The same with couples that resist rolling and twisting, which hosts add in an order of their own.
template <class R> struct BasicTurningPairForce {
  BasicPairForce<R> pair;
  BasicVec3<R> rolling;  ///< on i; on j acts the opposite [N m]
  BasicVec3<R> twisting; ///< likewise
};

/// What a contact does to its bodies over a step. The mean force as the method has made it: copied part by part it
/// would go through memory, and the processor wait for it.
struct ContactAction {
  MeanForce mean;
  double normal_force; ///< the part of the force along the normal, positive where the contact pushes [N]
  bool touching;       ///< whether it counts as a contact of its bodies
};

} // namespace cfpm
