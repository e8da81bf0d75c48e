// SPDX-License-Identifier: GPL-2.0-or-later
// Final velocities of the three-particle collision of Figs. 3-5: A and C hit B, at rest between them, with speed v0
// from both sides, and C comes late by t* contact times of a pair.
//
//   three_particles GAMMA LAST COUNT      damping eta = GAMMA sqrt(m k); COUNT values of t* from 0 to LAST
//
// Prints CSV: t*, the velocities over v0, and the error: the change from a tolerance a hundred times larger. Units are
// the mass m of a particle, (m/k)^(1/2) and v0, so nothing but gamma and t* matters.
#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

namespace odeint = boost::numeric::odeint;

constexpr double pi = 3.14159265358979323846;
const double contact_time = pi * std::sqrt(0.5); // Eq. 17 with the reduced mass 1/2

using State = std::array<double, 6>; // displacements of A, B, C, which touch where they are equal; velocities

/// Eq. 2 of a linear contact, without tension; a force on what moves away along the line.
double force(double gamma, double overlap, double closing_speed) {
  return overlap > 0.0 ? std::max(0.0, overlap + gamma * closing_speed) : 0.0;
}

std::array<double, 3> final_velocities(double gamma, double t_star, double tolerance) {
  const double lag = t_star * contact_time;
  State state{0.0, 0.0, lag, 1.0, 0.0, -1.0};
  const auto motion = [gamma](const State &s, State &rate, double) {
    const double ab = force(gamma, s[0] - s[1], s[3] - s[4]);
    const double bc = force(gamma, s[1] - s[2], s[4] - s[5]);
    rate = {s[3], s[4], s[5], -ab, ab - bc, bc};
  };
  // a damped contact has no force after one contact time, and B swings between A and C for a second one
  const double end = lag + 4.0 * contact_time;
  const auto stepper = odeint::make_controlled<odeint::runge_kutta_dopri5<State>>(tolerance, tolerance);
  odeint::integrate_adaptive(stepper, motion, state, 0.0, end, 0.01 * contact_time);
  return {state[3], state[4], state[5]};
}

} // namespace

int main(int argc, char **argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: three_particles GAMMA LAST COUNT\n");
    return EXIT_FAILURE;
  }
  const double gamma = std::atof(argv[1]);
  const double last = std::atof(argv[2]);
  const int count = std::atoi(argv[3]);

  std::printf("t_star,vA,vB,vC,error\n");
  for (int i = 0; i < count; ++i) {
    const double t_star = last * i / (count - 1);
    const auto v = final_velocities(gamma, t_star, 1e-12);
    const auto coarse = final_velocities(gamma, t_star, 1e-10);
    double error = 0.0;
    for (int k = 0; k < 3; ++k) error = std::max(error, std::abs(v[k] - coarse[k]));
    std::printf("%.17g,%.17g,%.17g,%.17g,%.3g\n", t_star, v[0], v[1], v[2], error);
  }
} catch (const std::exception &error) { // of the integrator, which finds no step small enough
  std::fprintf(stderr, "three_particles: %s\n", error.what());
  return EXIT_FAILURE;
}
