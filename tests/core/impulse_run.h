// SPDX-License-Identifier: GPL-2.0-or-later
// Two spheres stepped by the exact impulse, without a host and without its loop over pairs.
#pragma once

#include "core/contact/inertia.h"
#include "core/method/contact_solver.h"
#include "core/step/move_sphere.h"
#include "isolated_contact.h"

#include <functional>
#include <type_traits>

namespace cfpm::testing {

using HertzLaw = HertzImpulse::Law;

/// The coefficients as the core's law.
template <class Law> Law law_of(const Coefficients &c) { return {c.kn, c.hn, c.ks, c.hs, c.friction}; }

/// Steps the balls over a time. step(n): the n-th step [s], whose sum passes no further than the time.
template <class Law> TwoBalls stepped(const Coefficients &coefficients, TwoBalls balls, double time,
                                      const std::function<double(int)> &step) {
  ContactSolver<Law> solver([&](const ContactPartners &) { return law_of<Law>(coefficients); });
  solver.reset(*find_method("impulse"), 3, false);
  Ball &a = balls.a;
  Ball &b = balls.b;
  const double reach = a.radius + b.radius;
  const ContactPartners partners{1, 2, a.radius, b.radius, a.mass * b.mass / (a.mass + b.mass)};
  double values[3] = {};
  double now[3] = {};
  double t = 0.0;
  double last_dt = step(0);
  for (int n = 0; t < time * (1.0 - 1e-12); ++n) {
    const double dt = step(n);
    MeanForce mean{};
    ContactGeometry g{};
    Vec3 separation = a.x - b.x;
    const Vec3 velocity = a.v - b.v;
    const bool overlapping = norm(separation) < reach;
    const double wait = overlapping ? 0.0 : time_to_touch(separation, velocity, reach, dt);
    if (wait < dt) {
      separation = separation + wait * velocity;
      g = touching_spheres(separation, overlapping ? norm(separation) : reach, a.radius, b.radius, {a.v, a.omega},
                           {b.v, b.omega});
      solver.with_method(dt, [&](const auto &method) {
        if constexpr (std::decay_t<decltype(method)>::wants_crowd) {
          const auto &parameters = method.parameters(partners);
          const auto normal = method.normal(parameters, g, dt - wait, 0.0);
          const StoredSpring spring{values, last_dt, true, now};
          mean = coefficients.together
                     ? method.template mean_force<Friction::limited_together>(parameters, normal, g, dt - wait, spring,
                                                                              coefficients.cohesive)
                     : method.template mean_force<Friction::spring_and_dashpot>(parameters, normal, g, dt - wait,
                                                                                spring, coefficients.cohesive);
        }
      });
    }
    const auto move = [&](Ball &ball, const Vec3 &force, const Vec3 &torque, const Vec3 &shift) {
      double x[] = {ball.x.x, ball.x.y, ball.x.z};
      double v[] = {ball.v.x, ball.v.y, ball.v.z};
      double omega[] = {ball.omega.x, ball.omega.y, ball.omega.z};
      const double rows[3][3] = {
          {force.x, force.y, force.z}, {torque.x, torque.y, torque.z}, {shift.x, shift.y, shift.z}};
      move_sphere(dt, ball.mass, ball.radius, inertia_factor(3), rows[0], rows[1], rows[2], x, v, omega);
      ball.x = vec3(x);
      ball.v = vec3(v);
      ball.omega = vec3(omega);
    };
    move(a, mean.force, -g.lever_i * mean.torque_per_lever, mean.shift);
    move(b, -mean.force, -g.lever_j * mean.torque_per_lever, -mean.shift);
    t += dt;
    last_dt = dt;
  }
  return balls;
}

} // namespace cfpm::testing
