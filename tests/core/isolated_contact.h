// SPDX-License-Identifier: GPL-2.0-or-later
// Two spheres that collide, as rigid bodies in three dimensions: what the exact impulses are compared with. Geometry,
// forces and equations of motion are written down here a second time, from Eqs. 2 and 6 to 10 of the paper, and
// integrated in steps that are small against the contact; of the core there are only vectors.
#pragma once

#include "core/numbers/vec3.h"

#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace cfpm::testing {

struct Ball {
  double radius; ///< [m]
  double mass;   ///< [kg]
  Vec3 x;        ///< [m]
  Vec3 v;        ///< [m/s]
  Vec3 omega;    ///< [rad/s]

  double inertia() const { return 0.4 * mass * radius * radius; } ///< solid sphere [kg m^2]
};

struct TwoBalls {
  Ball a;
  Ball b;
};

/// Coefficients of the contact; with Hertz' law the stiffnesses grow with the square root of the overlap and the
/// dampings with its fourth root.
struct Coefficients {
  bool hertz;
  double kn, hn, ks, hs;
  double friction;
  double cohesive = 0.0; ///< what presses the bodies together besides, as far as Coulomb's limit counts it [N]
  bool together = false; ///< Coulomb's limit holds the tangential spring with its dashpot, not alone
};

class IsolatedContact {
public:
  IsolatedContact(const Coefficients &law, const TwoBalls &balls) : law_(law), balls_(balls) {}

  /// The balls after a time [s], in which they meet once at most. steps: that a span of this length in contact is
  /// divided into. The contact ends where its force vanishes.
  TwoBalls after(double time, int steps) const {
    State s = state_of(balls_);
    const double touch = std::min(time, first_touch());
    drift(s, touch);
    double left = time - touch;
    const double step = time / steps;
    bool contact = left > 0.0;
    while (contact && left > 0.0) {
      const double h = std::min(step, left);
      State next = advanced(s, h);
      contact = !released(next);
      if (contact) {
        s = next;
        left -= h;
        continue;
      }
      double before = 0.0; // the release lies inside the step: it is found by bisection
      double behind = h;
      for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (before + behind);
        (released(advanced(s, middle)) ? behind : before) = middle;
      }
      s = advanced(s, before);
      left -= before;
    }
    drift(s, left);
    TwoBalls end = balls_;
    place(s, 0, end.a);
    place(s, 9, end.b);
    return end;
  }

private:
  /// Of either ball place, velocity and spin, then the spring.
  using State = std::array<double, 21>;
  static constexpr int spring = 18;

  static Vec3 part(const State &s, int at) { return vec3(&s[static_cast<std::size_t>(at)]); }
  static void put(const Vec3 &a, State &s, int at) { set(a, &s[static_cast<std::size_t>(at)]); }
  static void place(const State &s, int at, Ball &ball) {
    ball.x = part(s, at);
    ball.v = part(s, at + 3);
    ball.omega = part(s, at + 6);
  }
  static State state_of(const TwoBalls &balls) {
    State s{};
    int at = 0;
    for (const Ball *const ball : {&balls.a, &balls.b})
      for (const Vec3 &a : {ball->x, ball->v, ball->omega}) {
        put(a, s, at);
        at += 3;
      }
    return s;
  }

  struct Contact {
    Vec3 n; ///< towards ball a
    double overlap;
    double normal_force;
    double closing_speed;
    double lever_a, lever_b;
    Vec3 slip;    ///< of a against b where they touch
    Vec3 turning; ///< of n [1/s]
    double ks, hs;
  };

  Contact contact(const State &s) const {
    const Vec3 between = part(s, 0) - part(s, 9);
    const double distance = norm(between);
    const Vec3 velocity = part(s, 3) - part(s, 12);
    Contact c{};
    c.n = (1.0 / distance) * between;
    c.overlap = balls_.a.radius + balls_.b.radius - distance;
    c.closing_speed = -dot(velocity, c.n);
    c.turning = (1.0 / distance) * (velocity + c.closing_speed * c.n);
    c.lever_a = balls_.a.radius - 0.5 * c.overlap;
    c.lever_b = balls_.b.radius - 0.5 * c.overlap;
    // the point of a lies at -lever_a n from its centre, that of b at lever_b n
    const Vec3 at_a = part(s, 3) - c.lever_a * cross(part(s, 6), c.n);
    const Vec3 at_b = part(s, 12) + c.lever_b * cross(part(s, 15), c.n);
    c.slip = (at_a - at_b) - dot(at_a - at_b, c.n) * c.n;
    const double d = std::max(0.0, c.overlap);
    const double stiffening = law_.hertz ? std::sqrt(d) : 1.0;
    const double damping = law_.hertz ? std::sqrt(stiffening) : 1.0;
    c.normal_force = stiffening * law_.kn * c.overlap + damping * law_.hn * c.closing_speed;
    c.ks = stiffening * law_.ks;
    c.hs = damping * law_.hs;
    return c;
  }

  /// Coulomb's limit on friction.
  double limit(const Contact &c) const { return law_.friction * std::fabs(c.normal_force + law_.cohesive); }
  static Vec3 shortened(const Vec3 &a, double longest) { return norm(a) > longest ? (longest / norm(a)) * a : a; }

  bool released(const State &s) const {
    const Contact c = contact(s);
    return c.normal_force <= 0.0 && c.closing_speed < 0.0;
  }

  /// Coulomb's limit holds both together, or the spring alone, and where that is at it there is no dashpot.
  Vec3 friction_of(const Contact &c, const Vec3 &xi) const {
    const Vec3 both = -c.ks * xi - c.hs * c.slip;
    if (c.ks == 0.0 || law_.together) return shortened(both, limit(c));
    const bool slides = c.ks * norm(xi) >= (1.0 - 1e-9) * limit(c);
    return slides ? shortened(-c.ks * xi, limit(c)) : both;
  }

  /// The spring that is left of what pulls harder than Coulomb allows.
  Vec3 slackened(const Contact &c, const Vec3 &xi) const {
    if (c.ks == 0.0) return xi;
    if (!law_.together) return shortened(xi, limit(c) / c.ks);
    return (1.0 / c.ks) * (shortened(c.ks * xi + c.hs * c.slip, limit(c)) - c.hs * c.slip);
  }

  /// Over a time in contact. A spring that would pull harder than Coulomb allows is slackened behind it.
  State advanced(State s, double time) const {
    const auto derivative = [this](const State &at, State &rate, double) {
      const Contact c = contact(at);
      const Vec3 xi = part(at, spring);
      const Vec3 friction = friction_of(c, xi);
      const Vec3 force = c.normal_force * c.n + friction;
      const Vec3 moment = cross(c.n, friction);
      put(part(at, 3), rate, 0);
      put((1.0 / balls_.a.mass) * force, rate, 3);
      put((-c.lever_a / balls_.a.inertia()) * moment, rate, 6);
      put(part(at, 12), rate, 9);
      put((-1.0 / balls_.b.mass) * force, rate, 12);
      put((-c.lever_b / balls_.b.inertia()) * moment, rate, 15);
      put(c.slip - dot(xi, c.turning) * c.n, rate, spring); // it turns with the tangent plane
    };
    boost::numeric::odeint::runge_kutta4<State> stepper;
    stepper.do_step(derivative, s, 0.0, time);
    const Contact c = contact(s);
    put(slackened(c, part(s, spring)), s, spring);
    return s;
  }

  static void drift(State &s, double time) {
    put(part(s, 0) + time * part(s, 3), s, 0);
    put(part(s, 9) + time * part(s, 12), s, 9);
  }

  /// When the distance becomes the sum of the radii.
  double first_touch() const {
    const Vec3 x = balls_.a.x - balls_.b.x;
    const Vec3 v = balls_.a.v - balls_.b.v;
    const double reach = balls_.a.radius + balls_.b.radius;
    const double b = dot(x, v);
    return (-b - std::sqrt(b * b - dot(v, v) * (dot(x, x) - reach * reach))) / dot(v, v);
  }

  Coefficients law_;
  TwoBalls balls_;
};

} // namespace cfpm::testing
