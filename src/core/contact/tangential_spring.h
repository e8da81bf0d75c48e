// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/law/coulomb.h"
#include "core/law/linear_law.h"
#include "core/numbers/vec3.h"

#include <cmath>

namespace cfpm {

/// Eq. 6 at one instant, before Coulomb's limit.
template <class R> [[gnu::always_inline]] inline BasicVec3<R>
sticking_friction(const R &stiffness, const R &damping, const BasicVec3<R> &spring, const BasicVec3<R> &slip_velocity) {
  return -stiffness * spring - damping * slip_velocity;
}

/// A tangential spring [m] slackened to Coulomb's limit [N] where it would pull harder.
template <class R> [[gnu::always_inline]] inline BasicVec3<R> spring_limited_alone(const BasicVec3<R> &spring,
                                                                                   const R &stiffness, const R &limit) {
  using std::sqrt;
  const R squared = dot(spring, spring);
  if (all_surely_stick(limit, stiffness * stiffness * squared)) return spring;
  return coulomb_factor(limit / (stiffness * sqrt(squared))) * spring;
}
/// The same of one that the limit holds with its dashpot: it is what is left of the limit beside that.
template <class R> [[gnu::always_inline]] inline BasicVec3<R> spring_limited_together(const BasicVec3<R> &spring,
                                                                                      const BasicLinearLaw<R> &law,
                                                                                      const BasicVec3<R> &slip_velocity,
                                                                                      const R &limit) {
  using std::sqrt;
  const R stiffness = law.tangential_stiffness;
  const BasicVec3<R> both = stiffness * spring + law.tangential_damping * slip_velocity;
  const R squared = dot(both, both);
  if (all_surely_stick(limit, squared)) return spring;
  const R too_much = coulomb_factor(limit / sqrt(squared)) - 1.0;
  return spring + select(R(0.0) < stiffness, too_much / stiffness, R(0.0)) * both;
}
/// Either, as the friction is.
template <Friction friction, class R> [[gnu::always_inline]] inline BasicVec3<R>
slackened(const BasicVec3<R> &spring, const BasicLinearLaw<R> &law, const BasicVec3<R> &slip_velocity, const R &limit) {
  if constexpr (friction == Friction::limited_together)
    return spring_limited_together(spring, law, slip_velocity, limit);
  else
    return spring_limited_alone(spring, law.tangential_stiffness, limit);
}

/// Where a host keeps the tangential spring of a contact, null without one, and how to read it.
struct StoredSpring {
  double *values;
  double dt;             ///< step that it leads by half, as an impulse lags: of the evaluation before this one [s]
  bool advance;          ///< false where a state is evaluated again
  double *now = nullptr; ///< of the last evaluation, where the method keeps it apart
};

/// The tangential spring, Eq. 7. Positions advance by the trapezoid of the velocities, so does the
/// slip; carrying the spring at mid-step, s(t + dt/2) = s(t) + w(t) dt/2, does that with one stored
/// vector (a leapfrog), and a contact first seen somewhere inside its first step starts with
/// w dt/2, the mean of what it may have slipped. R: double, or a Pack of several contacts' numbers.
template <class R> class BasicMidStepSpring {
public:
  /// stored: what the contact carries from step to step, zero for a new contact [m]; dt: of the step
  /// that it leads by half [s]
  BasicMidStepSpring(const BasicVec3<R> &stored, const R &dt) : stored_(stored), dt_(dt) {}

  /// Moves the spring on to the middle of the coming step and into the tangent plane of n, and
  /// slackens it where it would pull harder than Coulomb's limit [N], or with the dashpot would. Returns the spring at
  /// t. Inlined by order, like all that the loop over contacts asks of it, as mean_friction().
  template <Friction friction = Friction::spring_and_dashpot> [[gnu::always_inline]] BasicVec3<R>
  advance(const BasicLinearLaw<R> &law, const BasicVec3<R> &slip_velocity, const BasicVec3<R> &n, const R &limit) {
    const BasicVec3<R> half_step = 0.5 * dt_ * slip_velocity;
    const BasicVec3<R> spring = tangential_part(stored_ + dt_ * slip_velocity, n) - half_step;
    stored_ = slackened<friction>(spring, law, slip_velocity, limit) + half_step;
    return stored_ - half_step; // rounded as now() will round it
  }

  /// The spring at t, to the last bit what advance() returned for this t. A stored zero is no spring.
  [[gnu::always_inline]] BasicVec3<R> now(const BasicVec3<R> &slip_velocity) const {
    return stored_ == BasicVec3<R>{} ? BasicVec3<R>{} : stored_ - 0.5 * dt_ * slip_velocity;
  }

  /// The same spring at t, leading by half of another step from now on.
  [[gnu::always_inline]] void change_step(const BasicVec3<R> &slip_velocity, const R &dt) {
    if (!(stored_ == BasicVec3<R>{})) stored_ = now(slip_velocity) + 0.5 * dt * slip_velocity;
    dt_ = dt;
  }

  const BasicVec3<R> &stored() const { return stored_; }

private:
  BasicVec3<R> stored_;
  R dt_;
};

using MidStepSpring = BasicMidStepSpring<double>;

} // namespace cfpm
