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
#include "core/numbers/pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cfpm {

/// A trajectory as it is read. R: double, or a Pack of which each lane may have its own.
template <class R> struct BasicHertzTrajectory {
  HermiteCells<R> approach, retreat; ///< phase and scale over p, see HertzTrajectory
  HermiteCells<R> early, late;       ///< D and U over the fourth root of the time from where D vanishes
  R duration;                        ///< from touch to release, in tau
  R middle;                          ///< half of it: up to there a time is early
  R vanishing;                       ///< where the overlap would vanish if the speed stayed as at release
  R release_overlap;                 ///< D at release
  R release_speed;                   ///< U at release, minus the restitution
  TableNumbers<R> numbers;

  struct Place {
    R phase; ///< tau since touch
    R scale; ///< l over (|u|/r + d^(5/4))^(1/5)
  };
  /// Of a state with 0 < p, in contact. p: see HertzTrajectory; approaching: whether u >= 0.
  template <class Condition> [[gnu::always_inline]] Place place(const R &p, const Condition &approaching) const {
    const std::array<R, 2> found = either(approaching, approach, retreat).template interpolate<2>(numbers, p);
    return {found[0], found[1]};
  }

  /// D, U at release.
  [[gnu::always_inline]] std::array<R, 2> release() const { return {release_overlap, release_speed}; }

  /// D, U at a phase within the contact.
  [[gnu::always_inline]] std::array<R, 2> state(const R &phase) const {
    using std::sqrt;
    const auto is_early = phase < middle;
    const R time = larger(R(0.0), select(is_early, phase, vanishing - phase));
    return either(is_early, early, late).template interpolate<2>(numbers, R(sqrt(R(sqrt(time)))));
  }

private:
  template <class Condition> [[gnu::always_inline]] static HermiteCells<R>
  either(const Condition &condition, const HermiteCells<R> &a, const HermiteCells<R> &b) {
    return {select(condition, a.first, b.first), select(condition, a.per_spacing, b.per_spacing), a.count,
            select(condition, a.behind, b.behind)};
  }
};

/// The trajectory of one alpha in [0, sqrt(5)), in tables. A state is found on it by p = (1 + |S|)^(-1/5), which grows
/// from 0 to 1 while the bodies approach and falls again; everything is smooth in p.
class HertzTrajectory {
public:
  /// tension: whether it ends where the bodies part, else where the force vanishes
  HertzTrajectory(double alpha, bool tension) : alpha_(alpha), root_(std::sqrt(5.0 - alpha * alpha)) {
    const double released = alpha > 0.0 && !tension ? std::pow(alpha / (1.0 + alpha), 0.2) : 0.0;
    const Branch approach(*this, 1.0, 0.0);
    const Branch retreat(*this, -1.0, released);
    tables_.approach = approach.phases(0.0, 1.0).join(numbers_);
    tables_.retreat = retreat.phases(approach.duration(), -1.0).join(numbers_);
    const double duration = approach.duration() + retreat.duration();
    const auto [release_overlap, release_speed] = point(-1.0, released).state();
    // a state is smooth in the fourth root of the time from there
    const double vanishing = duration + release_overlap / -release_speed;
    const double middle = 0.5 * duration;
    const auto at = [&](double phase, double phase_slope) {
      const double before = approach.duration();
      const Point p = phase < before ? point(1.0, approach.find(phase)) : point(-1.0, retreat.find(duration - phase));
      const auto [d, u] = p.state();
      const double acceleration = -d * std::sqrt(d) - alpha_ * std::sqrt(std::sqrt(d)) * u;
      return Table::Node{{d, u}, {u * phase_slope, acceleration * phase_slope}};
    };
    tables_.early = Table(0.0, fourth_root(middle), cells, [&](double x) {
                      return at(x * x * x * x, 4.0 * x * x * x);
                    }).join(numbers_);
    tables_.late = Table(fourth_root(vanishing - duration), fourth_root(vanishing - middle), cells, [&](double x) {
                     return at(std::min(duration, vanishing - x * x * x * x), -4.0 * x * x * x);
                   }).join(numbers_);
    tables_.duration = duration;
    tables_.middle = middle;
    tables_.vanishing = vanishing;
    tables_.release_overlap = release_overlap;
    tables_.release_speed = release_speed;
    tables_.numbers = {numbers_.data()};
  }
  HertzTrajectory(const HertzTrajectory &) = delete; ///< what has been read points into it
  HertzTrajectory &operator=(const HertzTrajectory &) = delete;

  /// Valid as long as this is.
  const BasicHertzTrajectory<double> &tables() const { return tables_; }

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
  std::vector<double> numbers_;
  BasicHertzTrajectory<double> tables_{};
};

} // namespace cfpm
