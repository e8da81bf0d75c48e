// SPDX-License-Identifier: GPL-2.0-or-later
// The collision of two viscoelastic Hertz spheres. Where damping grows with the area of contact the isolated contact is
// m* d'' = -k d^(3/2) - h d^(1/2) d'. With the rate r = sqrt(k/m*) and any l, as in hertz_trajectory.h,
//   d = l^4 Y^2, d' = r l^5 U, dt = 2 Y dw/(r l)
// makes of it, with alpha = l h/sqrt(k m*),
//   dY/dw = U, dU/dw = -2 Y^2 (Y^2 + alpha U).
// Other than with the damping of Tsuji alpha depends on l: faster collisions are damped more, and there is no one
// trajectory of all. But both right sides are polynomials, also where bodies touch and part. So the motion is an
// analytic function of w, whose Taylor series follows from that of products, term by term.
#pragma once

#include "core/motion/hertz_motion.h"
#include "core/numbers/fifth_root.h"
#include "core/numbers/pack.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace cfpm {

/// Taylor series of Y, U and of the time in w, at most of this order. R: double, or a Pack of several contacts'
/// numbers.
template <class R> struct ViscoelasticSeries {
  static constexpr std::size_t order = 12;

  std::array<R, order + 2> y;
  std::array<R, order + 1> u;

  [[gnu::always_inline]] ViscoelasticSeries(const R &y_now, const R &u_now, const R &alpha) {
    std::array<R, order> square;
    std::array<R, order> pull;
    y[0] = y_now;
    u[0] = u_now;
#pragma GCC unroll 1
    for (std::size_t k = 0; k <= order; ++k) {
      y[k + 1] = per[k + 1] * u[k];
      if (k == order) break;
      square[k] = y[0] * y[k];
      for (std::size_t i = 1; i <= k; ++i) square[k] = square[k] + y[i] * y[k - i];
      pull[k] = square[k] + alpha * u[k];
      R product = square[0] * pull[k];
      for (std::size_t i = 1; i <= k; ++i) product = product + square[i] * pull[k - i];
      u[k + 1] = -2.0 * per[k + 1] * product;
    }
  }

  [[gnu::always_inline]] R y_at(const R &w) const {
    R sum = y[order + 1];
    for (std::size_t k = order + 1; k-- > 0;) sum = y[k] + w * sum;
    return sum;
  }
  [[gnu::always_inline]] R u_at(const R &w) const {
    R sum = u[order];
    for (std::size_t k = order; k-- > 0;) sum = u[k] + w * sum;
    return sum;
  }
  /// In tau = r l t.
  [[gnu::always_inline]] R time_at(const R &w) const {
    R sum = per[order + 2] * y[order + 1];
    for (std::size_t k = order + 1; k-- > 0;) sum = per[k + 1] * y[k] + w * sum;
    return 2.0 * w * sum;
  }

private:
  static constexpr std::array<double, order + 3> inverses() {
    std::array<double, order + 3> values{};
    for (std::size_t k = 1; k < values.size(); ++k) values[k] = 1.0 / static_cast<double>(k);
    return values;
  }
  static constexpr std::array<double, order + 3> per = inverses();
};

/// The motion of isolated viscoelastic Hertz contacts with one stiffness and damping, over any span: restitution within
/// 4e-6 of the impact speed, 1.3e-6 if over it at once, the time of contact within 3e-6 of its own, for alpha up to 5
/// (of the l of the impact speed, l^5 = u/r), at which it is 0.002. R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicViscoelasticMotion {
  R rate;        ///< sqrt(k/m*) [1/(s m^(1/4))]
  R per_rate;    ///< its inverse
  R damping;     ///< h/sqrt(k m*), alpha over l [m^(-1/4)]
  R least_force; ///< see without_tension [N]

  /// At the end of a span or, where it comes before, of the contact.
  struct End {
    R overlap;       ///< [m]
    R closing_speed; ///< [m/s]
    R contact_time;  ///< [s]
  };

  /// See BasicHertzMotion.
  [[gnu::always_inline]] R size(const R &overlap, const R &fourth_root, const R &closing_speed) const {
    return hertz_size(per_rate, overlap, fourth_root, closing_speed).size;
  }

  /// From a state in contact, see BasicHertzMotion, over a span [s].
  ///
  /// A step in w is a part of what the series allows: 0.35 s^-3 with s^5 = |U| + Y^(5/2), the present size of the
  /// state, or less where damping is faster. Order and factors were found with the errors above, of a whole collision
  /// in 8 to 16 steps; a step dt below a tenth of it takes one or two. The most that are made last three contact times
  /// at any damping (tests/core/test_viscoelastic_impulse.cpp); in what is left of a longer span bodies so damped,
  /// which creep apart, go on at their last speed, some thousandths of that of the impact.
  [[gnu::always_inline]] End until_release(const R &overlap, const R &fourth_root, const R &closing_speed,
                                           const R &span) const {
    if constexpr (std::is_same_v<R, double>)
      return one_until_release(overlap, fourth_root, closing_speed, span);
    else
      return follow(overlap, fourth_root, closing_speed, span);
  }

  /// The same with the free flight behind the contact.
  [[gnu::always_inline]] BasicHertzFlight<R> fly(const R &overlap, const R &fourth_root, const R &closing_speed,
                                                 const R &span) const {
    const End end = until_release(overlap, fourth_root, closing_speed, span);
    const R mean_overlap = 0.5 * (overlap + end.overlap) +
                           (1.0 / 12.0) * end.contact_time * (closing_speed - end.closing_speed); // by both ends
    return {end.overlap + end.closing_speed * (span - end.contact_time), end.closing_speed, end.contact_time,
            mean_overlap, rate * size(overlap, fourth_root, closing_speed)};
  }

private:
  /// Of a single contact, compiled once.
  [[gnu::noinline]] End one_until_release(double overlap, double fourth_root, double closing_speed, double span) const {
    return follow(overlap, fourth_root, closing_speed, span);
  }

  [[gnu::always_inline]] End follow(const R &overlap, const R &fourth_root, const R &closing_speed,
                                    const R &span) const {
    using std::fabs;
    using std::sqrt;
    constexpr int most_steps = 64;
    const HertzSize<R> l = hertz_size(per_rate, overlap, fourth_root, closing_speed);
    const R per_square = l.per_size * l.per_size;
    const R alpha = damping * l.size;
    const R phase_rate = rate * l.size;
    R y = fourth_root * fourth_root * per_square;
    R u = closing_speed * per_rate * (per_square * per_square * l.per_size);
    R left = phase_rate * span;
    R released = 0.0; // 1 where it is
    R open = select(R(0.0) < left, R(1.0), R(0.0));
    for (int step = 0; step < most_steps; ++step) {
      const auto goes_on = R(0.0) < open;
      if (!any(goes_on)) break;
      const R per = inverse_fifth_root(R(fabs(u) + y * y * R(sqrt(larger(R(0.0), y)))));
      const R most = 0.35 * (per * per) * (per * per) / (per + 0.25 * alpha);
      const ViscoelasticSeries<R> series(y, u, alpha);
      R w = most;
      const R end_u = series.u_at(w);
      const R behind = series.y_at(w) - least_y(alpha, end_u);
      const auto ends = (end_u < R(0.0)) & (R(0.0) >= behind) & goes_on;
      if (any(ends)) {
#pragma GCC unroll 1
        for (int k = 0; k < 6; ++k) { // Newton's method, from behind it
          const R near_y = series.y_at(w);
          const R near_u = series.u_at(w);
          const R least = least_y(alpha, near_u);
          const R off = near_y - least;
          const R slope =
              near_u - select(R(0.0) < least, alpha * (near_y * near_y) * off * (near_y + least) / least, R(0.0));
          w = select(ends, within(w - off / slope, most), w);
        }
      }
      R passed = series.time_at(w);
      const auto stops = (passed >= left) & goes_on;
      if (any(stops)) {
        const R longest = w;
        const R first = left / (y + R(sqrt(larger(R(0.0), y * y + u * left)))); // as at a constant U
        w = select(stops, within(first, longest), w);
#pragma GCC unroll 1
        for (int k = 0; k < 4; ++k) {
          const R off = series.time_at(w) - left;
          w = select(stops, within(w - off / (2.0 * series.y_at(w)), longest), w);
        }
        passed = select(stops, left, passed);
      }
      y = select(goes_on, series.y_at(w), y);
      u = select(goes_on, series.u_at(w), u);
      left = select(goes_on, left - passed, left);
      released = select(ends, R(1.0), released);
      released = select(stops, R(0.0), released);
      open = select(ends, R(0.0), open);
      open = select(stops, R(0.0), open);
    }
    const R square = l.size * l.size;
    const R length = square * square;
    const R end_speed = phase_rate * length * u;
    const auto parted = R(0.0) < released;
    const R rest = left / phase_rate;
    return {select(parted, length * (y * y), length * (y * y) + select(R(0.0) < left, end_speed * rest, R(0.0))),
            end_speed, select(parted, span - rest, span)};
  }

  /// Of bodies that part, where the contact ends: no overlap or, without tension, no force.
  [[gnu::always_inline]] R least_y(const R &alpha, const R &u) const {
    using std::sqrt;
    return select(least_force < R(0.0), R(0.0), R(sqrt(larger(R(0.0), -(alpha * u)))));
  }
  /// Between 0 and most; where it is no number, most.
  [[gnu::always_inline]] static R within(const R &w, const R &most) {
    return larger(R(0.0), select(w < most, w, most));
  }
};

/// stiffness: kn [N/m^(3/2)]; damping: hn [kg/(s m^(1/2))]; reduced_mass: m* [kg]
template <class R> [[gnu::always_inline]] inline BasicViscoelasticMotion<R>
viscoelastic_motion(const R &stiffness, const R &damping, const R &least_force, const R &reduced_mass) {
  using std::sqrt;
  return {R(sqrt(R(stiffness / reduced_mass))), R(sqrt(R(reduced_mass / stiffness))),
          damping / R(sqrt(R(stiffness * reduced_mass))), least_force};
}

} // namespace cfpm
