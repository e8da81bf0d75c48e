// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts computed several at a time give to the last bit what they give one by one, whatever they are: spheres of
// several types and sizes at random places, some of them frozen, that overlap, meet and part. One by one they are
// compared with the paper in test_add_pair_forces.cpp.
#include "core/contact/inertia.h"
#include "core/law/hertz_mindlin_law.h"
#include "core/method/contact_solver.h"
#include "core/step/add_pair_forces.h"
#include "core/step/move_sphere.h"
#include "core/step/near_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <random>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace cfpm::testing {
namespace {

constexpr int frozen_bit = 2;
constexpr int index_mask = 0x3FFFFFFF;
constexpr int touching = 5; // a host may mean several bits
constexpr int another_flag = 8;
constexpr int values_per_pair = 7; // one before the springs, which is not ours
constexpr double first_dt = 2e-5;  // a twentieth of the contacts' duration, about [s]
constexpr double later_dt = 3e-5;  // [s]
constexpr int change = 20;         // the step at which it begins
constexpr int again = 10;          // the step whose state is evaluated a second time
constexpr int growth = 30;         // the step before which some become larger

/// What a deck may have.
struct Bed {
  const char *predictor = "exact";
  double least_force = without_tension;
  bool continuous_sizes = false;
  int dimension = 3;
  bool history = true;
  double receiving = 1.0;  ///< part of the particles that get forces
  bool counted = false;    ///< for walls that give impulses
  bool alike = false;      ///< all of one type and size, none frozen
  bool heavy = false;      ///< every fourth is of another density
  double damping = 1.0;    ///< factor on that of all contacts
  double split = 0.0;      ///< see Crowd
  double crowd_step = 1.0; ///< over the step, see SoftInCrowd
  int sizes = 0;           ///< not 0: so many of one material, of which the last is that of one sphere far away
};

/// How often a law was asked for, of two bodies and of two materials.
struct Asked {
  int of_bodies = 0;
  int of_materials = 0;
};

/// kn goes with the types alone, damping with the root of kn and the reduced mass.
template <class Law> struct LawOf {
  const Bed &bed;
  Asked &asked;

  PairMaterial<double> material(int type_i, int type_j) const {
    ++asked.of_materials;
    const double kn = (std::is_same_v<Law, LinearLaw> ? 1e4 : 5e5) * type_i * type_j;
    const double hn = bed.damping * 0.1 * (4 + type_i + type_j) * std::sqrt(kn); // of several restitutions
    return {kn, hn, 0.6 * kn, 0.4 * hn, 0.1 * (type_i + type_j), bed.least_force};
  }
  template <class R> [[gnu::always_inline]] auto law(const PairMaterial<R> &material, const PairSizes<R> &sizes) const {
    using std::sqrt;
    return material.template law<typename Law::template Over<R>>(1.0, sqrt(sizes.reduced_mass));
  }
  Law operator()(const ContactPartners &p) const {
    ++asked.of_bodies;
    return law(material(p.type_i, p.type_j), sizes_of(p));
  }
};

/// The same, or one that does not say how it goes with sizes, as of a host's law that does not.
using PerArea = HertzMindlinLaw<DampingExponent::half>;
template <class Law> using GivenLaw =
    std::conditional_t<std::is_same_v<Law, PerArea>, std::function<Law(const ContactPartners &)>, LawOf<Law>>;

/// That tests here ask for; the loops of all of them take minutes to compile.
template <class Law> using AskedFor = std::conditional_t<
    std::is_same_v<Law, LinearLaw>, Methods,
    MethodList<PredictedForce<Exact>, PredictedForce<RungeKutta2>, PredictedForce<RungeKutta4>, PredictedImpulse>>;
template <class Parameters> inline constexpr bool is_soft = false;
template <class Parameters> inline constexpr bool is_soft<SoftInCrowd<Parameters>> = true;
/// Of soft crowds, those with springs.
template <Friction friction, class M>
inline constexpr bool asked_for = has_packs<M> && (has_spring(friction) || !is_soft<ParametersOf<M>>);

/// Spheres in a box that holds them closely, and all pairs of them in a list.
template <class Law> class Spheres {
public:
  Spheres(const Bed &bed, int count, const InstructionSet &set)
      : bed_(bed), count_(count), set_(&set), solver_(LawOf<Law>{bed_, asked}) {
    std::mt19937_64 random(20051003);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    solver_.reset(*find_method(bed.predictor), bed.dimension, false);
    const bool flat = bed.dimension == 2;
    const double volume = 4e-6 * count; // no cube root of it, which compiler and library round differently
    const double box[] = {0.06, flat ? 0.005 * count : 0.06, flat ? 0.0 : volume / (0.06 * 0.06)};
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < 3; ++k) {
        x_.push_back(uniform(0.0, box[k]));
        v_.push_back(flat && k == 2 ? 0.0 : uniform(-1.0, 1.0));
        omega_.push_back(flat && k < 2 ? 0.0 : uniform(-80.0, 80.0));
      }
      const int type = bed.alike ? 1 : 1 + i % 3;
      radius_.push_back(bed.continuous_sizes ? uniform(0.008, 0.011) : type == 1 ? 0.008 : 0.01);
      if (bed.sizes > 0) radius_.back() = 0.008 + 0.0002 * (i % 16);
      if (bed.sizes > 0 && i == count - 1) {
        x_[x_.size() - 3] = 1.0;
        radius_.back() = 0.008 + 0.0002 * (bed.sizes - 1);
      }
      const double density = bed.heavy && i % 4 == 0 ? 9e3 : 8e3;
      mass_.push_back(density * radius_.back() * radius_.back() * radius_.back());
      type_.push_back(type);
      group_.push_back(i % 7 == 3 && !bed.alike ? 1 | frozen_bit : 1);
    }
    neighbors_.resize(static_cast<std::size_t>(count));
    contact_counts_.assign(neighbors_.size(), 0.0);
    flags_.resize(neighbors_.size());
    history_.resize(neighbors_.size());
    for (int i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      for (int j = i + 1; j < count; ++j) neighbors_[at].push_back(j | (j % 2 == 0 ? 1 << 30 : 0));
      flags_[at].assign(neighbors_[at].size() + 1, 0);
      if (i % 5 == 0) flags_[at][0] = another_flag;
      history_[at].assign(values_per_pair * flags_[at].size(), 0.0);
      first_.push_back(i);
      counts_.push_back(static_cast<int>(neighbors_[at].size()));
      neighbor_rows_.push_back(neighbors_[at].data());
      flag_rows_.push_back(flags_[at].data());
      history_rows_.push_back(history_[at].data());
    }
  }

  /// The next one, of number n.
  template <Friction friction> void step(int n) {
    const double dt = n < change ? first_dt : later_dt;
    if (n == growth) grow();
    evaluate<friction>(dt, n <= change ? first_dt : later_dt, true);
    if (n == again) evaluate<friction>(dt, dt, false);
    for (int i = 0; i < count_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const std::size_t row = 3 * at;
      if (!(group_[at] & frozen_bit))
        move_sphere(dt, mass_[at], radius_[at], inertia_factor(bed_.dimension), &f_[row], &torque_[row], &shift_[row],
                    &x_[row], &v_[row], &omega_[row]);
    }
  }

  /// All that has changed, bit by bit.
  std::vector<std::string> state() const {
    std::vector<std::string> bytes;
    const auto take = [&](const auto &values) {
      bytes.emplace_back(reinterpret_cast<const char *>(values.data()), values.size() * sizeof values[0]);
    };
    for (const auto *const numbers : {&f_, &torque_, &x_, &v_, &omega_, &tally_, &contact_counts_, &shift_})
      take(*numbers);
    for (const auto &row : flags_) take(row);
    for (const auto &row : history_) take(row);
    return bytes;
  }

  /// The forces of all contacts, on i [N], where nothing moves: after another evaluation, so that there are crowds.
  template <Friction friction> std::vector<Vec3> forces() {
    for (int k = 0; k < 2; ++k) evaluate<friction>(first_dt, first_dt, true);
    std::vector<Vec3> all;
    for (std::size_t k = 0; k < tally_.size(); k += 8) all.push_back({tally_[k], tally_[k + 1], tally_[k + 2]});
    return all;
  }

  Asked asked;
  int contacts = 0; ///< of the last evaluation
  int crowded = 0;  ///< of all evaluations, contacts whose bodies have others
  std::size_t pairs_that_touched() const { return pairs_.size(); }

private:
  /// As fixes of a host do between steps.
  void grow() {
    for (std::size_t i = 0; i < radius_.size(); i += 2) {
      radius_[i] *= 1.01;
      mass_[i] *= 1.02;
    }
  }

  template <Friction friction> void evaluate(double dt, double stored_dt, bool advance) {
    f_.assign(x_.size(), 0.0);
    torque_.assign(x_.size(), 0.0);
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
    all.count = count_;
    all.frozen = frozen_bit;
    all.receiving = static_cast<int>(bed_.receiving * count_);
    PairList pairs;
    pairs.near = &near_;
    pairs.count = count_;
    pairs.first = first_.data();
    pairs.neighbor_count = counts_.data();
    pairs.neighbors = neighbor_rows_.data();
    pairs.index_mask = index_mask;
    if (bed_.history) {
      pairs.flags = flag_rows_.data();
      pairs.history = history_rows_.data();
      pairs.history_size = values_per_pair;
      pairs.spring_offset = 1;
      pairs.spring_now_offset = 4;
      pairs.touching = touching;
    }
    StepState step;
    step.dt = dt;
    if (advance) contacts_before_ = contact_counts_;
    contact_counts_.assign(radius_.size(), 0.0);
    shift_.assign(x_.size(), 0.0);
    if (bed_.counted) {
      std::vector<const double *> rows;
      for (std::size_t i = 0; i < radius_.size(); ++i) rows.push_back(&v_[3 * i]);
      step.ahead = largest_approach(rows.data(), count_, dt);
      step.crowd = {contacts_before_.data(), bed_.split};
      step.shift = VectorRows(shift_.data());
      step.contact_counts = contact_counts_.data();
    }
    tally_.clear();
    contacts = 0;
    bool solved = false;
    solver_.with_method(dt, bed_.crowd_step * dt, [&](const auto &method) {
      if constexpr (asked_for<friction, std::decay_t<decltype(method)>>) {
        solved = true;
        add_pair_forces<friction>(all, pairs, step, {nullptr, stored_dt, advance}, method, Tally{*this}, *set_);
      }
    });
    EXPECT_TRUE(solved) << bed_.predictor << " is not compiled here";
  }

  struct Tally {
    Spheres &spheres;
    void operator()(int i, int j, const Vec3 &force, const Vec3 &separation) const {
      spheres.tally(i, j, force, separation);
    }
  };
  /// Out of line: not compiled into every loop.
  [[gnu::noinline]] void tally(int i, int j, const Vec3 &force, const Vec3 &separation) {
    for (const Vec3 &a : {force, separation}) tally_.insert(tally_.end(), {a.x, a.y, a.z});
    tally_.insert(tally_.end(), {1.0 * i, 1.0 * j});
    pairs_.emplace(i, j);
    ++contacts;
    const auto has_others = [this](int k) { return contacts_before_[static_cast<std::size_t>(k)] > 1.0; };
    crowded += has_others(i) || has_others(j);
  }

  Bed bed_;
  int count_;
  const InstructionSet *set_;
  ContactSolver<Law, GivenLaw<Law>, AskedFor<Law>> solver_;
  std::vector<double> x_, v_, omega_, f_, torque_, radius_, mass_, tally_, shift_;
  std::vector<double> contact_counts_, contacts_before_; ///< of each sphere in this step and in the one before
  std::vector<int> type_, group_, first_, counts_;
  std::vector<std::vector<int>> neighbors_, flags_;
  std::vector<std::vector<double>> history_;
  NearPairs near_;
  std::vector<int *> neighbor_rows_, flag_rows_;
  std::vector<double *> history_rows_;
  std::set<std::pair<int, int>> pairs_; ///< that have touched
};

/// Those of this machine, the first of which has no packs.
std::vector<const InstructionSet *> sets() {
  std::vector<const InstructionSet *> all;
  for (const InstructionSet &set : instruction_sets)
    if (machine_has(set)) all.push_back(&set);
  return all;
}

template <Friction friction, class Law = LinearLaw> void expect_the_same(const Bed &bed, int count, int steps) {
  const auto all = sets();
  ASSERT_EQ(all.front()->lanes, 1);
  Spheres<Law> one_by_one(bed, count, *all.front());
  std::deque<Spheres<Law>> packed;
  for (std::size_t k = 1; k < all.size(); ++k) packed.emplace_back(bed, count, *all[k]);
  for (int n = 0; n < steps; ++n) {
    one_by_one.template step<friction>(n);
    const auto expected = one_by_one.state();
    for (std::size_t k = 1; k < all.size(); ++k) {
      packed[k - 1].template step<friction>(n);
      ASSERT_TRUE(packed[k - 1].state() == expected) << all[k]->name << ", " << bed.predictor << ", step " << n;
    }
  }
  EXPECT_GT(one_by_one.pairs_that_touched(), static_cast<std::size_t>(one_by_one.contacts)); // some met, some parted
  EXPECT_EQ(one_by_one.crowded > 0, bed.counted);
}

/// What a deck has with "predict impulse".
Bed impulses() {
  Bed bed{"impulse"};
  bed.counted = true;
  return bed;
}

constexpr int spheres = 120; // more contacts than a chunk holds
constexpr int steps = 40;

TEST(PackedPairs, GiveTheBitsOfOneByOne) {
  for (const char *const predictor : {"exact", "trapezoid", "rk2", "rk4"})
    expect_the_same<Friction::spring_and_dashpot>({predictor}, spheres, steps);
}

TEST(PackedPairs, GiveTheBitsOfHertzContacts) {
  using Tsuji = HertzMindlinLaw<DampingExponent::quarter>;
  for (const char *const predictor : {"rk2", "rk4"}) {
    expect_the_same<Friction::spring_and_dashpot, Tsuji>({predictor}, spheres, steps);
    expect_the_same<Friction::spring_and_dashpot, PerArea>({predictor, with_tension, true}, spheres, steps);
    expect_the_same<Friction::dashpot, Tsuji>({predictor}, spheres, steps);
  }
}

TEST(PackedPairs, GiveTheBitsOfTheExactHertzContact) {
  using Tsuji = HertzMindlinLaw<DampingExponent::quarter>;
  expect_the_same<Friction::spring_and_dashpot, Tsuji>({"exact"}, spheres, steps);
  expect_the_same<Friction::spring_and_dashpot, Tsuji>({"exact", with_tension, true}, spheres, steps);
}

TEST(PackedPairs, GiveTheBitsWithAnyFriction) {
  expect_the_same<Friction::dashpot>({}, spheres, steps);
  expect_the_same<Friction::none>({}, spheres, steps);
}

TEST(PackedPairs, GiveTheBitsOfSpringsLimitedWithTheirDashpots) {
  using Tsuji = HertzMindlinLaw<DampingExponent::quarter>;
  expect_the_same<Friction::limited_together>({}, spheres, steps);
  expect_the_same<Friction::limited_together, Tsuji>({"rk4"}, spheres, steps);
  expect_the_same<Friction::limited_together>(impulses(), spheres, steps);
  expect_the_same<Friction::limited_together, Tsuji>(impulses(), spheres, steps);
  expect_the_same<Friction::limited_together, PerArea>(impulses(), spheres, steps);
}

TEST(PackedPairs, GiveTheBitsWithTension) {
  expect_the_same<Friction::spring_and_dashpot>({"exact", with_tension}, spheres, steps);
  expect_the_same<Friction::dashpot>({"trapezoid", with_tension}, spheres, steps);
}

TEST(PackedPairs, GiveTheBitsWithParametersOfEachContact) {
  expect_the_same<Friction::spring_and_dashpot>({"exact", without_tension, true}, spheres, steps);
}

/// Kept parameters are those of at most sixteen classes of particles. One sphere more, far away, lets all contacts be
/// made anew: that changes what they give by rounding at most, or not at all where both have the same arithmetic. All
/// of it consists of few terms up to kn d + hn u of the largest overlap and speed, or of impulses over dt the mass
/// times that speed over dt, each with some ten roundings; see test_made_steps.cpp.
template <class Law> void expect_nearly_the_same_with_one_size_more(Bed bed, bool to_the_last_bit) {
  bed.alike = true;
  for (const InstructionSet *const set : sets()) {
    bed.sizes = 16;
    Spheres<Law> few(bed, spheres, *set);
    const std::vector<Vec3> kept = few.template forces<Friction::spring_and_dashpot>();
    bed.sizes = 17;
    Spheres<Law> many(bed, spheres, *set);
    const std::vector<Vec3> made = many.template forces<Friction::spring_and_dashpot>();
    ASSERT_EQ(made.size(), kept.size());
    ASSERT_GT(made.size(), 128);
    double largest = 0.0;
    for (const Vec3 &force : kept) largest = std::max(largest, norm(force));
    for (std::size_t k = 0; k < kept.size(); ++k)
      ASSERT_LE(norm(made[k] - kept[k]), to_the_last_bit ? 0.0 : 100.0 * 2.2e-16 * largest) << set->name << " " << k;
  }
}

TEST(PackedPairs, AreNearlyTheSameWithOneSizeMore) {
  for (const char *const predictor : {"trapezoid", "rk2", "rk4"})
    expect_nearly_the_same_with_one_size_more<LinearLaw>({predictor}, true);
  expect_nearly_the_same_with_one_size_more<LinearLaw>({"exact"}, false);
  expect_nearly_the_same_with_one_size_more<LinearLaw>({"exact", with_tension}, false);
}

TEST(PackedPairs, AreNearlyTheSameHertzContactsWithOneSizeMore) {
  using Tsuji = HertzMindlinLaw<DampingExponent::quarter>;
  for (const char *const predictor : {"rk2", "rk4"})
    expect_nearly_the_same_with_one_size_more<Tsuji>({predictor}, true);
  expect_nearly_the_same_with_one_size_more<Tsuji>({"exact"}, false);
}

/// A law is a matter of the host, which may take powers: with many sizes it is not asked about every contact.
template <class Law> void expect_questions_about_materials_alone(Bed bed) {
  bed.continuous_sizes = true;
  constexpr int types = 3;
  for (const InstructionSet *const set : sets()) {
    if (set->lanes == 1) continue;
    Spheres<Law> all(bed, spheres, *set);
    const std::size_t contacts = all.template forces<Friction::spring_and_dashpot>().size();
    EXPECT_GT(contacts, 128);
    EXPECT_EQ(all.asked.of_bodies, 0) << bed.predictor;
    EXPECT_GT(all.asked.of_materials, 0);
    if (bed.counted) continue; // of impulses those that are alone ask one by one
    EXPECT_LE(all.asked.of_materials, 2 * 2 * types * types) << bed.predictor; // in two evaluations, for tables too
  }
}

TEST(PackedPairs, WithManySizesAskForTheLawOfTwoMaterials) {
  using Tsuji = HertzMindlinLaw<DampingExponent::quarter>;
  expect_questions_about_materials_alone<LinearLaw>({"exact"});
  expect_questions_about_materials_alone<LinearLaw>(impulses());
  for (const char *const predictor : {"exact", "rk4"}) expect_questions_about_materials_alone<Tsuji>({predictor});
  expect_questions_about_materials_alone<Tsuji>(impulses());
}

TEST(PackedPairs, GiveTheBitsOfEqualSpheres) {
  Bed bed;
  bed.alike = true;
  expect_the_same<Friction::spring_and_dashpot>(bed, spheres, steps);
}

TEST(PackedPairs, GiveTheBitsOfEqualSizes) {
  Bed bed;
  bed.alike = bed.heavy = true;
  expect_the_same<Friction::spring_and_dashpot>(bed, spheres, steps);
}

TEST(PackedPairs, GiveTheBitsOfDiscs) {
  expect_the_same<Friction::spring_and_dashpot>({"exact", without_tension, false, 2}, spheres, steps);
}

TEST(PackedPairs, GiveTheBitsWithoutHistory) {
  expect_the_same<Friction::dashpot>({"exact", without_tension, false, 3, false}, spheres, steps);
}

TEST(PackedPairs, GiveNothingToParticlesOfOthers) {
  expect_the_same<Friction::spring_and_dashpot>({"exact", without_tension, true, 3, true, 0.6}, spheres, steps);
}

TEST(PackedPairs, CountForWallsThatGiveImpulses) {
  expect_the_same<Friction::spring_and_dashpot>({"exact", without_tension, false, 3, true, 1.0, true}, spheres, steps);
}

/// In crowds, alone, and where they begin inside the step.
template <class Law> void expect_the_same_impulses() {
  expect_the_same<Friction::spring_and_dashpot, Law>(impulses(), spheres, steps);
  Bed bed = impulses();
  bed.least_force = with_tension;
  bed.receiving = 0.6;
  bed.continuous_sizes = true;
  expect_the_same<Friction::spring_and_dashpot, Law>(bed, spheres, steps);
  bed = impulses();
  bed.split = 0.3;
  bed.history = false;
  expect_the_same<Friction::dashpot, Law>(bed, spheres, steps);
  bed = impulses();
  bed.crowd_step = 2.7;
  for (const bool continuous : {false, true}) {
    bed.continuous_sizes = continuous;
    expect_the_same<Friction::spring_and_dashpot, Law>(bed, spheres, steps);
  }
}

TEST(PackedPairs, AreNearlyTheSameImpulsesWithOneSizeMore) {
  expect_nearly_the_same_with_one_size_more<LinearLaw>(impulses(), false);
  expect_nearly_the_same_with_one_size_more<HertzMindlinLaw<DampingExponent::quarter>>(impulses(), false);
  expect_nearly_the_same_with_one_size_more<HertzMindlinLaw<DampingExponent::half>>(impulses(), false);
}

TEST(PackedPairs, GiveTheBitsOfImpulses) { expect_the_same_impulses<LinearLaw>(); }

TEST(PackedPairs, GiveTheBitsOfHertzImpulses) { expect_the_same_impulses<HertzMindlinLaw<DampingExponent::quarter>>(); }

TEST(PackedPairs, GiveTheBitsOfViscoelasticImpulses) {
  expect_the_same_impulses<HertzMindlinLaw<DampingExponent::half>>();
}

TEST(PackedPairs, GiveTheBitsOfImpulsesWithoutFriction) { expect_the_same<Friction::none>(impulses(), spheres, steps); }

/// Of which no packs can be made, see ReleasedImpulse.
TEST(PackedPairs, GiveTheBitsOfImpulsesNearCriticalDamping) {
  Bed bed = impulses();
  bed.damping = 4.0;
  expect_the_same<Friction::spring_and_dashpot>(bed, spheres, steps);
  bed.damping = 2.5; // of some, with as many sizes
  bed.continuous_sizes = true;
  expect_the_same<Friction::spring_and_dashpot>(bed, spheres, steps);
}

/// Whatever is left for the last pack of the last chunk, from none to more than two chunks.
TEST(PackedPairs, GiveTheBitsOfAnyNumberOfContacts) {
  const InstructionSet &scalar = *sets().front();
  std::set<int> seen;
  for (const Bed &bed : {Bed{}, impulses()})
    for (int count = 1; count <= (bed.counted ? 90 : 150); ++count) {
      const auto run = [&](const InstructionSet &set) {
        Spheres<LinearLaw> all(bed, count, set);
        all.step<Friction::spring_and_dashpot>(0);
        if (bed.counted) all.step<Friction::spring_and_dashpot>(1); // in the first one nobody has others
        return std::pair{all.state(), all.contacts};
      };
      const auto [expected, contacts] = run(scalar);
      for (const InstructionSet *const set : sets())
        ASSERT_TRUE(run(*set).first == expected) << set->name << ", " << contacts << " contacts";
      seen.insert(contacts);
    }
  EXPECT_EQ(*seen.begin(), 0);
  EXPECT_GT(*seen.rbegin(), 256);
  for (int left = 0; left < 4; ++left) // of either width, in the first chunk and behind it
    for (const bool first : {true, false})
      EXPECT_TRUE(std::any_of(seen.begin(), seen.end(), [&](int n) { return n % 4 == left && (n < 128) == first; }));
}

TEST(InstructionSet, IsTheWidestOfTheMachineUnlessOneIsAskedFor) {
  EXPECT_EQ(find_instruction_set(nullptr), sets().back());
  EXPECT_EQ(reason_against_instruction_set(nullptr), "");
  for (const InstructionSet *const set : sets()) {
    EXPECT_EQ(find_instruction_set(set->name), set);
    EXPECT_EQ(reason_against_instruction_set(set->name), "");
  }
}

TEST(InstructionSet, SaysWhatThereIsWhereAnotherIsAskedFor) {
  std::string known;
  for (const InstructionSet *const set : sets()) known += (known.empty() ? "" : ", ") + std::string(set->name);
  for (const std::string asked : {"avx", ""})
    EXPECT_EQ(reason_against_instruction_set(asked.c_str()),
              "CFPM_SIMD is '" + asked + "'; expected one of what this machine has: " + known);
}

} // namespace
} // namespace cfpm::testing
