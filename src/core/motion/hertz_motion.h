// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/hertz_trajectory.h"
#include "core/numbers/fifth_root.h"
#include "core/numbers/pack.h"

#include <array>
#include <cmath>

namespace cfpm {

template <class R> [[gnu::always_inline]] inline R fourth_root(const R &a) {
  using std::sqrt;
  return sqrt(R(sqrt(a)));
}

/// The length l of a state, see HertzTrajectory, and its inverse, finite also where nothing acts.
template <class R> struct HertzSize {
  R size, per_size; ///< [m^(1/4)], [m^(-1/4)]
};
/// (|u|/r + d^(5/4))^(1/5), the fourth root of the overlap of a state at rest, nearly of the largest one of another.
/// per_rate: 1/r; overlap d >= 0 [m], its fourth root, closing speed u [m/s]
template <class R> [[gnu::always_inline]] inline HertzSize<R> hertz_size(const R &per_rate, const R &overlap,
                                                                         const R &fourth_root, const R &closing_speed) {
  using std::fabs;
  const R fifth = fabs(closing_speed) * per_rate + overlap * fourth_root;
  const R inverse = inverse_fifth_root(fifth);
  return {fifth * ((inverse * inverse) * (inverse * inverse)), inverse};
}

/// Where bodies are after a span in which they are in contact and then, once released, fly freely.
template <class R> struct BasicHertzFlight {
  R overlap;       ///< at the end of the span, negative where they are apart [m]
  R closing_speed; ///< [m/s]
  R contact_time;  ///< [s]
  R mean_overlap;  ///< while in contact [m]
  R phase_rate;    ///< tau of the trajectory over the time [1/s]
};

/// The exact motion of isolated Hertz contacts with one stiffness and damping. R: double, or a Pack of several
/// contacts' numbers.
template <class R> struct BasicHertzMotion {
  BasicHertzTrajectory<R> trajectory;
  R rate;     ///< sqrt(k/m*) [1/(s m^(1/4))]
  R per_rate; ///< its inverse

  struct Place {
    R phase; ///< on the trajectory, in tau
    R l;     ///< length is l^4 of the trajectory's, see there [m^(1/4)]
  };
  /// Of a state in contact. overlap >= 0 [m], its fourth root, closing speed [m/s]. Of nothing, where nothing acts,
  /// finite.
  [[gnu::always_inline]] Place place(const R &overlap, const R &fourth_root, const R &closing_speed) const {
    const HertzSize<R> l = hertz_size(per_rate, overlap, fourth_root, closing_speed);
    const auto found = trajectory.place(fourth_root * l.per_size, closing_speed >= R(0.0));
    return {found.phase, l.size * found.scale};
  }

  /// See hertz_size().
  [[gnu::always_inline]] R size(const R &overlap, const R &fourth_root, const R &closing_speed) const {
    return hertz_size(per_rate, overlap, fourth_root, closing_speed).size;
  }

  /// From a state in contact, that is with a force that pushes or at touch, over a span [s].
  [[gnu::always_inline]] BasicHertzFlight<R> fly(const R &overlap, const R &fourth_root, const R &closing_speed,
                                                 const R &span) const {
    const Place start = place(overlap, fourth_root, closing_speed);
    const R phase_rate = rate * start.l;
    const R left = trajectory.duration - start.phase;
    const R advanced = phase_rate * span;
    const auto released = advanced >= left;
    const R contact_time = select(released, larger(R(0.0), left) / phase_rate, span);
    const std::array<R, 2> end = trajectory.state(start.phase + advanced);
    const R d = select(released, trajectory.release_overlap, end[0]);
    const R u = select(released, trajectory.release_speed, end[1]);
    const R halfway = trajectory.state(start.phase + 0.5 * smaller(advanced, left))[0];
    const R length = start.l * start.l * start.l * start.l;
    const R end_speed = phase_rate * length * u;
    return {length * d + end_speed * (span - contact_time), end_speed, contact_time,
            (1.0 / 6.0) * (overlap + length * (4.0 * halfway + d)), phase_rate};
  }
};

/// stiffness: kn [N/m^(3/2)]; trajectory: of the damping, whose tables stay where they are; reduced_mass: m* [kg]
template <class R> [[gnu::always_inline]] inline BasicHertzMotion<R>
hertz_motion(const R &stiffness, const BasicHertzTrajectory<R> &trajectory, const R &reduced_mass) {
  using std::sqrt;
  return {trajectory, sqrt(R(stiffness / reduced_mass)), sqrt(R(reduced_mass / stiffness))};
}

} // namespace cfpm
