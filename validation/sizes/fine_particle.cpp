// SPDX-License-Identifier: GPL-2.0-or-later
// A fine sphere that rolls off two large ones, which touch each other and are held: the reference of this exhibit, by
// small steps of Runge and Kutta's method of fourth order, apart from the hosts and from the plugin.
//
//   fine_particle LARGE FINE DENSITY G KN HN KS MU ANGLE DT EVERY COUNT
//
// LARGE and FINE: radii [m]; KN, HN, KS: stiffness [N/m], damping [N s/m] and tangential stiffness [N/m] of a contact;
// ANGLE: of the start from the top [rad], at rest, both contacts without overlap. COUNT states, EVERY steps DT apart
// [s], as CSV in SI units: time, y, z, vy, vz, and the spin about the line of centres of the large spheres.
//
// The large spheres have their centres at x = -LARGE and x = LARGE. All stays a mirror image of itself in x = 0, so one
// contact is followed. Its spring xi stretches by the slip and turns with the tangent plane, xi' = w - (xi . n') n, as
// in the hosts and the plugin but for how they do it in a step; after each step Coulomb's limit slackens it.
#include "core/numbers/vec3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using cfpm::cross;
using cfpm::dot;
using cfpm::norm;
using cfpm::tangential_part;
using cfpm::Vec3;

/// The first numbers of the command, in its order.
struct Spheres {
  double large, fine, density, gravity, kn, hn, ks, mu;
  double mass() const { return density * 4.0 / 3.0 * 3.14159265358979323846 * fine * fine * fine; }
};

/// Of the fine sphere; spring: of the contact that is followed.
struct State {
  Vec3 x, v, spin, spring;
};

State moved(const State &a, double h, const State &rate) {
  return {a.x + h * rate.x, a.v + h * rate.v, a.spin + h * rate.spin, a.spring + h * rate.spring};
}

/// Where the contact with the large sphere at x = -LARGE is, and its force along n, from there to the fine sphere.
struct Contact {
  Vec3 n;
  double distance, overlap, force;
};

Contact contact(const Spheres &s, const State &a) {
  const Vec3 from = a.x - Vec3{-s.large, 0.0, 0.0};
  const double distance = norm(from);
  const Vec3 n = (1.0 / distance) * from;
  const double overlap = s.large + s.fine - distance;
  const double force = overlap > 0.0 ? std::max(0.0, s.kn * overlap - s.hn * dot(a.v, n)) : 0.0;
  return {n, distance, overlap, force};
}

/// What Coulomb's limit leaves of a spring.
Vec3 slackened(const Spheres &s, const Vec3 &spring, double normal_force) {
  const double stretched = s.ks * norm(spring), limit = s.mu * normal_force;
  return stretched > limit ? (limit / stretched) * spring : spring;
}

State rates(const Spheres &s, const State &a) {
  const Contact c = contact(s, a);
  const Vec3 across = tangential_part(a.v, c.n);
  const Vec3 lever = -(s.fine - 0.5 * std::max(0.0, c.overlap)) * c.n;
  const Vec3 slip = across + cross(a.spin, lever);
  const Vec3 turning = (1.0 / c.distance) * across;
  const Vec3 friction = -s.ks * slackened(s, a.spring, c.force);
  const Vec3 force = c.force * c.n + friction, torque = cross(lever, friction);
  const double mass = s.mass(), inertia = 0.4 * mass * s.fine * s.fine;
  return {a.v,
          {0.0, 2.0 * force.y / mass, 2.0 * force.z / mass - s.gravity},
          {2.0 * torque.x / inertia, 0.0, 0.0},
          c.overlap > 0.0 ? slip - dot(a.spring, turning) * c.n : Vec3{}};
}

State stepped(const Spheres &s, const State &a, double dt) {
  const State k1 = rates(s, a), k2 = rates(s, moved(a, 0.5 * dt, k1));
  const State k3 = rates(s, moved(a, 0.5 * dt, k2)), k4 = rates(s, moved(a, dt, k3));
  State b = moved(moved(moved(moved(a, dt / 6.0, k1), dt / 3.0, k2), dt / 3.0, k3), dt / 6.0, k4);
  b.spring = slackened(s, b.spring, contact(s, b).force);
  return b;
}

} // namespace

int main(int argc, char **argv) {
  if (argc != 13) {
    std::fprintf(stderr, "usage: fine_particle LARGE FINE DENSITY G KN HN KS MU ANGLE DT EVERY COUNT\n");
    return EXIT_FAILURE;
  }
  std::array<double, 12> number{};
  for (int i = 0; i < 12; ++i) number[i] = std::atof(argv[i + 1]);
  const Spheres s{number[0], number[1], number[2], number[3], number[4], number[5], number[6], number[7]};
  const double angle = number[8], dt = number[9];
  const long every = std::lround(number[10]), count = std::lround(number[11]);

  const double height = std::sqrt((s.large + s.fine) * (s.large + s.fine) - s.large * s.large);
  State a{{0.0, height * std::sin(angle), height * std::cos(angle)}, {}, {}, {}};
  std::printf("t,y,z,vy,vz,omega\n");
  for (long i = 0; i < count; ++i) {
    const double t = dt * static_cast<double>(i * every);
    std::printf("%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", t, a.x.y, a.x.z, a.v.y, a.v.z, a.spin.x);
    for (long k = 0; k < every; ++k) a = stepped(s, a, dt);
  }
}
