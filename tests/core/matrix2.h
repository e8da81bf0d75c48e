// SPDX-License-Identifier: GPL-2.0-or-later
// 2x2 matrices of the scaled state (omega d, u): in these coordinates the energy of an undamped
// oscillator is the squared length, and a map depends on theta = omega dt alone.
#pragma once

#include "core/motion/oscillator.h"

#include <algorithm>
#include <cmath>

namespace cfpm::testing {

struct Matrix2 {
  double a, b, c, d; ///< rows (a b), (c d)

  double determinant() const { return a * d - b * c; }
  double trace() const { return a + d; }

  /// Largest modulus of the eigenvalues, from the characteristic polynomial.
  double spectral_radius() const {
    const double half = 0.5 * trace();
    const double discriminant = half * half - determinant();
    return discriminant < 0.0 ? std::sqrt(determinant()) : std::fabs(half) + std::sqrt(discriminant);
  }
};

inline constexpr Matrix2 identity{1.0, 0.0, 0.0, 1.0};

inline Matrix2 operator*(const Matrix2 &p, const Matrix2 &q) {
  return {p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d, p.c * q.a + p.d * q.c, p.c * q.b + p.d * q.d};
}
inline Matrix2 operator+(const Matrix2 &p, const Matrix2 &q) { return {p.a + q.a, p.b + q.b, p.c + q.c, p.d + q.d}; }
inline Matrix2 operator-(const Matrix2 &p, const Matrix2 &q) { return {p.a - q.a, p.b - q.b, p.c - q.c, p.d - q.d}; }
inline Matrix2 operator*(double s, const Matrix2 &m) { return {s * m.a, s * m.b, s * m.c, s * m.d}; }
inline Matrix2 inverse(const Matrix2 &m) { return (1.0 / m.determinant()) * Matrix2{m.d, -m.b, -m.c, m.a}; }
inline double largest(const Matrix2 &m) {
  return std::max({std::fabs(m.a), std::fabs(m.b), std::fabs(m.c), std::fabs(m.d)});
}

inline Matrix2 scaled(const Propagator &p, double omega) {
  return {p.displacement_from_displacement, omega * p.displacement_from_rate, p.rate_from_displacement / omega,
          p.rate_from_rate};
}

/// d/dt (omega d, u) times dt: the generator whose exponential is the exact map.
inline Matrix2 generator(const Oscillator &o, double omega, double dt) {
  return dt * Matrix2{0.0, omega, -o.stiffness / (o.mass * omega), -o.damping / o.mass};
}

} // namespace cfpm::testing
