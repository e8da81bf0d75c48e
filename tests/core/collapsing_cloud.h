// SPDX-License-Identifier: GPL-2.0-or-later
// A dozen spheres of two kinds, one of them frozen, which collide, stay together and part; and the loop over listed
// pairs, the cache of contact kinds and the step of a sphere that move them, without a host.
#pragma once

#include "core/contact/inertia.h"
#include "core/method/contact_solver.h"
#include "core/step/add_pair_forces.h"
#include "core/step/move_sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

namespace cfpm::testing {

inline constexpr int size = 12;
inline constexpr int frozen_one = 4; // in the middle
inline constexpr int frozen_bit = 4;
inline constexpr int index_mask = 0x3FFFFFFF; // a host keeps something else in the two highest bits
inline constexpr int touching = 2;
inline constexpr int another_flag = 8; // of the host, in the same word
inline constexpr int values_per_pair = 7;

using Rows = std::vector<double>; // three numbers per particle

inline Vec3 at(const Rows &rows, int i) { return vec3(&rows[static_cast<std::size_t>(i) * 3]); }
inline double *row(Rows &rows, int i) { return &rows[static_cast<std::size_t>(i) * 3]; }

struct Cloud {
  Rows x, v, omega;
  std::vector<double> radius, mass;
  std::vector<int> type, group;
};

/// Spheres that fall towards the frozen one in the middle.
inline Cloud cloud() {
  std::mt19937_64 random(20050101);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  Cloud c;
  for (int i = 0; i < size; ++i) {
    const bool large = (i % 3 + i / 3 % 2 + i / 6) % 2 == 0; // as black and white squares alternate
    const Vec3 place{0.0186 * (i % 3 - 1) + uniform(-0.0003, 0.0003), 0.0186 * (i / 3 % 2) + uniform(-0.0003, 0.0003),
                     0.0186 * (i / 6) + uniform(-0.0003, 0.0003)};
    const Vec3 inward = Vec3{0.0, 0.0093, 0.0093} - place;
    const Vec3 velocity = 40.0 * inward + Vec3{uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-0.3, 0.3)};
    for (const double k : {place.x, place.y, place.z}) c.x.push_back(k);
    for (const double k : {velocity.x, velocity.y, velocity.z}) c.v.push_back(i == frozen_one ? 0.0 : k);
    for (int k = 0; k < 3; ++k) c.omega.push_back(i == frozen_one ? 0.0 : uniform(-40.0, 40.0));
    c.radius.push_back(large ? 0.010 : 0.008);
    c.mass.push_back((large ? 0.010 : 0.005) * (1.0 + 0.1 * (i / 2 % 3))); // of any density
    c.type.push_back(large ? 1 : 2);
    c.group.push_back(i == frozen_one ? 1 | frozen_bit : 1);
  }
  return c;
}

inline constexpr double shortest_contact = 1e-3; // of the pairs, undamped, about [s]
inline constexpr double step_before = 0.10 * shortest_contact;
inline constexpr double step_after = 0.16 * shortest_contact;
inline constexpr int change = 14; // the step at which the length of steps changes, amid the collisions
inline constexpr int steps = 60;
inline double step_length(int n) { return n < change ? step_before : step_after; }

/// Stiffness by the types, damping by the masses: the law depends on all that a kind of contact is told apart by.
inline LinearLaw linear_law(const ContactPartners &p) {
  const double kn = 2.5e4 * p.type_i * p.type_j;
  const double hn = 0.5 * std::sqrt(kn * p.reduced_mass);
  return {kn, hn, 0.6 * kn, 0.2 * hn, 0.2 + 1e-3 * p.radius_i / p.radius_j};
}

using HertzLaw = HertzImpulse::Law;
inline HertzLaw hertz_law(const ContactPartners &p) {
  const double kn = 1.2e6 * p.type_i * p.type_j;
  const double hn = 0.5 * std::sqrt(kn * p.reduced_mass);
  return {kn, hn, 0.6 * kn, 0.2 * hn, 0.2};
}

template <class Law> Law law_of(const ContactPartners &p) {
  if constexpr (std::is_same_v<Law, LinearLaw>)
    return linear_law(p);
  else
    return hertz_law(p);
}

/// What is switched between runs.
struct Options {
  const char *predictor = "exact";
  double split = 0.0;
  std::optional<bool> onset = std::nullopt;
  int receiving = size; ///< see Particles; below size the list holds pairs of both sides of it twice

  const Method &method() const { return *find_method(predictor); }
  bool inside() const { return begins_inside(method(), onset); }
};

/// That tests here ask for; the loops of all of them take minutes to compile.
template <class Law> using AskedFor = std::conditional_t<std::is_same_v<Law, LinearLaw>, Methods,
                                                         MethodList<PredictedForce<RungeKutta4>, PredictedImpulse>>;

template <class Parameters> inline constexpr bool is_soft = false;
template <class Parameters> inline constexpr bool is_soft<SoftInCrowd<Parameters>> = true;

/// A host that does nothing else: lists, history and steps.
template <class Law> class Loop {
public:
  Loop(Cloud cloud, const Options &options) : now(std::move(cloud)), options_(options) {
    solver_.reset(options.method(), 3, options.inside());
    for (Rows *const rows : {&f, &torque, &shift}) rows->assign(3 * size, 0.0);
    contacts.assign(size, 0.0);
    last_contacts_.assign(size, 0.0);
    for (int i = 0; i < size; ++i) {
      // every pair once; across "receiving" from both sides, where the one below asks
      if (i < options.receiving) first_.push_back(i);
      for (int j = i + 1; j < size; ++j) neighbors_[i].push_back(j | (j % 2 == 0 ? 1 << 30 : 0));
      counts_[i] = static_cast<int>(neighbors_[i].size());
      flags_[i].assign(neighbors_[i].size() + 1, another_flag); // one more: an empty vector has no address
      history_[i].assign(values_per_pair * neighbors_[i].size() + 1, 0.0);
    }
  }

  /// Forces and torques over a step dt from the state now. stored_dt: of the step before; advance: false if it is
  /// asked again.
  void evaluate(double dt, double stored_dt, bool advance) {
    for (Rows *const rows : {&f, &torque, &shift}) std::fill(rows->begin(), rows->end(), 0.0);
    if (advance) last_contacts_ = contacts;
    std::fill(contacts.begin(), contacts.end(), 0.0);
    tally.clear();
    std::array<double *, size> rows{};
    for (int i = 0; i < size; ++i) rows[static_cast<std::size_t>(i)] = row(now.v, i);
    StepState step;
    step.dt = dt;
    step.ahead = options_.inside() ? largest_approach(rows.data(), size, dt) : 0.0;
    step.shift = VectorRows(shift.data());
    step.crowd = {last_contacts_.data(), options_.split};
    step.contact_counts = contacts.data();
    bool solved = false;
    solver_.with_method(dt, [&](const auto &method) {
      if constexpr (!is_soft<ParametersOf<std::decay_t<decltype(method)>>>) {
        solved = true;
        add_pair_forces<Friction::spring_and_dashpot>(particles(), pairs(), step,
                                                      {nullptr, stored_dt, advance, nullptr}, method, Teller{tally});
      }
    });
    EXPECT_TRUE(solved) << options_.predictor;
  }

  void move(double dt) {
    const bool shifts = find_method(options_.predictor)->wants_crowd;
    for (int i = 0; i < size; ++i)
      if (i != frozen_one)
        move_sphere(dt, now.mass[static_cast<std::size_t>(i)], now.radius[static_cast<std::size_t>(i)],
                    inertia_factor(3), row(f, i), row(torque, i), shifts ? row(shift, i) : nullptr, row(now.x, i),
                    row(now.v, i), row(now.omega, i));
  }

  Particles particles() {
    Particles particles;
    particles.x = VectorRows(now.x.data());
    particles.v = VectorRows(now.v.data());
    particles.omega = VectorRows(now.omega.data());
    particles.f = VectorRows(f.data());
    particles.torque = VectorRows(torque.data());
    particles.radius = now.radius.data();
    particles.mass = now.mass.data();
    particles.type = now.type.data();
    particles.group = now.group.data();
    particles.frozen = frozen_bit;
    particles.receiving = options_.receiving;
    return particles;
  }

  PairList pairs() {
    PairList pairs;
    pairs.count = static_cast<int>(first_.size());
    pairs.first = first_.data();
    pairs.neighbor_count = counts_.data();
    for (int i = 0; i < size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      neighbor_rows_[k] = neighbors_[i].data();
      flag_rows_[k] = flags_[i].data();
      history_rows_[k] = history_[i].data();
    }
    pairs.neighbors = neighbor_rows_.data();
    pairs.index_mask = index_mask;
    pairs.flags = flag_rows_.data();
    pairs.history = history_rows_.data();
    pairs.history_size = values_per_pair;
    pairs.spring_offset = 1;
    pairs.spring_now_offset = 4;
    pairs.touching = touching;
    return pairs;
  }

  Vec3 spring(int i, int j) { return vec3(&history_[i][static_cast<std::size_t>(values_per_pair * (j - i - 1) + 1)]); }
  bool touches(int i, int j) const { return (flags_.at(i)[static_cast<std::size_t>(j - i - 1)] & touching) != 0; }
  bool keeps_what_is_not_its_own() {
    for (int i = 0; i < size; ++i)
      for (int j = i + 1; j < size; ++j)
        if (!(flags_[i][static_cast<std::size_t>(j - i - 1)] & another_flag) ||
            history_[i][static_cast<std::size_t>(values_per_pair * (j - i - 1))] != 0.0)
          return false;
    return true;
  }

  Cloud now;
  Rows f, torque, shift;
  std::vector<double> contacts;
  using Tally = std::map<std::pair<int, int>, std::pair<Vec3, Vec3>>; // force on the first, separation
  Tally tally;

private:
  struct Teller {
    Tally &tally;
    /// Out of line: not compiled into every loop.
    [[gnu::noinline]] void operator()(int i, int j, const Vec3 &force, const Vec3 &separation) const {
      tally[{i, j}] = {force, separation};
    }
  };

  Options options_;
  ContactSolver<Law, std::function<Law(const ContactPartners &)>, AskedFor<Law>> solver_{law_of<Law>};
  std::vector<double> last_contacts_;
  std::vector<int> first_;
  std::array<int, size> counts_{};
  std::map<int, std::vector<int>> neighbors_, flags_;
  std::map<int, std::vector<double>> history_;
  std::array<int *, size> neighbor_rows_{}, flag_rows_{};
  std::array<double *, size> history_rows_{};
};

} // namespace cfpm::testing
