// SPDX-License-Identifier: GPL-2.0-or-later
#include "collapsing_cloud.h"

#include "core/law/granular_law.h"
#include "core/method/conventional/normal_of_instant.h"
#include "core/step/contact_energy.h"
#include "core/step/energy_budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cfpm::testing {
namespace {

LinearLaw at(const LinearLaw &law, double) { return law; }
template <class Law> LinearLaw at(const Law &law, double overlap) { return law.at(overlap); }

/// What the spring's force does along the way to an overlap, by the midpoint rule with d = s^2, in which it is smooth:
/// of second order in 1/1000.
template <class Law> void expect_integral_of_force(const Law &law) {
  const double overlap = 0.02;
  constexpr int parts = 1000;
  const double part = std::sqrt(overlap) / parts;
  double work = 0.0;
  for (int k = 0; k < parts; ++k) {
    const double s = (k + 0.5) * part;
    work += at(law, s * s).normal_force(s * s, 0.0) * 2.0 * s * part;
  }
  EXPECT_NEAR(law.spring_energy(overlap), work, 1e-5 * work);
}

TEST(EnergyBudget, SpringsHoldTheIntegralOfTheirForce) {
  expect_integral_of_force(LinearLaw{2e4, 3.0, 1e4, 1.0, 0.3});
  expect_integral_of_force(HertzLaw{2e6, 3.0, 1e4, 1.0, 0.3});
  expect_integral_of_force(GranularLaw{2e4, 0.0, 3.0, 0.0, 0.0, 1e4, 0.0, 0.1, 0.3});
  expect_integral_of_force(GranularLaw{0.0, 2e6, 0.0, 3.0, 0.0, 0.0, 1e4, 0.1, 0.3});
  GranularLaw adhesive{0.0, 2e6, 0.0, 3.0, 0.0, 0.0, 1e4, 0.1, 0.3};
  adhesive.adhesion.pull = 3.0;
  expect_integral_of_force(adhesive);
}

/// Over which the budget of a method is told, and what it holds.
template <class Law> class Told {
public:
  explicit Told(const Options &options) : loop_(cloud(), options), options_(options) {
    solver_.reset(options.method(), 3, options.inside());
    counts_.assign(size, 0.0);
    before_.assign(size, 0.0);
  }

  void step(double dt) {
    evaluate(dt);
    const VectorRows shift(loop_.shift.data());
    budget.remember(loop_.particles());
    loop_.move(dt);
    budget.add_step(dt, loop_.particles(), 1, options_.method().wants_crowd ? &shift : nullptr);
  }

  void evaluate(double dt) {
    for (Rows *const rows : {&loop_.f, &loop_.torque, &loop_.shift}) std::fill(rows->begin(), rows->end(), 0.0);
    before_ = counts_;
    std::fill(counts_.begin(), counts_.end(), 0.0);
    std::array<double *, size> rows{};
    for (int i = 0; i < size; ++i) rows[static_cast<std::size_t>(i)] = row(loop_.now.v, i);
    StepState step;
    step.dt = dt;
    step.ahead = options_.inside() ? largest_approach(rows.data(), size, dt) : 0.0;
    step.shift = VectorRows(loop_.shift.data());
    step.crowd = {before_.data(), 0.0};
    step.contact_counts = counts_.data();
    const Particles particles = loop_.particles();
    budget.begin_evaluation(size, size);
    budget.before_contacts(particles, size);
    solver_.with_method(dt, [&](const auto &method) {
      if constexpr (!is_soft<ParametersOf<std::decay_t<decltype(method)>>>) {
        const PairList pairs = loop_.pairs();
        add_pair_forces<Friction::spring_and_dashpot>(particles, pairs, step, {nullptr, dt, true}, method, no_tally);
        add_pair_energies<Friction::spring_and_dashpot>(particles, pairs, step, {nullptr, dt, false}, method, budget);
      }
    });
    budget.after_contacts(particles, size);
    for (int i = 0; i < size; ++i) {
      const double mass = loop_.now.mass[static_cast<std::size_t>(i)];
      if (i == frozen_one)
        set({}, row(loop_.f, i));
      else
        add({0.0, 0.0, -9.81 * mass}, row(loop_.f, i));
    }
  }

  EnergyBudget::Entries entries() { return budget.entries(loop_.particles(), size, 1, inertia_factor(3)); }

  /// Of the normal springs, each pair across "receiving" by half.
  double normal_energy() {
    double sum = 0.0;
    for (int i = 0; i < options_.receiving; ++i)
      for (int j = i + 1; j < size; ++j) {
        const ContactBody a = loop_.particles().body(i);
        const ContactBody b = loop_.particles().body(j);
        const double overlap =
            a.radius + b.radius - norm(cfpm::testing::at(loop_.now.x, i) - cfpm::testing::at(loop_.now.x, j));
        if (overlap > 0.0)
          sum += (j < options_.receiving ? 1.0 : 0.5) * law_of<Law>(partners(a, b)).spring_energy(overlap);
      }
    return sum;
  }

  /// That gravity has.
  double potential() {
    double sum = 0.0;
    for (int i = 0; i < size; ++i)
      sum += 9.81 * loop_.now.mass[static_cast<std::size_t>(i)] * cfpm::testing::at(loop_.now.x, i).z;
    return sum;
  }

  EnergyBudget budget;

private:
  using Asked =
      std::conditional_t<Law::law_kind == LawKind::linear, MethodList<PredictedForce<Exact>, PredictedImpulse>,
                         MethodList<PredictedForce<RungeKutta4>, PredictedImpulse>>;
  Loop<Law> loop_;
  Options options_;
  ContactSolver<Law, std::function<Law(const ContactPartners &)>, Asked> solver_{law_of<Law>};
  std::vector<double> counts_, before_;
};

/// Each step rounds every sum once.
template <class Law> void expect_closed(const Options &options) {
  SCOPED_TRACE(options.predictor);
  Told<Law> told(options);
  const double dt = step_before;
  told.evaluate(dt);
  const EnergyBudget::Entries start = told.entries();
  const double fallen_from = told.potential();
  double most_elastic = 0.0;
  double most_tangential = 0.0;
  for (int n = 0; n < 200; ++n) {
    told.step(dt);
    told.evaluate(dt); // as the next step does, so twice
    const EnergyBudget::Entries e = told.entries();
    const double rounding = 200.0 * 4.0 * std::numeric_limits<double>::epsilon() * start[0];
    ASSERT_NEAR(EnergyBudget::balance(e), EnergyBudget::balance(start), rounding) << n;
    ASSERT_NEAR(e[7], fallen_from - told.potential(), rounding) << n;
    ASSERT_NEAR(e[2], told.normal_energy(), rounding) << n;
    most_elastic = std::fmax(most_elastic, e[2]);
    most_tangential = std::fmax(most_tangential, e[3]);
  }
  const EnergyBudget::Entries end = told.entries();
  EXPECT_GT(most_elastic, 0.05 * start[0]);
  EXPECT_GT(most_tangential, 1e-4 * start[0]);
  EXPECT_GT(end[4], 0.2 * start[0]);
  EXPECT_GT(end[5], 0.01 * start[0]);
  EXPECT_EQ(end[6], 0.0);
}

TEST(EnergyBudget, ClosesToRounding) {
  expect_closed<LinearLaw>({"exact"});
  expect_closed<LinearLaw>({"exact", 0.0, true});
  expect_closed<LinearLaw>({"impulse"});
  expect_closed<HertzLaw>({"rk4"});
  expect_closed<HertzLaw>({"impulse"});
}

TEST(EnergyBudget, CountsHalfOfAContactWithAnotherRank) {
  Options options{"exact"};
  options.receiving = 6;
  Told<LinearLaw> told(options);
  for (int n = 0; n < 12; ++n) told.step(step_before);
  told.evaluate(step_before);
  ASSERT_GT(told.normal_energy(), 0.0);
  EXPECT_NEAR(told.entries()[2], told.normal_energy(), 1e-12 * told.normal_energy());
}

/// One particle of the group and one beside it, under contact forces F and -F and a wall.
struct TwoBodies {
  Rows x = Rows(6), v = {1.0, 2.0, 0.0, 0.5, 0.0, 0.0}, omega = {0.0, 0.0, 3.0, 0.0, 0.0, 0.0};
  Rows f = Rows(6), torque = Rows(6);
  std::vector<double> radius{0.1, 0.1}, mass{2.0, 1.0};
  std::vector<int> type{1, 1}, group{3, 1};

  Particles particles() {
    Particles p;
    p.x = VectorRows(x.data());
    p.v = VectorRows(v.data());
    p.omega = VectorRows(omega.data());
    p.f = VectorRows(f.data());
    p.torque = VectorRows(torque.data());
    p.radius = radius.data();
    p.mass = mass.data();
    p.type = type.data();
    p.group = group.data();
    p.count = p.receiving = 2;
    return p;
  }
};

TEST(EnergyBudget, TellsWhatDidTheWork) {
  TwoBodies two;
  EnergyBudget budget;
  budget.begin_evaluation(2, 2);
  budget.before_contacts(two.particles(), 2);
  two.f = {4.0, 6.0, 0.0, -4.0, -6.0, 0.0};
  two.torque = {0.0, 0.0, 0.5, 0.0, 0.0, 0.5};
  budget.after_contacts(two.particles(), 2);
  budget.add_normal_force(0, {4.0, 0.0, 0.0});
  budget.add_normal_force(1, {-4.0, 0.0, 0.0});
  budget.add_moving_wall({0.0, 0.0, 2.0}, {1.0, 0.0, 0.0}, {0.5, 0.0, 0.25});
  budget.add_elastic(1.0, 0.75, 0.25);
  two.f[1] += 1.0;      // of another force
  two.torque[2] += 0.2; // likewise
  ASSERT_TRUE(budget.is_for(2));
  ASSERT_FALSE(budget.is_for(1));
  budget.remember(two.particles());
  two.v = {2.0, 4.0, 0.0, 9.0, 9.0, 9.0}; // that of the second is of no account
  two.omega[2] = 5.0;
  budget.add_step(0.5, two.particles(), 2, nullptr);
  // ways of the first: 0.5 (1 + 2)/2 = 0.75 and 0.5 (2 + 4)/2 = 1.5, its turn 0.5 (3 + 5)/2 = 2; of the second 0.25
  const double normal = 4.0 * 0.75 - 4.0 * 0.25 - 0.5 * 2.0 * 0.25;
  const double friction = 6.0 * 1.5 + 0.5 * 2.0 - 0.5 * 1.0 * 0.5;
  const double moved = 4.0 * 0.25 + 0.5 * (2.0 * 0.25 + 1.0 * 0.5);
  const double others = 1.0 * 1.5 + 0.2 * 2.0;
  const EnergyBudget::Accumulated sums = budget.accumulated();
  EXPECT_DOUBLE_EQ(sums[0], -normal);
  EXPECT_DOUBLE_EQ(sums[1], -friction);
  EXPECT_DOUBLE_EQ(sums[2], moved);
  EXPECT_DOUBLE_EQ(sums[3], others);
  const EnergyBudget::Entries e = budget.entries(two.particles(), 2, 2, 0.4);
  EXPECT_DOUBLE_EQ(e[0], 0.5 * 2.0 * 20.0);
  EXPECT_DOUBLE_EQ(e[1], 0.5 * 0.4 * 2.0 * 0.01 * 25.0);
  EXPECT_DOUBLE_EQ(e[2], 0.75);
  EXPECT_DOUBLE_EQ(e[3], 0.25);
  EXPECT_DOUBLE_EQ(EnergyBudget::balance(e), e[0] + e[1] + 1.0 - normal - friction - moved - others);

  // what changes between runs is no loss
  budget.begin_run();
  budget.begin_evaluation(2, 2);
  budget.add_elastic(1.0, 5.0, 5.0);
  EXPECT_EQ(budget.accumulated(), sums);
  budget.remember(two.particles());
  budget.begin_evaluation(2, 2);
  budget.add_elastic(0.5, 4.0, 6.0);
  EXPECT_DOUBLE_EQ(budget.accumulated()[0], sums[0] + 3.0);
  EXPECT_DOUBLE_EQ(budget.accumulated()[1], sums[1] + 2.0);
}

/// Where a shift goes along another force, contacts have taken what that gave.
TEST(EnergyBudget, ShiftsAreTheContactsDoing) {
  TwoBodies two;
  two.f = {0.0, -8.0, 0.0, 0.0, 0.0, 0.0};
  EnergyBudget budget;
  budget.begin_evaluation(2, 2);
  budget.remember(two.particles());
  Rows shifts{0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
  const VectorRows shift(shifts.data());
  budget.add_step(0.5, two.particles(), 2, &shift);
  EXPECT_DOUBLE_EQ(budget.accumulated()[0], -8.0 * 0.5);
  EXPECT_DOUBLE_EQ(budget.accumulated()[3], -8.0 * (0.5 * 2.0 + 0.5));
}

/// In a crowd the spring that acts over a long step is a softer one, and holds what that one does: its energy is the
/// integral of its force, k (s d) along d.
TEST(EnergyBudget, CrowdsHoldTheEnergyOfTheirSofterSprings) {
  const LinearLaw law{1e4, 0.0, 5e3, 0.0, 0.5};
  const double mass = 0.01;
  const double tangential_mass = tangential_reduced_mass(mass, 3);
  const double dt = contact_time(law.normal_stiffness, mass);
  const LinearImpulse parameters(law, mass, tangential_mass, dt);
  const auto parameters_of = [&](const ContactPartners &) -> const LinearImpulse & { return parameters; };
  const ExactImpulse method(parameters_of, dt);
  ContactGeometry g{};
  g.normal = {1.0, 0.0, 0.0};
  g.overlap = 1e-4;
  g.lever_i = g.lever_j = 0.01;
  const double alone = method.elastic(parameters, method.normal(parameters, g, dt, 0.0), g).energy;
  EXPECT_DOUBLE_EQ(alone, 0.5 * 1e4 * 1e-8);
  // over a quarter of the period an undamped spring takes its frequency times the overlap, dt of it pi, twice pi/2
  const ElasticContact crowded = method.elastic(parameters, method.normal(parameters, g, dt, 100.0), g);
  EXPECT_NEAR(crowded.energy, 0.5 * alone, 1e-12 * alone);
  EXPECT_LT(crowded.tangential_stiffness, law.tangential_stiffness);
}

/// Bodies that pass by each other act along the normal halfway.
TEST(EnergyBudget, WithoutFrictionAllForceIsAlongTheNormal) {
  const LinearLaw law{1e4, 0.0, 0.0, 0.0, 0.0};
  const double mass = 0.01;
  const double dt = contact_time(law.normal_stiffness, mass);
  const LinearImpulse parameters(law, mass, tangential_reduced_mass(mass, 3), dt);
  const auto parameters_of = [&](const ContactPartners &) -> const LinearImpulse & { return parameters; };
  const ExactImpulse method(parameters_of, dt);
  const ContactGeometry g =
      touching_spheres<double>({0.0195, 0.0, 0.0}, 0.0195, 0.01, 0.01, {{-0.5, 0.5, 0.0}, {}}, {{0.5, -0.5, 0.0}, {}});
  for (const double others : {0.0, 100.0}) {
    const Contact contact{g, dt, others, {}};
    const ContactAction action = act<Friction::none>(method, parameters, contact, no_cohesion);
    const ContactEnergy energy = energy_of<Friction::none>(method, parameters, contact, true);
    EXPECT_GT(action.normal_force, 0.0);
    EXPECT_NEAR(norm(energy.normal_force - action.mean.force), 0.0, 1e-12 * action.normal_force) << others;
  }
}

TEST(EnergyBudget, OfForcesOfOneInstant) {
  const HertzLaw law{2e6, 30.0, 1e6, 1.0, 0.3, without_tension};
  const auto law_of = [&](const ContactPartners &) { return law; };
  const NormalOfInstant method(law_of);
  ContactGeometry g{};
  g.normal = {0.0, 1.0, 0.0};
  g.overlap = 1e-4;
  g.closing_speed = 0.1;
  double spring[] = {0.0, 0.0, 2e-5};
  const Contact contact{g, 1e-5, 0.0, {spring, 1e-5, false}};
  const ContactEnergy e = energy_of<Friction::spring_and_dashpot>(method, law, contact, true);
  EXPECT_DOUBLE_EQ(e.normal_force.y, 2e6 * 1e-6 + 30.0 * 0.1 * 0.1);
  EXPECT_DOUBLE_EQ(e.normal, 0.4 * 2e6 * 1e-10);
  EXPECT_DOUBLE_EQ(e.tangential, 0.5 * 1e6 * 1e-2 * 4e-10);
  Contact leaving = contact;
  leaving.geometry.closing_speed = -10.0;
  EXPECT_EQ(energy_of<Friction::spring_and_dashpot>(method, law, leaving, true).normal_force, Vec3{});
}

} // namespace
} // namespace cfpm::testing
