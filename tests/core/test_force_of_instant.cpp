// SPDX-License-Identifier: GPL-2.0-or-later
// Forces of one instant by the hosts' laws, in closed form; the bits of the hosts' own styles are compared in
// tests/lammps and tests/liggghts, test_stock_equality.py. And packs of any width give the bits of one contact.
#include "core/method/conventional/force_of_instant.h"
#include "core/method/conventional/limited_spring.h"
#include "core/method/conventional/limited_with_dashpot.h"
#include "core/method/conventional/turned_spring.h"
#include "core/numbers/instruction_set.h"
#include "core/step/packed_pairs.h"
#include "instant_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace cfpm::testing {
namespace {

using Pair = BasicSpherePair<double>;
template <Friction kind = Friction::spring_and_dashpot, class Law>
BasicPairForce<double> act(const Law &law, const Pair &pair, Vec3 &spring) {
  return PackedForceOfInstant::act<kind>(law, pair, OneSpring{&spring});
}

constexpr double kn = 2e4; // [N/m], Hertz [N/m^2]
constexpr double gn = 3.0; // [kg/s], Hertz [kg/(s m)]
constexpr double kt = 8e3; // likewise
constexpr double gt = 1.0; // likewise
constexpr double mu = 0.5; // [-]

/// i to the right of j, coming nearer and passing upwards.
Pair meeting(double passing = 0.0, double speed = closing) {
  return {{distance, 0.0, 0.0}, distance * distance, radius_i, radius_j, {{-speed, passing, 0.0}, {}}, {{}, {}}};
}

template <class Growth = HookeGrowth> LimitedWithDashpot<Growth, double> with_dashpot(double least = with_tension) {
  return {kn, gn, kt, gt, mu, least, dt};
}
LimitedSpring<HookeCoefficients, double> spring_alone(double least = with_tension) {
  return {{{kn, gn, kt, gt, mu, least}}, dt};
}
LimitedSpring<HertzStiffnessCoefficients, double> spring_alone_per_area(double reduced_mass) {
  const double radius = radius_i * radius_j / (radius_i + radius_j);
  return {{radius, reduced_mass, kn, gn / reduced_mass, kt, gt / reduced_mass, mu, with_tension}, dt};
}
LimitedSpring<HertzCoefficients, double> spring_alone_of_materials(double young, double shear, double mass, double c) {
  const double radius = radius_i * radius_j / (radius_i + radius_j);
  return {{radius, mass, 4.0 / 3.0 * young, 2.0 * young, 8.0 * shear, c, 0.5 * c, mu, with_tension}, dt};
}

/// Constant terms alone, those that grow with the radius of the contact area, or the damping of a restitution.
template <GranularOrder order = GranularOrder::of_2021>
TurnedSpring<order, double> turned_spring(double least = with_tension) {
  return {{kn, 0.0, gn, 0.0, 0.0, 0.0, kt, 0.0, gt / gn, mu, least}, 0.00375, 1e-3, dt};
}
template <GranularOrder order> TurnedSpring<order, double> turned_spring_per_area(double reduced_mass) {
  const double radius = radius_i * radius_j / (radius_i + radius_j);
  return {{0.0, kn, 0.0, 0.0, gn / reduced_mass, 0.0, 0.0, kt, gt / gn, mu, with_tension}, radius, reduced_mass, dt};
}
template <GranularOrder order>
TurnedSpring<order, double> turned_spring_of_restitution(double reduced_mass, double damping_ratio) {
  const double radius = radius_i * radius_j / (radius_i + radius_j);
  return {{0.0, kn, 0.0, 0.0, 0.0, damping_ratio, 0.0, kt, 0.5, mu, with_tension}, radius, reduced_mass, dt};
}

/// check(order): of a type whose value is the order.
template <class Check> void in_every_order(const Check &check) {
  check(std::integral_constant<GranularOrder, GranularOrder::of_2021>{});
  check(std::integral_constant<GranularOrder, GranularOrder::of_2025>{});
  check(std::integral_constant<GranularOrder, GranularOrder::of_2026>{});
}

void expect_near(double found, double expected) { EXPECT_NEAR(found, expected, rounding * std::fabs(expected)); }

TEST(ForceOfInstant, OfAHeadOnContactIsThatOfSpringAndDashpot) {
  const double linear = kn * overlap + gn * closing;
  const double young = 5e6;
  const double mass = 1e-3;
  const double c = 0.4;
  const double stiffness = 4.0 / 3.0 * young * area_radius;
  const double damping = c * std::sqrt(1.5 * stiffness * mass);
  Vec3 spring{};
  for (const auto &[found, expected] :
       {std::pair{act(with_dashpot(), meeting(), spring), linear},
        std::pair{act(with_dashpot<HertzGrowth>(), meeting(), spring), area_radius * linear},
        std::pair{act(spring_alone(), meeting(), spring), linear},
        std::pair{act(spring_alone_per_area(mass), meeting(), spring), area_radius * linear},
        std::pair{act(spring_alone_of_materials(young, 2e6, mass, c), meeting(), spring),
                  stiffness * overlap + damping * closing}}) {
    expect_near(found.mean.force.x, expected);
    EXPECT_EQ(found.mean.force.y, 0.0);
    EXPECT_TRUE(found.mean.torque_per_lever == Vec3{});
    EXPECT_TRUE(spring == Vec3{});
  }
}

TEST(ForceOfInstant, OfAHeadOnContactIsTheSameInEveryOrder) {
  const double linear = kn * overlap + gn * closing;
  const double mass = 1e-3;
  const double stiffness = kn * area_radius;
  Vec3 spring{};
  in_every_order([&](auto order) {
    expect_near(act(turned_spring<order()>(), meeting(), spring).mean.force.x, linear);
    expect_near(act(turned_spring_per_area<order()>(mass), meeting(), spring).mean.force.x, area_radius * linear);
    expect_near(act(turned_spring_of_restitution<order()>(mass, 0.4), meeting(), spring).mean.force.x,
                stiffness * overlap + 0.4 * std::sqrt(mass * stiffness) * closing);
    // rounded to 0: then nothing is damped by the stiffness either
    Pair touching = meeting();
    touching.radius_i = distance - radius_j;
    ASSERT_EQ(touching.radius_i + radius_j - distance, 0.0);
    EXPECT_EQ(act(turned_spring_of_restitution<order()>(mass, 0.4), touching, spring).mean.force.x, 0.0);
  });
}

/// Parting so fast that the dashpot pulls.
TEST(ForceOfInstant, PullsOnlyWithTension) {
  const double pull = kn * overlap - gn * 2.0;
  ASSERT_LT(pull, 0.0);
  Vec3 spring{};
  expect_near(act(with_dashpot(), meeting(0.0, -2.0), spring).mean.force.x, pull);
  expect_near(act(spring_alone(), meeting(0.0, -2.0), spring).mean.force.x, pull);
  expect_near(act(turned_spring(), meeting(0.0, -2.0), spring).mean.force.x, pull);
  EXPECT_EQ(act(turned_spring(without_tension), meeting(0.0, -2.0), spring).mean.force.x, 0.0);
  EXPECT_EQ(act(with_dashpot(without_tension), meeting(0.0, -2.0), spring).mean.force.x, 0.0);
  EXPECT_EQ(act(spring_alone(without_tension), meeting(0.0, -2.0), spring).mean.force.x, 0.0);
}

/// So slow that nothing slides: the spring takes a step of the slip, and what leaves the tangent plane is taken off it.
TEST(ForceOfInstant, OfASlowSlipIsThatOfTheMovedSpring) {
  const double slip = 0.1;
  const double before = 3e-6;
  const auto check = [&](const auto &law, double growth) {
    Vec3 spring{2e-6, before, 0.0};
    const auto found = act(law, meeting(slip), spring);
    const double length = before + slip * dt;
    EXPECT_NEAR(spring.x, 0.0, rounding * length);
    expect_near(spring.y, length);
    expect_near(found.mean.force.y, -growth * (kt * length + gt * slip));
    expect_near(found.mean.torque_per_lever.z, found.mean.force.y);
  };
  check(with_dashpot(), 1.0);
  check(with_dashpot<HertzGrowth>(), area_radius);
  check(spring_alone(), 1.0);
  check(spring_alone_per_area(1e-3), area_radius);
}

/// What leaves the tangent plane is not taken off but turned into it.
TEST(ForceOfInstant, OfATurnedSpringIsThatOfItsLength) {
  const double slip = 0.1;
  const auto check = [&](const auto &law, double growth) {
    Vec3 spring{4e-6, 3e-6, 0.0};
    const auto found = act(law, meeting(slip), spring);
    const double length = 5e-6 + slip * dt;
    EXPECT_NEAR(spring.x, 0.0, rounding * length);
    expect_near(spring.y, length);
    expect_near(found.mean.force.y, -growth * (kt * length + gt * slip));
    expect_near(found.mean.torque_per_lever.z, found.mean.force.y);
  };
  in_every_order([&](auto order) {
    check(turned_spring<order()>(), 1.0);
    check(turned_spring_per_area<order()>(1e-3), area_radius);
  });
}

/// By less than a part of 1e-10 of Coulomb's limit it is left where it is; a spring along the normal is none.
TEST(ForceOfInstant, OfASpringThatHardlyLeavesThePlaneTurnsNone) {
  const double limit = mu * (kn * overlap + gn * closing);
  Vec3 spring{0.9e-10 * limit / kt, 3e-6, 0.0};
  const Vec3 before = spring;
  act(turned_spring(), meeting(), spring);
  EXPECT_TRUE(spring == before);
  spring.x = 1.1e-10 * limit / kt;
  act(turned_spring(), meeting(), spring);
  EXPECT_EQ(spring.x, 0.0);
  spring = {1e-6, 0.0, 0.0};
  act(turned_spring(), meeting(), spring);
  EXPECT_TRUE(spring == Vec3{});
}

TEST(ForceOfInstant, OfASlidingContactIsAtCoulombsLimit) {
  const double slip = 0.1;
  const double limit = mu * (kn * overlap + gn * closing);
  const Vec3 long_spring{0.0, 2.0 * limit / kt, 0.0};
  Vec3 spring = long_spring;
  expect_near(act(with_dashpot(), meeting(slip), spring).mean.force.y, -limit);
  expect_near(kt * spring.y + gt * slip, limit); // shortened so that both are at it
  spring = long_spring;
  expect_near(act(with_dashpot<HertzGrowth>(), meeting(slip), spring).mean.force.y, -area_radius * limit);
  expect_near(kt * spring.y + gt * slip, limit);
  in_every_order([&](auto order) {
    spring = long_spring;
    expect_near(act(turned_spring<order()>(), meeting(slip), spring).mean.force.y, -limit);
    expect_near(kt * spring.y + gt * slip, limit);
  });
  spring = long_spring;
  expect_near(act(spring_alone(), meeting(slip), spring).mean.force.y, -limit); // of the spring, the dashpot is off
  expect_near(kt * spring.y, limit);
}

/// The dashpot counts, by which the two laws differ: spring and dashpot are above the limit, the spring alone is not.
TEST(ForceOfInstant, LimitsTheDashpotOrLeavesItFree) {
  const double slip = 1.0;
  const double limit = mu * (kn * overlap + gn * closing);
  const double length = 0.9 * limit / kt;
  ASSERT_GT(kt * length + gt * slip, limit);
  const Vec3 before{0.0, length - slip * dt, 0.0};
  Vec3 spring = before;
  expect_near(act(with_dashpot(), meeting(slip), spring).mean.force.y, -limit);
  spring = before;
  expect_near(act(spring_alone(), meeting(slip), spring).mean.force.y, -(kt * length + gt * slip));
}

/// In a contact without a slip so far, as where a state is evaluated before its first step, there is nothing to
/// shorten.
TEST(ForceOfInstant, WithoutASpringTheLimitedDashpotIsLeftOut) {
  const auto check = [&](auto law) {
    law.dt = 0.0;
    Vec3 spring{};
    EXPECT_EQ(act(law, meeting(100.0), spring).mean.force.y, 0.0);
    EXPECT_TRUE(spring == Vec3{});
  };
  check(with_dashpot());
  check(turned_spring());
}

TEST(ForceOfInstant, OfADashpotAloneIsAtMostCoulombsLimit) {
  const double limit = mu * (kn * overlap + gn * closing);
  Vec3 none{};
  expect_near(act<Friction::dashpot>(spring_alone(), meeting(0.1), none).mean.force.y, -gt * 0.1);
  expect_near(act<Friction::dashpot>(spring_alone(), meeting(10.0), none).mean.force.y, -limit);
  expect_near(act<Friction::dashpot>(with_dashpot(), meeting(0.1), none).mean.force.y, -gt * 0.1);
  expect_near(act<Friction::dashpot>(with_dashpot(), meeting(10.0), none).mean.force.y, -limit);
  EXPECT_EQ(act<Friction::dashpot>(with_dashpot(), meeting(), none).mean.force.y, 0.0);
  expect_near(act<Friction::dashpot>(turned_spring(), meeting(0.1), none).mean.force.y, -gt * 0.1);
  expect_near(act<Friction::dashpot>(turned_spring(), meeting(10.0), none).mean.force.y, -limit);
  EXPECT_EQ(act<Friction::dashpot>(turned_spring(), meeting(), none).mean.force.y, 0.0);
  const auto frictionless = act<Friction::none>(spring_alone(), meeting(10.0), none);
  EXPECT_EQ(frictionless.mean.force.y, 0.0);
  EXPECT_TRUE(frictionless.mean.torque_per_lever == Vec3{});
}

/// Where the spheres touch: at the surface of each, or in the middle of the overlap.
TEST(ForceOfInstant, OfSpinsIsThatOfTheSlipAtItsLevers) {
  const double spin_i = 4.0;
  const double spin_j = 7.0;
  Pair turning = meeting();
  turning.i.spin.z = spin_i;
  turning.j.spin.z = spin_j;
  const double d = radius_i + radius_j - distance;
  const auto check = [&](const auto &law, double inside_at_slip, double inside) {
    Vec3 spring{};
    const auto found = act(law, turning, spring);
    EXPECT_EQ(found.lever_i, radius_i - inside);
    EXPECT_EQ(found.lever_j, radius_j - inside);
    const double slip = -((radius_i - inside_at_slip) * spin_i + (radius_j - inside_at_slip) * spin_j);
    expect_near(found.mean.force.y, -(kt * dt + gt) * slip);
  };
  check(with_dashpot(), 0.0, 0.0);
  check(spring_alone(), 0.5 * d, 0.5 * d);
  check(turned_spring(), 0.0, 0.5 * d);
}

/// Springs of slip and of rolling.
struct TwoSprings : OneSpring {
  Vec3 *other;
  OneSpring rolling() const { return {other}; }
};

/// What rolls moves a spring of its own, with a limit of its own, and is resisted by a couple alone.
TEST(ForceOfInstant, OfRollingIsACouple) {
  const double radius = radius_i * radius_j / (radius_i + radius_j);
  const double push = kn * overlap + gn * closing;
  const double k = 3e3;
  const double g = 2.0;
  Pair turning = meeting();
  turning.i.spin.z = 4.0;
  turning.j.spin.z = -4.0 * radius_i / radius_j; // rolls without slip
  const double velocity = radius * (turning.i.spin.z - turning.j.spin.z);
  const auto check = [&](const auto &law, double before, double length, double force) {
    Vec3 slip{};
    Vec3 rolled{0.0, before, 0.0};
    const auto found =
        PackedForceOfInstant::act<Friction::spring_and_dashpot>(law, turning, TwoSprings{{&slip}, &rolled});
    expect_near(rolled.y, length);
    expect_near(found.couple.z, radius * force);
    expect_near(found.pair.mean.force.x, push);
    EXPECT_NEAR(found.pair.mean.force.y, 0.0, rounding * push);
  };
  const double limit = 0.2 * push;
  in_every_order([&](auto order) {
    const RollingTurnedSpring<order(), double> law{
        {{kn, 0.0, gn, 0.0, 0.0, 0.0, kt, 0.0, gt / gn, mu, with_tension}, radius, 1e-3, dt}, k, g, 0.2};
    check(law, -1e-6, -1e-6 + dt * velocity, -(k * (-1e-6 + dt * velocity) + g * velocity));
    check(law, -1e-2, -(limit + g * velocity) / k, limit);
  });
}

/// Overlapping spheres at random places with springs of any length; all pairs are listed.
template <class Make> class Heap {
public:
  static constexpr int count = 60;

  explicit Heap(const Make &make) : make_(make) {
    std::mt19937_64 random(20051003);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k) {
        x_.push_back(uniform(0.0, 0.027));
        v_.push_back(uniform(-1.0, 1.0));
        omega_.push_back(uniform(-80.0, 80.0));
        f_.push_back(0.0);
        torque_.push_back(0.0);
      }
      radius_.push_back(i % 3 == 0 ? 0.004 : 0.006);
      mass_.push_back(8e3 * radius_.back() * radius_.back() * radius_.back());
      type_.push_back(1);
      group_.push_back(1);
      first_.push_back(i);
      for (int j = 0; j < count; ++j) {
        neighbor_.push_back(j);
        flag_.push_back(uniform(0.0, 1.0) < 0.3 ? touching : 0);
        for (int k = 0; k < 3; ++k) spring_.push_back(uniform(-1e-5, 1e-5));
      }
      neighbors_of_.push_back(count - 1 - i);
    }
    for (int i = 0; i < count; ++i) {
      neighbors_.push_back(neighbor_.data() + i + 1);
      flags_.push_back(flag_.data() + i * count);
      springs_.push_back(spring_.data() + 3 * i * count);
    }
  }

  /// In packs of that many contacts.
  template <Friction kind> void evaluate(int lanes) {
    const auto nobody = [](int, int, const Vec3 &, const Vec3 &) {};
    const auto parameters = [&](const ContactPartners &p) { return parameters_of(p); };
    const ForceOfInstant method(parameters);
    PackedPairs<kind, decltype(method), decltype(nobody)>(lanes, particles(), pairs(), method, nobody).add_forces();
  }

  /// One after the other.
  template <Friction kind> void evaluate_each() {
    const Particles all = particles();
    const PairList list = pairs();
    for (int i = 0; i < count; ++i)
      for (int jj = 0; jj < list.neighbor_count[i]; ++jj) {
        const int j = list.neighbors[i][jj];
        const Vec3 separation = vec3(all.x[i]) - vec3(all.x[j]);
        const Pair pair{separation,   dot(separation, separation), all.radius[i], all.radius[j], all.motion(i),
                        all.motion(j)};
        const double reach = pair.radius_i + pair.radius_j;
        if (pair.squared >= reach * reach) continue;
        ++contacts;
        list.flags[i][jj] |= touching;
        Vec3 spring = vec3(list.spring(i, jj));
        const auto found = act<kind>(parameters_of(partners(all.body(i), all.body(j))).law, pair, spring);
        set(spring, list.spring(i, jj));
        add(found.mean.force, all.f[i]);
        add(found.mean.couple(found.lever_i), all.torque[i]);
        add(-found.mean.force, all.f[j]);
        add(found.mean.couple(found.lever_j), all.torque[j]);
      }
  }

  bool operator==(const Heap &other) const {
    return f_ == other.f_ && torque_ == other.torque_ && spring_ == other.spring_ && flag_ == other.flag_;
  }
  int contacts = 0;

private:
  static constexpr int touching = 5;

  auto parameters_of(const ContactPartners &p) const { return ParametersOfInstant<decltype(make_(p))>{make_(p)}; }

  Particles particles() {
    Particles all;
    all.x = VectorRows(x_.data());
    all.v = VectorRows(v_.data());
    all.omega = VectorRows(omega_.data());
    all.f = VectorRows(f_.data());
    all.torque = VectorRows(torque_.data());
    all.radius = radius_.data();
    all.mass = mass_.data();
    all.type = type_.data();
    all.group = group_.data();
    all.receiving = count;
    return all;
  }
  PairList pairs() {
    PairList list;
    list.count = count;
    list.first = first_.data();
    list.neighbor_count = neighbors_of_.data();
    list.neighbors = neighbors_.data();
    list.index_mask = 0x3FFFFFFF;
    list.flags = flags_.data();
    list.history = springs_.data();
    list.history_size = 3;
    list.spring_offset = 0;
    list.touching = touching;
    list.remembers = true; // what parted before is as it was
    return list;
  }

  Make make_;
  std::vector<double> x_, v_, omega_, f_, torque_, radius_, mass_, spring_;
  std::vector<int> type_, group_, first_, neighbor_, neighbors_of_, flag_;
  std::vector<int *> neighbors_, flags_;
  std::vector<double *> springs_;
};

template <Friction kind, class Make> void expect_the_same(const Make &make) {
  Heap<Make> each(make);
  each.template evaluate_each<kind>();
  EXPECT_GT(each.contacts, 256); // more than two chunks
  for (const InstructionSet &set : instruction_sets) {
    if (!machine_has(set)) continue;
    Heap<Make> packed(make);
    packed.template evaluate<kind>(set.lanes);
    EXPECT_TRUE(packed == each) << set.name;
  }
}

TEST(ForceOfInstant, HasTheBitsOfOneContactInPacks) {
  constexpr Friction full = Friction::spring_and_dashpot;
  const auto with_dashpots = [](const ContactPartners &p) {
    return LimitedWithDashpot<HookeGrowth, double>{kn, 50.0 * p.reduced_mass, kt, 20.0 * p.reduced_mass,
                                                   mu, without_tension,       dt};
  };
  expect_the_same<full>(with_dashpots);
  expect_the_same<Friction::dashpot>(with_dashpots);
  expect_the_same<full>([](const ContactPartners &p) {
    return LimitedWithDashpot<HertzGrowth, double>{1e7, 5e4 * p.reduced_mass, 6e6, 3e4 * p.reduced_mass,
                                                   mu,  with_tension,         dt};
  });
  in_every_order([](auto order) {
    const auto turned = [](const ContactPartners &p) {
      const double radius = p.radius_i * p.radius_j / (p.radius_i + p.radius_j);
      return TurnedSpring<decltype(order)::value, double>{
          {2e3, 1e7, 1.0, 50.0, 5e4, 0.3, 2e3, 6e6, 0.6, mu, without_tension}, radius, p.reduced_mass, dt};
    };
    expect_the_same<Friction::spring_and_dashpot>(turned);
    expect_the_same<Friction::dashpot>(turned);
  });
  const auto hooke = [](const ContactPartners &p) {
    return LimitedSpring<HookeCoefficients, double>{
        {{kn, 50.0 * p.reduced_mass, kt, 20.0 * p.reduced_mass, mu, with_tension}}, dt};
  };
  expect_the_same<full>(hooke);
  expect_the_same<Friction::dashpot>(hooke);
  expect_the_same<Friction::none>(hooke);
  expect_the_same<full>([](const ContactPartners &p) {
    const double radius = p.radius_i * p.radius_j / (p.radius_i + p.radius_j);
    return LimitedSpring<HertzCoefficients, double>{
        {radius, p.reduced_mass, 6e6, 9e6, 2e7, 0.3, 0.2, mu, without_tension}, dt};
  });
  expect_the_same<full>([](const ContactPartners &p) {
    const double radius = p.radius_i * p.radius_j / (p.radius_i + p.radius_j);
    return LimitedSpring<HertzStiffnessCoefficients, double>{
        {radius, p.reduced_mass, 1e7, 5e4, 6e6, 3e4, mu, without_tension}, dt};
  });
}

} // namespace
} // namespace cfpm::testing
