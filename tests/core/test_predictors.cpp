// SPDX-License-Identifier: GPL-2.0-or-later
// The predictors alone: against closed forms, against their defining formulas, and against an
// independent integrator.
#include "core/law/linear_law.h"
#include "core/predict/predictor.h"
#include "matrix2.h"

#include <boost/numeric/odeint/integrate/integrate_n_steps.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <random>

namespace cfpm::testing {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2.0;

/// An oscillator of frequency omega [1/s] and damping ratio zeta; the mass is no power of two, so
/// that a forgotten division shows.
Oscillator oscillator_of(double omega, double zeta) {
  const double mass = 0.7;
  return {mass * omega * omega, 2.0 * zeta * mass * omega, mass};
}

Matrix2 exact_map(const Oscillator &o, double omega, double t) { return scaled(make_propagator<Exact>(o, t), omega); }

/// The closed form by complex exponentials of the two characteristic roots, in long double. Its own
/// error is that of the difference of the roots, 1e-19/|zeta - 1|^(1/2).
Matrix2 closed_form(double omega, double zeta, double t) {
  using Complex = std::complex<long double>;
  const Complex root = std::sqrt(Complex(static_cast<long double>(zeta) * zeta - 1.0L));
  const Complex w = omega;
  const Complex p = w * (-Complex(zeta) + root);
  const Complex q = w * (-Complex(zeta) - root);
  const Complex ep = std::exp(p * Complex(t));
  const Complex eq = std::exp(q * Complex(t));
  const auto real = [](const Complex &z) { return static_cast<double>(z.real()); };
  return {real((p * eq - q * ep) / (p - q)), real(w * (ep - eq) / (p - q)), real(p * q * (eq - ep) / (p - q) / w),
          real((p * ep - q * eq) / (p - q))};
}

/// Rounding of Exact: b, W^2 and the arguments of exp, cos and sin carry a few roundings each, which
/// they hand on multiplied by (b + omega) t at most (W^2 = omega^2 - b^2 may cancel, but S and C
/// depend on W^2 t^2, whose error is u b^2 t^2; the slow root w - b likewise). Ten roundings in all.
/// b times S is at most 1 in scaled coordinates unless the oscillator is overdamped, where S < 1/b.
double exact_tolerance(double omega, double zeta, double t) {
  const double bt = zeta * omega * t;
  return 10.0 * unit_roundoff * (1.0 + bt + omega * t) * (1.0 + std::fmin(bt, 1.0) * bt * std::exp(-bt));
}

TEST(Exact, AgreesWithTheClosedForm) {
  for (const double zeta : {0.0, 0.05, 0.5, 0.707, 0.9, 1.1, 1.5, 3.0, 20.0})
    for (const double omega : {1.0, 3.7e4})
      for (const double theta : {1e-3, 0.1, 1.0, 3.0, 10.0}) {
        const double t = theta / omega;
        const Matrix2 error = exact_map(oscillator_of(omega, zeta), omega, t) - closed_form(omega, zeta, t);
        EXPECT_LE(largest(error), exact_tolerance(omega, zeta, t)) << zeta << ' ' << omega << ' ' << theta;
      }
}

/// Critical: d = e^{-bt} [(1 + bt) d0 + t u0] and its derivative. Near-critical from both sides the
/// cosine and sine differ from 1 and Wt by (Wt)^2/2 and (Wt)^3/6; next terms (Wt)^4/24 < 1e-17 here.
TEST(Exact, AgreesWithTheCriticalFormAndItsNeighbours) {
  const double omega = 2.0;
  for (const double difference : {0.0, 1e-16, 1e-13, 1e-11, 1e-9, -1e-16, -1e-13, -1e-11, -1e-9})
    for (const double theta : {0.01, 0.5, 1.0}) {
      const double t = theta / omega;
      const Oscillator o = oscillator_of(omega, 1.0 + difference);
      const double b = o.damping / (2.0 * o.mass);
      const double square = (omega - b) * (omega + b) * t * t; // (Wt)^2, below 2e-9
      const double cosine = std::exp(-b * t) * (1.0 - square / 2.0);
      const double sine = std::exp(-b * t) * t * (1.0 - square / 6.0);
      const Matrix2 expected{cosine + b * sine, omega * sine, -omega * sine, cosine - b * sine};
      EXPECT_LE(largest(exact_map(o, omega, t) - expected), exact_tolerance(omega, 1.0, t))
          << difference << ' ' << theta;
    }
}

TEST(Exact, WithoutSpringTheDashpotStopsTheMotion) {
  const Oscillator o{0.0, 0.9, 0.7};
  const double rate = o.damping / o.mass;
  for (const double t : {1e-6, 0.3, 5.0, 1e5}) {
    const Propagator map = make_propagator<Exact>(o, t);
    EXPECT_DOUBLE_EQ(map.displacement_from_displacement, 1.0);
    EXPECT_NEAR(map.displacement_from_rate, -std::expm1(-rate * t) / rate, 10.0 * unit_roundoff * (1.0 / rate + t));
    EXPECT_EQ(map.rate_from_displacement, 0.0);
    EXPECT_NEAR(map.rate_from_rate, std::exp(-rate * t), 10.0 * unit_roundoff * (1.0 + rate * t));
  }
}

TEST(Exact, WithoutSpringAndDashpotTheMotionIsFree) {
  const Propagator map = make_propagator<Exact>({0.0, 0.0, 0.7}, 0.3);
  EXPECT_EQ(map.displacement_from_displacement, 1.0);
  EXPECT_EQ(map.displacement_from_rate, 0.3);
  EXPECT_EQ(map.rate_from_displacement, 0.0);
  EXPECT_EQ(map.rate_from_rate, 1.0);
}

/// No overflow and no growth however strong the damping and long the step: a damped oscillator never
/// exceeds its initial amplitude sqrt(d0^2 + (u0/omega)^2) in the energy norm, whose entries are these.
TEST(Exact, StaysBoundedForStrongDampingAndLongSteps) {
  const double omega = 1.0;
  for (double zeta = 0.1; zeta < 1e8; zeta *= 1.7)
    for (double theta = 1e-3; theta < 1e8; theta *= 1.7) {
      const Matrix2 map = exact_map(oscillator_of(omega, zeta), omega, theta);
      for (const double entry : {map.a, map.b, map.c, map.d}) {
        ASSERT_TRUE(std::isfinite(entry)) << zeta << ' ' << theta;
        ASSERT_LE(std::fabs(entry), 1.0 + 10.0 * unit_roundoff) << zeta << ' ' << theta;
      }
    }
}

/// exp(2 A) = exp(A) exp(A); the product of two maps of norm <= 1 adds their errors.
TEST(Exact, TwoHalfStepsAreOneStep) {
  for (const double zeta : {0.0, 0.3, 0.999999, 1.0, 1.000001, 2.5, 40.0})
    for (const double t : {0.05, 0.9, 4.0}) {
      const Oscillator o = oscillator_of(1.0, zeta);
      const Matrix2 half = exact_map(o, 1.0, 0.5 * t);
      EXPECT_LE(largest(half * half - exact_map(o, 1.0, t)), 4.0 * exact_tolerance(1.0, zeta, t)) << zeta << ' ' << t;
    }
}

/// An integrator from elsewhere. 1000 steps of an eighth-order method over omega t = 2, stiffest rate
/// 2 zeta omega = 6: truncation (6 * 2e-3)^8 = 4e-16 at most; rounding below 1000 * 20 roundings.
TEST(Exact, AgreesWithOdeint) {
  using State = std::array<double, 2>;
  constexpr int steps = 1000;
  for (const double zeta : {0.0, 0.4, 1.0, 3.0}) {
    const Oscillator o = oscillator_of(1.0, zeta);
    const auto derivative = [&o](const State &s, State &slope, double) {
      slope = {s[1], -o.force(s[0], s[1]) / o.mass};
    };
    State state{0.3, -0.8};
    boost::numeric::odeint::integrate_n_steps(boost::numeric::odeint::runge_kutta_fehlberg78<State>(), derivative,
                                              state, 0.0, 2.0 / steps, steps);
    const OscillatorState end = make_propagator<Exact>(o, 2.0)({0.3, -0.8});
    EXPECT_NEAR(end.displacement, state[0], 20.0 * steps * unit_roundoff);
    EXPECT_NEAR(end.rate, state[1], 20.0 * steps * unit_roundoff);
  }
}

/// Random oscillators and states; the predictor's formula worked step by step beside its map.
class Formula : public ::testing::Test {
protected:
  struct Sample {
    Oscillator o;
    OscillatorState s;
    double dt;
    double per_mass(double d, double u) const { return (o.stiffness * d + o.damping * u) / o.mass; }
    /// The largest acceleration times dt, and velocity, that appear: errors are some u of these.
    double scale() const {
      const double a = o.stiffness / o.mass * dt * dt + o.damping / o.mass * dt;
      return (std::fabs(s.displacement) / dt + std::fabs(s.rate)) * (1.0 + a) * (1.0 + a) * (1.0 + a) * (1.0 + a);
    }
  };

  Sample sample() {
    return {{uniform(0.1, 5.0), uniform(0.0, 3.0), uniform(0.2, 2.0)},
            {uniform(-1.0, 1.0), uniform(-1.0, 1.0)},
            uniform(0.01, 1.0)};
  }
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  static constexpr int samples = 1000;
  static constexpr double roundings = 60.0 * unit_roundoff; // no formula has more operations

  std::mt19937_64 random_{20050101};
};

TEST_F(Formula, RungeKutta2IsEquations31To34) {
  for (int n = 0; n < samples; ++n) {
    const Sample x = sample();
    const double d = x.s.displacement;
    const double u = x.s.rate;
    const double h = x.dt;
    const double u_half = u - h / 2.0 * x.per_mass(d, u);
    const double d_half = d + h / 2.0 * u;
    const double u_end = u - h * x.per_mass(d_half, u_half);
    const double d_end = d + h / 2.0 * (u + u_end);
    const OscillatorState end = make_propagator<RungeKutta2>(x.o, h)(x.s);
    EXPECT_NEAR(end.rate, u_end, roundings * x.scale());
    EXPECT_NEAR(end.displacement, d_end, roundings * x.scale() * h);
  }
}

TEST_F(Formula, RungeKutta4IsTheClassicalTableau) {
  for (int n = 0; n < samples; ++n) {
    const Sample x = sample();
    const double h = x.dt;
    double d[5];
    double u[5];
    const double weight[] = {0.0, 0.5, 0.5, 1.0};
    d[0] = u[0] = 0.0; // the slope before the first
    for (int k = 0; k < 4; ++k) {
      const double at_d = x.s.displacement + weight[k] * h * d[k];
      const double at_u = x.s.rate + weight[k] * h * u[k];
      d[k + 1] = at_u;
      u[k + 1] = -x.per_mass(at_d, at_u);
    }
    const OscillatorState end = make_propagator<RungeKutta4>(x.o, h)(x.s);
    EXPECT_NEAR(end.displacement, x.s.displacement + h / 6.0 * (d[1] + 2.0 * d[2] + 2.0 * d[3] + d[4]),
                roundings * x.scale() * h);
    EXPECT_NEAR(end.rate, x.s.rate + h / 6.0 * (u[1] + 2.0 * u[2] + 2.0 * u[3] + u[4]), roundings * x.scale());
  }
}

/// Implicit: the state it returns has to satisfy its own equations.
TEST_F(Formula, TrapezoidSatisfiesItsEquations) {
  for (int n = 0; n < samples; ++n) {
    const Sample x = sample();
    const double d = x.s.displacement;
    const double u = x.s.rate;
    const double h = x.dt;
    const OscillatorState end = make_propagator<Trapezoid>(x.o, h)(x.s);
    EXPECT_NEAR(end.displacement, d + h / 2.0 * (u + end.rate), roundings * x.scale() * h);
    EXPECT_NEAR(end.rate, u - h / 2.0 * (x.per_mass(d, u) + x.per_mass(end.displacement, end.rate)),
                roundings * x.scale());
  }
}

/// The same maps once more as matrix functions of the generator G = A dt: Taylor to the fourth order,
/// the Cayley transform, and for rk2, whose displacement is closed by the trapezoid, its own rows.
TEST_F(Formula, MapsAreFunctionsOfTheGenerator) {
  for (int n = 0; n < samples; ++n) {
    const Sample x = sample();
    const Matrix2 g = generator(x.o, 1.0, x.dt);
    const double norm = 1.0 + largest(g);
    const double tolerance = roundings * norm * norm * norm * norm * 4.0; // 2x2 products double a bound, twice
    const Matrix2 taylor = identity + g + 0.5 * (g * g) + (1.0 / 6.0) * (g * g * g) + (1.0 / 24.0) * (g * g * g * g);
    EXPECT_LE(largest(scaled(make_propagator<RungeKutta4>(x.o, x.dt), 1.0) - taylor), tolerance);
    const Matrix2 cayley = inverse(identity - 0.5 * g) * (identity + 0.5 * g);
    EXPECT_LE(largest(scaled(make_propagator<Trapezoid>(x.o, x.dt), 1.0) - cayley), tolerance);
    const Matrix2 midpoint = identity + g + 0.5 * (g * g);
    const Matrix2 rk2 = scaled(make_propagator<RungeKutta2>(x.o, x.dt), 1.0);
    EXPECT_NEAR(rk2.c, midpoint.c, tolerance);
    EXPECT_NEAR(rk2.d, midpoint.d, tolerance);
    EXPECT_NEAR(rk2.a, 1.0 + 0.5 * x.dt * midpoint.c, tolerance);
    EXPECT_NEAR(rk2.b, 0.5 * x.dt * (1.0 + midpoint.d), tolerance);
  }
}

/// Global error at omega t = 1 with n and 2n steps falls by 2^p (1 + O(h)): with h = 1/64 the observed
/// order is within a few h of p. Rounding, 1e-14, is far below the error of rk4, 1e-9.
TEST(Order, OfTheGlobalError) {
  const auto observed = [](const char *name, double zeta) {
    const Oscillator o = oscillator_of(1.0, zeta);
    const auto error = [&](int steps) {
      const Propagator map = find_predictor(name)->propagator(o, 1.0 / steps);
      OscillatorState s{0.6, 0.8};
      for (int n = 0; n < steps; ++n) s = map(s);
      const OscillatorState end = make_propagator<Exact>(o, 1.0)({0.6, 0.8});
      return std::hypot(s.displacement - end.displacement, s.rate - end.rate);
    };
    return std::log2(error(64) / error(128));
  };
  for (const double zeta : {0.0, 0.3, 1.0, 1.4}) {
    EXPECT_NEAR(observed("trapezoid", zeta), 2.0, 4.0 / 64.0) << zeta;
    EXPECT_NEAR(observed("rk2", zeta), 2.0, 4.0 / 64.0) << zeta;
    EXPECT_NEAR(observed("rk4", zeta), 4.0, 4.0 / 64.0) << zeta;
  }
}

/// Undamped, the prediction alone (Table 3). The scaled map is a rotation for exact and trapezoid;
/// rk2 has determinant 1 and complex eigenvalues below theta = 2; |R(i theta)|^2 of rk4 is
/// 1 - theta^6/72 + theta^8/576.
TEST(Energy, OfTheUndampedPrediction) {
  for (const double theta : {0.05, 0.3, 0.8, 1.3, 1.99}) {
    const Oscillator o = oscillator_of(1.0, 0.0);
    for (const char *name : {"exact", "trapezoid"}) {
      const Matrix2 m = scaled(find_predictor(name)->propagator(o, theta), 1.0);
      const Matrix2 transposed{m.a, m.c, m.b, m.d};
      EXPECT_LE(largest(transposed * m - identity), 20.0 * unit_roundoff) << name << ' ' << theta;
    }
    const Matrix2 rk2 = scaled(make_propagator<RungeKutta2>(o, theta), 1.0);
    EXPECT_NEAR(rk2.determinant(), 1.0, 60.0 * unit_roundoff) << theta;
    EXPECT_LT(std::fabs(rk2.trace()), 2.0) << theta;
    const Matrix2 rk4 = scaled(make_propagator<RungeKutta4>(o, theta), 1.0);
    const double t6 = std::pow(theta, 6.0);
    EXPECT_NEAR(rk4.determinant(), 1.0 - t6 / 72.0 + t6 * theta * theta / 576.0, 60.0 * unit_roundoff * (1.0 + t6))
        << theta;
  }
}

/// Limits of Table 3: of the prediction as an integrator of its own, undamped.
TEST(Stability, OfThePredictionAlone) {
  const auto radius = [](const char *name, double t_star) {
    return scaled(find_predictor(name)->propagator(oscillator_of(1.0, 0.0), pi * t_star), 1.0).spectral_radius();
  };
  const double rounding = 1e-7; // sqrt of the rounding of the discriminant, which vanishes at the limit
  const double off = 1e-3;
  EXPECT_LE(radius("rk2", 2.0 / pi * (1.0 - off)), 1.0 + rounding);
  EXPECT_GT(radius("rk2", 2.0 / pi * (1.0 + off)), 1.0 + off);
  EXPECT_LE(radius("rk4", 2.0 * std::sqrt(2.0) / pi * (1.0 - off)), 1.0);
  EXPECT_GT(radius("rk4", 2.0 * std::sqrt(2.0) / pi * (1.0 + off)), 1.0 + off);
  for (const double t_star : {0.1, 0.9, 1.0, 5.0, 300.0})
    for (const char *name : {"exact", "trapezoid"}) EXPECT_LE(radius(name, t_star), 1.0 + rounding) << name << t_star;
}

/// Damped maps contract: no predictor adds energy to a damped contact inside its limit.
TEST(Stability, DampingContracts) {
  for (const Predictor &p : predictors)
    for (const double zeta : {0.1, 0.5, 0.707, 1.0})
      for (const double theta : {0.01, 0.2, 0.6})
        EXPECT_LT(scaled(p.propagator(oscillator_of(1.0, zeta), theta), 1.0).spectral_radius(), 1.0)
            << p.name << ' ' << zeta << ' ' << theta;
}

} // namespace
} // namespace cfpm::testing
