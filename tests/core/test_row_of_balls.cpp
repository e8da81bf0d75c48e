// SPDX-License-Identifier: GPL-2.0-or-later
// Several impacts at once, which impulses of single contacts do not know of: a row of balls at rest that one more hits.
#include "core/method/impulses/crowd.h"
#include "core/method/impulses/linear_impulse.h"
#include "core/method/method.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace cfpm::testing {
namespace {

constexpr double speed = 0.01; // of the ball that hits, in diameters per contact time; the mass is 1

LinearLaw law_with(double restitution) {
  const double stiffness = 0.5 * pi * pi; // a contact of two balls lasts 1
  const double log_e = std::log(restitution);
  const double zeta = -log_e / std::sqrt(log_e * log_e + pi * pi);
  return {stiffness, 2.0 * zeta * std::sqrt(0.5 * stiffness), 0.0, 0.0, 0.0, with_tension};
}

/// Steps as the loop over pairs and the integrator do, in one dimension.
class Row {
public:
  Row(std::size_t count, const LinearLaw &law, double dt, double gap, double ahead)
      : law_(law), impulse_(law, 0.5, 0.5 / 3.5, dt), dt_(dt), x_(count), v_(count, 0.0), contacts_(count, 0.0) {
    for (std::size_t i = 0; i < count; ++i) x_[i] = static_cast<double>(i) * (1.0 + gap);
    x_[0] -= ahead;
    v_[0] = speed;
  }

  /// Kinetic and elastic.
  double energy() const {
    double sum = 0.0;
    for (const double v : v_) sum += 0.5 * v * v;
    for (std::size_t i = 0; i + 1 < x_.size(); ++i)
      sum += 0.5 * law_.normal_stiffness * std::pow(std::max(0.0, 1.0 - (x_[i + 1] - x_[i])), 2.0);
    return sum;
  }

  void step() {
    std::vector<double> change(v_.size(), 0.0);
    std::vector<double> shift(v_.size(), 0.0);
    std::vector<double> contacts(v_.size(), 0.0);
    const Crowd before{contacts_.data()};
    for (std::size_t i = 0; i + 1 < v_.size(); ++i) {
      const double closing = v_[i] - v_[i + 1];
      const double overlap = 1.0 - (x_[i + 1] - x_[i]);
      const double wait = overlap < 0.0 ? -overlap / std::max(closing, 1e-300) : 0.0;
      if (!(wait < dt_)) continue;
      const double others = before.others(static_cast<int>(i), 1.0) + before.others(static_cast<int>(i) + 1, 1.0);
      const double span = dt_ - wait;
      const double now = std::max(0.0, overlap);
      const NormalImpulse n = others > 0.0 ? impulse_.normal_in_crowd(now, closing, span, crowding(others, 0.5))
                                           : impulse_.normal(now, closing, span);
      const double moved = others > 0.0 ? 0.0 : n.time_moment - 0.5 * dt_ * n.impulse;
      change[i] -= n.impulse;
      change[i + 1] += n.impulse;
      shift[i] -= moved;
      shift[i + 1] += moved;
      for (const std::size_t k : {i, i + 1}) contacts[k] += n.contact_time > 0.0 ? 1.0 : 0.0;
    }
    for (std::size_t i = 0; i < v_.size(); ++i) {
      x_[i] += dt_ * (v_[i] + 0.5 * change[i]) + shift[i];
      v_[i] += change[i];
    }
    contacts_ = contacts;
  }

private:
  LinearLaw law_;
  LinearImpulse impulse_;
  double dt_;
  std::vector<double> x_, v_, contacts_;
};

/// The largest energy over that of the start, of rows with gaps from none to the way of some steps, and all phases.
double largest_energy(std::size_t count, double restitution, double nt) {
  std::mt19937 random(3);
  const auto uniform = [&] { return std::uniform_real_distribution<>(0.0, 1.0)(random); };
  double largest = 0.0;
  for (int k = 0; k < 20; ++k) {
    const double gap = (k % 2 == 0 ? 0.0 : 2.0 * uniform()) * speed;
    Row row(count, law_with(restitution), 1.0 / nt, gap, uniform() * speed / nt);
    const double start = row.energy();
    for (int n = 0; n < 60 * nt; ++n) {
      row.step();
      largest = std::max(largest, row.energy() / start);
    }
  }
  return largest;
}

TEST(RowOfBalls, NeverHasMoreEnergyThanAtItsStart) { // from the step on below which the report warns
  for (const std::size_t count : {3u, 5u, 10u})
    for (const double e : {0.5, 0.7, 0.9, 0.95, 0.98})
      for (const double times : {1.0, 1.5}) {
        const double nt = times * PredictedImpulse::keeps_energy_from(e);
        EXPECT_LE(largest_energy(count, e, nt), 1.0 + 1e-12) << count << " " << e << " " << nt;
      }
}

TEST(RowOfBalls, HasMoreAtFewerStepsThanTheDocsAllow) { // docs/pair_gran_cfpm.md, which say so
  EXPECT_GT(largest_energy(10, 0.9, 2.0), 1.05);
  EXPECT_GT(largest_energy(10, 0.9, 1.0), 100.0);
  for (const double nt : {4.0, 10.0, 30.0}) { // at e = 1 about 1/nt^2, from which keeps_energy_from() follows
    const double gained = largest_energy(10, 1.0, nt) - 1.0;
    EXPECT_GT(gained, 0.5 / (nt * nt)) << nt;
    EXPECT_LT(gained, 1.1 / (nt * nt)) << nt;
  }
}

} // namespace
} // namespace cfpm::testing
