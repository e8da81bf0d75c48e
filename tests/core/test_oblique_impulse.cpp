// SPDX-License-Identifier: GPL-2.0-or-later
// The exact impulse of spheres that meet obliquely, against rigid bodies that are integrated finely
// (isolated_contact.h). Over a step the impulse is that of a contact whose normal stands still, halfway through it. So
// the steps, or a contact inside one, leave an error that falls with some power of the step: the order. An error in a
// formula leaves one of a lower order, or one that stays. The tests measure the order, with no tolerance to choose: as
// measured it must round to what is claimed, or to more. The steps shift against the touch and the release as they
// become shorter, which scatters the errors: the largest of some shifts counts.
#include "impulse_run.h"
#include "isolated_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace cfpm::testing {
namespace {

constexpr double second_order = 1.5; // rounds to 2
constexpr double first_order = 0.5;

constexpr double reduced_mass = 0.0075; // of 10 g and 30 g
constexpr double duration = 1e-3;       // of an undamped contact, about
constexpr double kn = reduced_mass * pi * pi / (duration * duration);
const double hn = 0.6 * std::sqrt(kn * reduced_mass); // restitution about 0.4
constexpr double kn_hertz = 60.0 * kn;
const double hn_hertz = 0.6 * std::sqrt(kn_hertz * reduced_mass);
constexpr double through = 1.6 * duration; // from before the touch to behind the release
constexpr double within = 0.8 * duration;  // to before the release

/// Two unlike spheres shortly before they touch.
TwoBalls meeting(const Vec3 &passing, const Vec3 &spin_a, const Vec3 &spin_b, double gap) {
  const Vec3 n{0.6, 0.0, 0.8};
  const double reach = 0.025;
  return {{0.010, 0.010, (reach + gap) * n, passing + -0.6 * n, spin_a}, {0.015, 0.030, {}, {}, spin_b}};
}

/// All in a plane: passing 1 m/s across the normal while closing at 0.6 m/s.
TwoBalls in_a_plane(double gap) { return meeting({0.8, 0.0, -0.6}, {0.0, 20.0, 0.0}, {0.0, 30.0, 0.0}, gap); }

/// Every component of velocity and spin has a part in it.
TwoBalls in_space(double gap) { return meeting({0.5, 0.9, -0.5}, {20.0, -30.0, 50.0}, {-10.0, 40.0, 20.0}, gap); }

/// Of velocity, spin and place, all as a velocity [m/s].
double difference(const TwoBalls &one, const TwoBalls &other, double time_of_place) {
  double largest = 0.0;
  const auto compare = [&](const Ball &p, const Ball &q) {
    largest = std::max({largest, norm(p.v - q.v), p.radius * norm(p.omega - q.omega), norm(p.x - q.x) / time_of_place});
  };
  compare(one.a, other.a);
  compare(one.b, other.b);
  return largest;
}

/// A length of the n-th step, when the mean step is dt.
using Steps = std::function<double(double dt, int n)>;

TwoBalls with_steps(const Coefficients &law, const TwoBalls &balls, double time, double dt, const Steps &steps) {
  const auto step = [&](int n) { return steps(dt, n); };
  return law.hertz ? stepped<HertzLaw>(law, balls, time, step) : stepped<LinearLaw>(law, balls, time, step);
}

double equal(double dt, int) { return dt; }
double alternating(double dt, int n) { return n % 2 == 0 ? 1.5 * dt : 0.5 * dt; }

/// [m], that shift a touch against the steps.
constexpr double gaps[] = {1e-5, 2.3e-5, 3.9e-5, 5.4e-5, 6.2e-5};

/// How the error falls from 16 steps to 128: of the largest for touches at different places
/// inside a step. balls: that meet after a gap.
double order(const Coefficients &law, TwoBalls (*balls)(double gap), double time = through,
             const Steps &steps = equal) {
  double coarse = 0.0;
  double fine = 0.0;
  for (const double gap : gaps) {
    const TwoBalls start = balls(gap);
    const TwoBalls exact = IsolatedContact(law, start).after(time, 20000);
    coarse = std::max(coarse, difference(with_steps(law, start, time, time / 16, steps), exact, time));
    fine = std::max(fine, difference(with_steps(law, start, time, time / 128, steps), exact, time));
  }
  return std::log2(coarse / fine) / 3.0;
}

/// Bodies that stick, held by a spring: damped only along the normal. Up to before the release, where a force ends that
/// does not vanish by itself. In still finer steps a rest of first order shows, a hundredth of the error at 16 steps.
/// Most of it comes from unlike sizes: both bodies share the mean change of their levers.
TEST(ObliqueImpulse, OfBodiesThatStickInAPlaneIsOfSecondOrder) {
  const Coefficients law{false, kn, hn, 0.4 * kn, 0.0, 1e6};
  EXPECT_GT(order(law, in_a_plane, within), second_order);
}

TEST(ObliqueImpulse, OfBodiesThatStickInAPlaneIsOfSecondOrderWhenTheStepChanges) {
  const Coefficients law{false, kn, hn, 0.4 * kn, 0.0, 1e6};
  EXPECT_GT(order(law, in_a_plane, within, alternating), second_order);
}

/// Where the friction depends on the slip velocity, that of the beginning of the step stands for the whole: the turning
/// of the normal inside the step does not change it. That costs an order.
TEST(ObliqueImpulse, OfBodiesThatSlideIsOfFirstOrder) {
  EXPECT_GT(order({false, kn, hn, 0.0, 1e6, 0.2, 0.0, true}, in_space), first_order);
  EXPECT_GT(order({true, kn_hertz, hn_hertz, 0.0, 1e6, 0.2, 0.0, true}, in_space), first_order);
}

TEST(ObliqueImpulse, OfBodiesThatStickAndSlideIsOfFirstOrder) {
  EXPECT_GT(order({false, kn, hn, 0.8 * kn, 0.3 * hn, 0.3}, in_space), first_order);
  EXPECT_GT(order({true, kn_hertz, hn_hertz, 1.2 * kn_hertz, 0.3 * hn_hertz, 0.3}, in_space), first_order);
}

/// Without a dashpot: what keeps the spring from pulling harder than Coulomb allows is its slackening alone.
TEST(ObliqueImpulse, SlackensTheSpringOfBodiesThatSlide) {
  EXPECT_GT(order({false, kn, hn, 0.8 * kn, 0.0, 0.3}, in_space), first_order);
  EXPECT_GT(order({true, kn_hertz, hn_hertz, 1.2 * kn_hertz, 0.0, 0.3}, in_space), first_order);
}

/// With a dashpot so strong that it matters where it ends, and that a limit on both would be another motion.
TEST(ObliqueImpulse, LosesTheDashpotWhereTheSpringSlides) {
  for (const bool hertz : {false, true}) {
    Coefficients law = hertz ? Coefficients{true, kn_hertz, hn_hertz, 1.2 * kn_hertz, 2.0 * hn_hertz, 0.3}
                             : Coefficients{false, kn, hn, 0.8 * kn, 2.0 * hn, 0.3};
    EXPECT_GT(order(law, in_space), first_order);
    const TwoBalls start = in_space(1e-5);
    const TwoBalls exact = IsolatedContact(law, start).after(through, 20000);
    law.together = true;
    const TwoBalls together = IsolatedContact(law, start).after(through, 20000);
    law.together = false;
    EXPECT_LT(difference(with_steps(law, start, through, through, equal), exact, through),
              0.2 * difference(together, exact, through));
  }
}

/// Inside a part of a contact too: what the dashpot gives over half a part is a tenth of what the rules differ by,
/// about. Bodies that only spin, so that the normal stands still, and touches at different places inside a step, so
/// that the parts shift against the beginning of the sliding.
TEST(ObliqueImpulse, LosesTheDashpotInsideAPart) {
  const auto spinning = [](double gap) { return meeting({}, {0.0, 20.0, 0.0}, {0.0, 30.0, 0.0}, gap); };
  for (const bool hertz : {false, true}) {
    Coefficients law = hertz ? Coefficients{true, kn_hertz, hn_hertz, 1.2 * kn_hertz, 0.3 * hn_hertz, 0.3}
                             : Coefficients{false, kn, hn, 0.8 * kn, 0.3 * hn, 0.3};
    double error = 0.0;
    double rules = 0.0;
    for (const double gap : gaps) {
      const TwoBalls start = spinning(gap);
      law.together = true;
      const TwoBalls together = IsolatedContact(law, start).after(through, 20000);
      law.together = false;
      const TwoBalls exact = IsolatedContact(law, start).after(through, 20000);
      error = std::max(error, difference(with_steps(law, start, through, through / 16, equal), exact, through));
      rules = std::max(rules, difference(together, exact, through));
    }
    EXPECT_LT(error, 0.1 * rules);
  }
}

/// With a dashpot so strong that both rules differ by far more than the step's error: the spring may even push.
TEST(ObliqueImpulse, SlackensTheSpringTogetherWithItsDashpot) {
  Coefficients law{false, kn, hn, 0.8 * kn, 2.0 * hn, 0.3};
  for (const bool hertz : {false, true}) {
    if (hertz) law = {true, kn_hertz, hn_hertz, 1.2 * kn_hertz, 2.0 * hn_hertz, 0.3};
    const TwoBalls start = in_space(1e-5);
    const TwoBalls alone = IsolatedContact(law, start).after(through, 20000);
    law.together = true;
    EXPECT_GT(order(law, in_space), first_order);
    const TwoBalls exact = IsolatedContact(law, start).after(through, 20000);
    EXPECT_LT(difference(with_steps(law, start, through, through / 128, equal), exact, through),
              0.2 * difference(alone, exact, through));
  }
}

/// Where nothing but roundings slips, up to the release of a contact whose stiffness vanishes there.
TEST(ObliqueImpulse, TakesRoundingsForNoSlip) {
  for (const bool together : {false, true})
    for (int k = 0; k < 50; ++k) {
      const Coefficients law{true, kn_hertz, 0.0, 0.8 * kn_hertz, 0.0, 0.3, 0.0, together};
      const TwoBalls start{{0.010, 0.010, {0.0, 0.0, 0.025 + 1e-6 * (k + 0.37)}, {1e-16, 0.0, -0.3}, {}},
                           {0.015, 0.030, {}, {}, {}}};
      const TwoBalls end = with_steps(law, start, 2.0 * duration, duration / 20, equal);
      EXPECT_NEAR(end.a.v.z - end.b.v.z, 0.3, 1e-9);
      EXPECT_LT(std::fabs(end.a.v.x), 1e-12);
    }
}

/// As large as the normal force, about.
constexpr double cohesive = 10.0;

TEST(ObliqueImpulse, CountsCohesionInCoulombsLimit) {
  EXPECT_GT(order({false, kn, hn, 0.0, 1e6, 0.1, cohesive, true}, in_space), first_order);
  EXPECT_GT(order({false, kn, hn, 0.8 * kn, 0.0, 0.1, cohesive}, in_space), first_order);
  EXPECT_GT(order({true, kn_hertz, hn_hertz, 1.2 * kn_hertz, 0.0, 0.1, cohesive}, in_space), first_order);
}

/// One step from before the touch to behind the release. Here the contact time takes the part of the step: the harder
/// the bodies, the less does the normal turn. Without friction nothing else is approximate; without damping the force
/// is the same before and behind the middle of the contact, so that the normal of the middle stands for all of it to
/// second order. With damping the force comes early, and the order is the first.
double order_in_hardness(bool hertz, double damping) {
  const auto error = [&](double hardness) {
    const double k = hardness * (hertz ? kn_hertz : kn);
    const Coefficients law{hertz, k, damping * std::sqrt(k * reduced_mass), 0.0, 0.0, 0.0};
    const TwoBalls balls = meeting({0.5, 0.9, -0.5}, {}, {}, 3e-5);
    return difference(with_steps(law, balls, through, through, equal),
                      IsolatedContact(law, balls).after(through, 20000), through);
  };
  const double hardness = 256.0;
  return std::log2(error(1.0) / error(hardness)) / ((hertz ? 0.4 : 0.5) * std::log2(hardness)); // tc ~ k^(-1/2), -2/5
}

TEST(ObliqueImpulse, OfAWholeCollisionIsOfSecondOrderInItsDuration) {
  EXPECT_GT(order_in_hardness(false, 0.0), second_order);
  EXPECT_GT(order_in_hardness(true, 0.0), second_order);
}

TEST(ObliqueImpulse, OfAWholeDampedCollisionIsOfFirstOrderInItsDuration) {
  EXPECT_GT(order_in_hardness(false, 0.6), first_order);
  EXPECT_GT(order_in_hardness(true, 0.6), first_order);
}

} // namespace
} // namespace cfpm::testing
