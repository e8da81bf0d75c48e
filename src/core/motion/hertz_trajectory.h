// SPDX-License-Identifier: GPL-2.0-or-later
// The exact collision of two Hertz spheres. With the damping of the paper (Eq. 2 with a1 = 3/2, a2 = 1/4) the isolated
// contact m* d'' = -k d^(3/2) - h d^(1/4) d' is self-similar: with the rate r = sqrt(k/m*) and any l,
//   d = l^4 D(tau), d' = r l^5 U(tau), t = tau/(r l)
// solves it if D'' = -D^(3/2) - alpha D^(1/4) D', alpha = h/sqrt(k m*). The ratio S = U/D^(5/4) falls all along a
// contact, so that every state lies on the one trajectory that begins with D = 0, U = 1. Along it, with
// Q = 1 + alpha S + (5/4) S^2 and c = 2 alpha/sqrt(5 - alpha^2),
//   D^(5/2) = (5/4) exp(c (theta - pi/2))/Q, theta = atan((5 S + 2 alpha)/(2 sqrt(5 - alpha^2))), dS/dtau = -D^(1/4) Q,
// the force vanishes where S = -1/alpha, and the bodies part where D = 0, S = -infinity.
#pragma once

#include "core/law/linear_law.h"
#include "core/numbers/hermite_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace cfpm {

/// x^(1/5) for x > 0, normal: a guess from the exponent, right to 5 %, and three steps of Halley's method.
inline double fifth_root(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits = bits / 5 + 0x3325FFFFFFFFFFFFULL; // 4/5 of the bits of 1
  double y;
  std::memcpy(&y, &bits, sizeof y);
  for (int k = 0; k < 3; ++k) {
    const double square = y * y;
    const double fifth = square * square * y;
    y *= (2.0 * fifth + 3.0 * x) / (3.0 * fifth + 2.0 * x);
  }
  return y;
}

/// The trajectory of one alpha in [0, sqrt(5)), in tables. A state is found on it by p = (1 + |S|)^(-1/5), which grows
/// from 0 to 1 while the bodies approach and falls again; everything is smooth in p.
class HertzTrajectory {
public:
  /// tension: whether it ends where the bodies part, else where the force vanishes
  HertzTrajectory(double alpha, bool tension) : alpha_(alpha), root_(std::sqrt(5.0 - alpha * alpha)) {
    const double released = alpha > 0.0 && !tension ? std::pow(alpha / (1.0 + alpha), 0.2) : 0.0;
    const Branch approach(*this, 1.0, 0.0);
    const Branch retreat(*this, -1.0, released);
    approach_ = approach.phases(0.0, 1.0);
    retreat_ = retreat.phases(approach.duration(), -1.0);
    duration_ = approach.duration() + retreat.duration();
    release_ = point(-1.0, released).state();
    // where the overlap would vanish if the speed stayed: a state is smooth in the fourth root of the time from there
    vanishing_ = duration_ + release_[0] / -release_[1];
    middle_ = 0.5 * duration_;
    const auto at = [&](double phase, double phase_slope) {
      const double before = approach.duration();
      const Point p = phase < before ? point(1.0, approach.find(phase)) : point(-1.0, retreat.find(duration_ - phase));
      const auto [d, u] = p.state();
      const double acceleration = -d * std::sqrt(d) - alpha_ * std::sqrt(std::sqrt(d)) * u;
      return Table::Node{{d, u}, {u * phase_slope, acceleration * phase_slope}};
    };
    early_ = Table(0.0, fourth_root(middle_), cells, [&](double x) { return at(x * x * x * x, 4.0 * x * x * x); });
    late_ = Table(fourth_root(vanishing_ - duration_), fourth_root(vanishing_ - middle_), cells,
                  [&](double x) { return at(std::min(duration_, vanishing_ - x * x * x * x), -4.0 * x * x * x); });
  }

  /// From touch to release, in tau.
  double duration() const { return duration_; }
  /// D, U at release; -U is the restitution.
  const std::array<double, 2> &release() const { return release_; }

  struct Place {
    double phase; ///< tau since touch
    double scale; ///< l over (|u|/r + d^(5/4))^(1/5)
  };
  /// Of a state with 0 < p, in contact. p: see above; approaching: u >= 0.
  Place place(double p, bool approaching) const {
    const auto [phase, scale] = approaching ? approach_(p) : retreat_(p);
    return {phase, scale};
  }

  /// D, U at a phase within the contact.
  std::array<double, 2> state(double phase) const {
    return phase < middle_ ? early_(fourth_root(phase)) : late_(fourth_root(vanishing_ - phase));
  }

private:
  using Table = HermiteTable<2>;
  static constexpr std::size_t cells = 512;

  static double fourth_root(double x) { return std::sqrt(std::sqrt(std::max(0.0, x))); }

  /// All that follows from p and the sign of S in closed form, in terms that stay finite at p = 0.
  struct Point {
    double p;
    double reduced_ratio; ///< p^5 S
    double reduced_q;     ///< p^10 Q
    double decay;         ///< (5/4) exp(c (theta - pi/2))

    std::array<double, 2> state() const {
      const double amplitude = std::sqrt(decay / reduced_q);
      return {p * p * p * p * std::pow(amplitude, 0.8), reduced_ratio * amplitude};
    }
    double scale() const { return std::pow(reduced_q / decay, 0.1); }
    double phase_slope() const { return 5.0 * p * p * p / (std::pow(reduced_q, 0.9) * std::pow(decay, 0.1)); }
  };

  Point point(double sign, double p) const {
    const double fifth = p * p * p * p * p;
    const double ratio = sign * (1.0 - fifth);
    const double q = fifth * fifth + alpha_ * fifth * ratio + 1.25 * ratio * ratio;
    const double theta = std::atan2(5.0 * ratio + 2.0 * alpha_ * fifth, 2.0 * root_ * fifth);
    return {p, ratio, q, 1.25 * std::exp(2.0 * alpha_ / root_ * (theta - 0.5 * pi))};
  }

  /// d(scale)/dp
  double scale_slope(double sign, const Point &x) const {
    const double fourth = x.p * x.p * x.p * x.p;
    const double fifth = fourth * x.p;
    const double q_slope = 10.0 * fourth * fifth + 5.0 * alpha_ * fourth * x.reduced_ratio -
                           sign * 5.0 * fourth * (alpha_ * fifth + 2.5 * x.reduced_ratio);
    return 0.1 * x.scale() * (q_slope + sign * 5.0 * alpha_ * fourth) / x.reduced_q;
  }

  /// Approach or retreat: the time since p = first by quadrature.
  class Branch {
  public:
    Branch(const HertzTrajectory &of, double sign, double first) : of_(of), sign_(sign), first_(first), times_(1, 0.0) {
      for (std::size_t k = 0; k < cells; ++k) times_.push_back(times_.back() + integral(node(k), node(k + 1)));
    }

    double duration() const { return times_.back(); }

    /// p at a time since p = first.
    double find(double time) const {
      const auto above = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
      const auto cell = static_cast<std::size_t>(above - times_.begin()) - 1;
      const double low = node(cell);
      double p = node(cell + 1); // Newton's method from above: the slope grows with p where it is small
      for (double step = p; p > low && std::fabs(step) > 1e-15;) {
        step = (times_[cell] + integral(low, p) - time) / of_.point(sign_, p).phase_slope();
        p = std::max(low, p - step);
      }
      return p;
    }

    /// Phase and scale over p. The phase is start plus or, in retreat, minus the time that is left.
    Table phases(double start, double forward) const {
      std::size_t k = 0;
      return Table(first_, 1.0, cells, [&](double p) {
        const Point x = of_.point(sign_, p);
        const double time = times_[k++];
        const double phase = forward > 0.0 ? start + time : start + (duration() - time);
        const double slope = p > 0.0 ? x.phase_slope() : 0.0;
        return Table::Node{{phase, x.scale()}, {forward * slope, of_.scale_slope(sign_, x)}};
      });
    }

  private:
    double node(std::size_t k) const {
      return first_ + (1.0 - first_) * static_cast<double>(k) / static_cast<double>(cells);
    }

    /// Of the time over p, by three Gauss points.
    double integral(double from, double to) const {
      const double middle = 0.5 * (from + to);
      const double half = 0.5 * (to - from);
      const auto slope = [&](double x) { return of_.point(sign_, middle + half * x).phase_slope(); };
      const double outer = std::sqrt(0.6);
      return half * (5.0 * slope(-outer) + 8.0 * slope(0.0) + 5.0 * slope(outer)) / 9.0;
    }

    const HertzTrajectory &of_;
    double sign_;
    double first_;
    std::vector<double> times_;
  };

  double alpha_;
  double root_; ///< sqrt(5 - alpha^2)
  double duration_ = 0.0;
  double vanishing_ = 0.0;
  double middle_ = 0.0;
  std::array<double, 2> release_{};
  Table approach_, retreat_; ///< phase and scale over p
  Table early_, late_;       ///< D and U over the fourth root of the time from where D vanishes
};

} // namespace cfpm
