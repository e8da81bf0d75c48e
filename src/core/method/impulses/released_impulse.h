// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/motion/oscillator.h"
#include "core/motion/release.h"
#include "core/numbers/pack.h"

#include <cmath>
#include <type_traits>

namespace cfpm {

/// The impulse that a linear contact gives until it is released, without functions that are slow to evaluate.
///
/// With w^2 = k/m and the time in units of 1/w the contact is d'' + 2 zeta d' + d = 0, whatever the stiffness: the
/// impulse over m (|u| + w d) can depend on the direction of the state alone, that is on p = |u|/(|u| + w d) from 0 to
/// 1 and on the sign of u. Known in closed form are
/// - at rest (p = 0): the impulse of a contact that starts at rest, exp(-zeta w t) with t the time to its release; a
///   small speed u adds just itself to what is given, and takes w d of the scale: hence the slope 1 - that;
/// - at the touch (p = 1, u > 0): 1 + e, with e the restitution; a small overlap adds 2 zeta e w d;
/// - at the release without tension (u < 0, p = l = 1/(1 + 2 zeta), where the force vanishes): nothing, and nothing to
///   first order. Here the next two derivatives are right too: else all contacts that end inside a short step would
///   give energy. See ReleasedPolynomials for them.
/// - at the release with tension (u < 0, p = 1, where the bodies part): nothing, and what the dashpot pulls before.
/// A polynomial for either sign meets these; in between it is off by up to 0.045 where released_impulse_fits().
/// R: double, or a Pack of several contacts' numbers.
template <class R> struct BasicReleasedImpulse {
  struct Polynomial {
    R first;
    R direction;
    R c[6];
    [[gnu::always_inline]] R operator()(const R &p) const {
      const R x = first + direction * p;
      return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))));
    }
  };

  R mass; ///< [kg]
  R rate; ///< w [1/s]
  Polynomial retreat;
  Polynomial approach;

  /// [N s]; overlap [m] and closing speed [m/s] of a contact that is released before the end. Of packs both polynomials
  /// are computed; of a single contact one, without a branch, which in a bed would be mispredicted.
  [[gnu::always_inline]] R operator()(const R &overlap, const R &closing_speed) const {
    using std::fabs;
    const R speed = fabs(closing_speed);
    const R scale = speed + rate * overlap;
    const R p = speed / scale;
    const auto approaching = R(0.0) < closing_speed;
    if constexpr (std::is_same_v<R, double>) {
      const Polynomial *const either[] = {&retreat, &approach};
      return mass * scale * (*either[approaching])(p);
    } else {
      return mass * scale * select(approaching, approach(p), retreat(p));
    }
  }
};

/// Near critical damping and beyond no such polynomial does: there it would even pull. damping_ratio: zeta; tension: a
/// condition, or one of each lane
template <class R, class Condition>
[[gnu::always_inline]] inline auto released_impulse_fits(const R &damping_ratio, const Condition &tension) {
  return select(tension, R(0.8), R(0.9)) >= damping_ratio;
}

/// The polynomials of one damping ratio. R: see BasicReleasedImpulse.
template <class R> struct ReleasedPolynomials {
  using Polynomial = typename BasicReleasedImpulse<R>::Polynomial;

  R zeta;        ///< h/(2 m w)
  R at_rest;     ///< the impulse of a contact that starts at rest
  R restitution; ///< e

  /// In p, from 0, where a speed adds just itself, to 1, where an overlap d adds 2 zeta e w d.
  [[gnu::always_inline]] Polynomial approach() const {
    const R rise = 1.0 + restitution - at_rest;
    const R slope = 1.0 - at_rest;
    const R end_slope = 1.0 + restitution - 2.0 * zeta * restitution;
    return {0.0, 1.0, {at_rest, slope, 3.0 * rise - 2.0 * slope - end_slope, slope + end_slope - 2.0 * rise, 0.0, 0.0}};
  }

  /// tension: see released_impulse_fits()
  template <class Condition> [[gnu::always_inline]] Polynomial retreat(const Condition &tension) const {
    const Polynomial pulled = pulled_retreat();
    const Polynomial pushed = pushed_retreat();
    Polynomial chosen = pulled;
    chosen.first = select(tension, pulled.first, pushed.first);
    for (int k = 0; k < 6; ++k) chosen.c[k] = select(tension, pulled.c[k], pushed.c[k]);
    return chosen;
  }

private:
  /// In x = l - p, from 0, the release, to l. A time t before the release, in units of 1/w, the force is t + zeta t^2
  /// of the slope that it has there and the impulse t^2/2 + zeta t^3/3: hence the terms of x^2 and x^3.
  [[gnu::always_inline]] Polynomial pushed_retreat() const {
    const R l = 1.0 / (1.0 + 2.0 * zeta);
    const R square = 0.5 / (l * l * l);
    const R cube = (0.5 * l - 2.0 / 3.0 * zeta) / (l * l * l * l * l);
    // what these leave of the value and of the slope at l
    const R value = (at_rest / l - square * l) / l - cube * l;
    const R slope = (1.0 + at_rest) / l - 2.0 * square - 3.0 * cube * l;
    const R fifth = slope - 4.0 * value;
    return {l, -1.0, {0.0, 0.0, square, cube, (value - fifth) / (l * l), fifth / (l * l * l)}};
  }

  /// In x = 1 - p, from 0, where the bodies part. A time t before, in units of 1/w and with the speed there as unit,
  /// the overlap is t + zeta t^2 and the impulse -2 zeta t + (1/2 - 2 zeta^2) t^2, to second order: hence the terms of
  /// x and x^2. A third one that is right there would leave the polynomial off by more elsewhere.
  [[gnu::always_inline]] Polynomial pulled_retreat() const {
    const R linear = -2.0 * zeta;
    const R square = 0.5;
    const R value = at_rest - linear - square;
    const R slope = 1.0 + at_rest - linear - 2.0 * square;
    const R fourth = slope - 3.0 * value;
    return {1.0, -1.0, {0.0, linear, square, value - fourth, fourth, 0.0}};
  }
};

/// The same of one contact, with the limits of what it is good for.
class ReleasedImpulse {
public:
  ReleasedImpulse(const Oscillator &o, const LinearRelease &release, bool tension)
      : numbers_{o.mass, std::sqrt(o.stiffness / o.mass), {}, {}} {
    const double zeta = o.damping / (2.0 * o.mass * numbers_.rate);
    fits_ = released_impulse_fits(zeta, tension);
    const double at_rest = std::exp(-zeta * numbers_.rate * release.time({1.0, 0.0}));
    const ReleasedPolynomials<double> polynomials{zeta, at_rest, release.restitution()};
    numbers_.approach = polynomials.approach();
    numbers_.retreat = polynomials.retreat(tension);
  }

  /// See released_impulse_fits().
  bool fits() const { return fits_; }

  const BasicReleasedImpulse<double> &numbers() const { return numbers_; }
  double operator()(double overlap, double closing_speed) const { return numbers_(overlap, closing_speed); }

private:
  BasicReleasedImpulse<double> numbers_;
  bool fits_;
};

} // namespace cfpm
