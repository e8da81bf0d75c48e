// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over listed pairs, the cache of contact kinds and the step of a sphere together, without a host: a dozen
// spheres of two kinds, one of them frozen, which collide, stay together and part. They are compared with the same
// method written a second time, in the plain way: every pair of particles, a kind of contact made anew for each, and
// springs that are found by the numbers of the two.
#include "core/contact/inertia.h"
#include "core/method/contact_solver.h"
#include "core/step/add_pair_forces.h"
#include "core/step/move_sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace cfpm::testing {
namespace {

constexpr int size = 12;
constexpr int frozen_one = 4; // in the middle
constexpr int frozen_bit = 4;
constexpr int index_mask = 0x3FFFFFFF; // a host keeps something else in the two highest bits
constexpr int touching = 2;
constexpr int another_flag = 8; // of the host, in the same word
constexpr int values_per_pair = 7;

using Rows = std::vector<double>; // three numbers per particle

Vec3 at(const Rows &rows, int i) { return vec3(&rows[static_cast<std::size_t>(i) * 3]); }
double *row(Rows &rows, int i) { return &rows[static_cast<std::size_t>(i) * 3]; }

struct Cloud {
  Rows x, v, omega;
  std::vector<double> radius, mass;
  std::vector<int> type, group;
};

/// Spheres that fall towards the frozen one in the middle.
Cloud cloud() {
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

constexpr double shortest_contact = 1e-3; // of the pairs, undamped, about [s]
constexpr double step_before = 0.10 * shortest_contact;
constexpr double step_after = 0.16 * shortest_contact;
constexpr int change = 14; // the step at which the length of steps changes, amid the collisions
constexpr int steps = 60;

/// Stiffness by the types, damping by the masses: the law depends on all that a kind of contact is told apart by.
LinearLaw linear_law(const ContactPartners &p) {
  const double kn = 2.5e4 * p.type_i * p.type_j;
  const double hn = 0.5 * std::sqrt(kn * p.reduced_mass);
  return {kn, hn, 0.6 * kn, 0.2 * hn, 0.2 + 1e-3 * p.radius_i / p.radius_j};
}

using HertzLaw = HertzImpulse::Law;
HertzLaw hertz_law(const ContactPartners &p) {
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
    solver_.with_method(dt, law_of<Law>, [&](const auto &method) {
      add_pair_forces<Friction::spring_and_dashpot>(particles(), pairs(), step, {nullptr, stored_dt, advance, nullptr},
                                                    method,
                                                    [&](int i, int j, const Vec3 &force, const Vec3 &separation) {
                                                      tally[{i, j}] = {force, separation};
                                                    });
    });
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
  std::map<std::pair<int, int>, std::pair<Vec3, Vec3>> tally;

private:
  Options options_;
  ContactSolver<Law> solver_;
  std::vector<double> last_contacts_;
  std::vector<int> first_;
  std::array<int, size> counts_{};
  std::map<int, std::vector<int>> neighbors_, flags_;
  std::map<int, std::vector<double>> history_;
  std::array<int *, size> neighbor_rows_{}, flag_rows_{};
  std::array<double *, size> history_rows_{};
};

/// The same by all pairs of particles.
template <class Law> class Plain {
public:
  Plain(Cloud cloud, const Options &options) : now(std::move(cloud)), options_(options) { last_contacts_.fill(0); }

  Cloud now;
  std::array<Vec3, size> f{}, torque{}, shift{};
  std::array<int, size> contacts{};
  int crowded = 0;       ///< contacts of bodies that had another in the step before
  int met_inside = 0;    ///< contacts that began inside a step
  int parted_inside = 0; ///< or ended there, of mean forces

  struct Spring {
    Vec3 value; ///< paper's method: at the time of the last evaluation; impulse: as it is stored
    Vec3 slip;
    Vec3 before;
  };
  std::map<std::pair<int, int>, Spring> springs;

  void evaluate(double dt, double last_dt) {
    last_contacts_ = contacts;
    f.fill({});
    torque.fill({});
    shift.fill({});
    contacts.fill(0);
    for (int i = 0; i < size; ++i)
      for (int j = i + 1; j < size; ++j) contact(i, j, dt, last_dt);
  }

  /// v' = v + dt f/m, x' = x + dt (v + v')/2 + shift/m, and the spin with 2/5 m r^2.
  void move(double dt) {
    for (int i = 0; i < size; ++i) {
      if (i == frozen_one) continue;
      const auto k = static_cast<std::size_t>(i);
      const Vec3 v = at(now.v, i) + (dt / now.mass[k]) * f[k];
      set(at(now.x, i) + 0.5 * dt * (at(now.v, i) + v) + (1.0 / now.mass[k]) * shift[k], row(now.x, i));
      set(v, row(now.v, i));
      const double inertia = 0.4 * now.mass[k] * now.radius[k] * now.radius[k];
      set(at(now.omega, i) + (dt / inertia) * torque[k], row(now.omega, i));
    }
  }

private:
  double shared_mass(int i) const {
    const double n = last_contacts_[static_cast<std::size_t>(i)];
    return now.mass[static_cast<std::size_t>(i)] / (n > 1.0 ? 1.0 + options_.split * (n - 1.0) : 1.0);
  }

  void contact(int i, int j, double dt, double last_dt) {
    const auto a = static_cast<std::size_t>(i);
    const auto b = static_cast<std::size_t>(j);
    const bool impulse = find_method(options_.predictor)->wants_crowd;
    const double reach = now.radius[a] + now.radius[b];
    const Vec3 velocity = at(now.v, i) - at(now.v, j);
    Vec3 between = at(now.x, i) - at(now.x, j);
    double distance = norm(between);
    double wait = 0.0;
    if (dot(between, between) >= reach * reach) {
      wait = options_.inside() ? time_to_touch(between, velocity, reach, dt) : dt;
      if (!(wait < dt)) {
        springs.erase({i, j});
        return;
      }
      between = between + wait * velocity;
      distance = reach;
      ++met_inside;
    }
    const ContactGeometry g = touching_spheres(between, distance, now.radius[a], now.radius[b],
                                               {at(now.v, i), at(now.omega, i)}, {at(now.v, j), at(now.omega, j)});
    // a body that nothing moves is infinitely heavy
    double mass_i = impulse ? shared_mass(i) : now.mass[a];
    double mass_j = impulse ? shared_mass(j) : now.mass[b];
    const double m = i == frozen_one ? mass_j : j == frozen_one ? mass_i : mass_i * mass_j / (mass_i + mass_j);
    const ContactPartners kind{now.type[a], now.type[b], now.radius[a], now.radius[b], m};
    if (impulse)
      give_impulse(i, j, g, kind, dt, last_dt, wait);
    else
      give_mean_force(i, j, g, kind, dt, last_dt, wait);
  }

  /// f on i and its opposite on j, n cross friction turns both.
  void give(int i, int j, const ContactGeometry &g, const Vec3 &force, const Vec3 &moment, const Vec3 &moved) {
    const auto a = static_cast<std::size_t>(i);
    const auto b = static_cast<std::size_t>(j);
    f[a] = f[a] + force;
    f[b] = f[b] - force;
    torque[a] = torque[a] - g.lever_i * moment;
    torque[b] = torque[b] - g.lever_j * moment;
    shift[a] = shift[a] + moved;
    shift[b] = shift[b] - moved;
  }

  /// The paper's: Eqs. 6, 7, 10, 20 and 35 to 40; with onset from the touch on, after a wait, and until Eq. 39 says or
  /// the overlap vanishes.
  void give_mean_force(int i, int j, const ContactGeometry &g, const ContactPartners &kind, double dt, double last_dt,
                       double wait) {
    const double mt = kind.reduced_mass / 3.5;
    const double span = dt - wait;
    PredictedLaw step{};
    double contact_time = span;
    if constexpr (std::is_same_v<Law, LinearLaw>) {
      step = LinearPrediction(linear_law(kind), kind.reduced_mass, mt, *find_predictor(options_.predictor), span)
                 .at(g.overlap, g.closing_speed);
    } else {
      const IntegratedPrediction parameters(hertz_law(kind), kind.reduced_mass, mt, span);
      step = parameters.template at<RungeKutta4>(g.overlap, g.closing_speed);
      contact_time = parameters.template while_touching<RungeKutta4>(g.overlap, g.closing_speed, span).contact_time;
    }
    const NormalAction normal = predict_normal(step, g);
    const double part = options_.inside() ? std::min(contact_time, normal.separation_time) / dt : 1.0;
    if (part < 1.0 && wait == 0.0) ++parted_inside;
    // slip by the trapezoid; the old part of it turned into the tangent plane of today
    Spring &s = springs[{i, j}];
    s.value = tangential_part(s.value + 0.5 * last_dt * s.slip, g.normal) + 0.5 * last_dt * g.slip_velocity;
    const double longest = step.law.friction * normal.force / step.law.tangential_stiffness;
    if (norm(s.value) > longest) s.value = (longest / norm(s.value)) * s.value;
    if (wait > 0.0) s.value = {};
    s.slip = g.slip_velocity;
    const Vec3 friction =
        part * predict_tangential(step, s.value, g.slip_velocity, normal.force, normal.predicted).mean();
    if (wait > 0.0) s.value = -wait * s.slip; // of the next half step too much
    const double mean = part * 0.5 * (normal.force + normal.predicted);
    give(i, j, g, mean * g.normal + friction, cross(g.normal, friction), {});
    if (mean > 0.0) count(i, j);
  }

  /// With others that hold a body: each has its contacts of the step before less this one.
  double others(int i) const {
    if (i == frozen_one) return 0.0;
    const auto k = static_cast<std::size_t>(i);
    return std::max(0.0, last_contacts_[k] - 1.0) / now.mass[k];
  }

  void give_impulse(int i, int j, const ContactGeometry &g, const ContactPartners &partners, double dt, double last_dt,
                    double wait) {
    const double m = partners.reduced_mass;
    if constexpr (std::is_same_v<Law, LinearLaw>) {
      give_impulse_of(LinearImpulse(linear_law(partners), m, m / 3.5, dt), i, j, g, dt, last_dt, wait);
    } else {
      const HertzLaw law = hertz_law(partners);
      const auto tables_of = [&] {
        const auto response_to = [](const Oscillator &o) {
          return std::make_shared<CrowdResponseTable>(CrowdResponseTable::damping_ratio(o));
        };
        return HertzTables{std::make_shared<HertzTrajectory>(HertzImpulse::alpha(law, m), law.tension()),
                           response_to(HertzImpulse::normal_at(law, m, 1.0)),
                           response_to(HertzImpulse::slip_at(law, m / 3.5, 1.0))};
      };
      static const HertzTables tables = tables_of(); // the damping ratios of hertz_law() are all the same
      give_impulse_of(HertzImpulse(law, tables, m, m / 3.5, dt), i, j, g, dt, last_dt, wait);
    }
  }

  template <class Parameters> void give_impulse_of(const Parameters &parameters, int i, int j, const ContactGeometry &g,
                                                   double dt, double last_dt, double wait) {
    const auto parameters_of = [&](const ContactPartners &) -> const Parameters & { return parameters; };
    const ExactImpulse method(parameters_of, dt);
    const double held = others(i) + others(j);
    if (held > 0.0) ++crowded;
    const auto normal = method.normal(parameters, g, dt - wait, held);
    Spring &s = springs[{i, j}];
    double values[] = {s.value.x, s.value.y, s.value.z};
    double before[3] = {};
    const MeanForce mean = method.template mean_force<Friction::spring_and_dashpot>(
        parameters, normal, g, dt - wait, {values, last_dt, true, before}, 0.0);
    s.value = vec3(values);
    s.before = vec3(before);
    give(i, j, g, mean.force, mean.torque_per_lever, held == 0.0 ? mean.shift : Vec3{});
    if (normal.in_contact()) count(i, j);
  }

  void count(int i, int j) {
    ++contacts[static_cast<std::size_t>(i)];
    ++contacts[static_cast<std::size_t>(j)];
  }

  Options options_;
  std::array<int, size> last_contacts_{};
};

double step_length(int n) { return n < change ? step_before : step_after; }

/// Both, step by step, with what they do compared before each.
template <class Law> class Twice {
public:
  explicit Twice(const Options &options, const Cloud &start = cloud()) : loop(start, options), plain(start, options) {}

  void step(int n) {
    const double dt = step_length(n);
    const double last = n == 0 ? dt : step_length(n - 1);
    loop.evaluate(dt, last, true);
    plain.evaluate(dt, last);
    compare(n);
    loop.move(dt);
    plain.move(dt);
  }

  /// Differences come from rounding alone. Collisions let them grow: by how much, the run of a cloud shows that begins
  /// a little elsewhere, see growth().
  void compare(int n) {
    for (int i = 0; i < size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      largest =
          std::max({largest, norm(at(loop.now.x, i) - at(plain.now.x, i)),
                    shortest_contact * norm(at(loop.now.v, i) - at(plain.now.v, i)),
                    shortest_contact * loop.now.radius[k] * norm(at(loop.now.omega, i) - at(plain.now.omega, i))});
      ASSERT_EQ(loop.contacts[k], plain.contacts[k]) << "of " << i << " in step " << n;
      seen = std::max(seen, plain.contacts[k]);
      for (int j = i + 1; j < size; ++j) {
        const bool known = plain.springs.count({i, j}) != 0;
        ASSERT_EQ(loop.touches(i, j), known) << i << ", " << j << " in step " << n;
        if (known) continue;
        ASSERT_EQ(loop.spring(i, j), Vec3{}) << i << ", " << j << " in step " << n;
      }
    }
  }

  Loop<Law> loop;
  Plain<Law> plain;
  double largest = 0.0; ///< difference [m]
  int seen = 0;         ///< contacts of one particle at most
};

/// How far two plain runs are apart that begin this far apart [m].
template <class Law> double growth(const Options &options, double apart) {
  Plain<Law> one(cloud(), options);
  Cloud moved = cloud();
  for (std::size_t k = 0; k < moved.x.size(); ++k) moved.x[k] += k % 2 == 0 ? apart : -apart;
  Plain<Law> other(moved, options);
  double largest = 0.0;
  for (int n = 0; n < steps; ++n) {
    for (Plain<Law> *const run : {&one, &other}) {
      run->evaluate(step_length(n), step_length(n == 0 ? 0 : n - 1));
      run->move(step_length(n));
    }
    for (int i = 0; i < size; ++i) largest = std::max(largest, norm(at(one.now.x, i) - at(other.now.x, i)));
  }
  return largest / apart;
}

/// All steps agree to what rounding becomes: in each of them about ten roundings of a place, of which none is above
/// 0.1 m, grow as any other difference does.
template <class Law> void expect_the_same(const Options &options) {
  Twice<Law> both(options);
  for (int n = 0; n < steps; ++n) {
    both.step(n);
    if (::testing::Test::HasFatalFailure()) return;
  }
  const double rounding = 0.1 * 1.1e-16;
  EXPECT_LT(both.largest, 10.0 * steps * rounding * std::max(1.0, growth<Law>(options, 1e-10)));
  EXPECT_GE(both.seen, 3); // the cloud met
  EXPECT_TRUE(both.loop.keeps_what_is_not_its_own());
  const bool impulse = find_method(options.predictor)->wants_crowd;
  EXPECT_EQ(both.plain.crowded > 0, impulse);
  EXPECT_EQ(both.plain.met_inside > 0, options.inside());
  EXPECT_EQ(both.plain.parted_inside > 0, options.inside() && !impulse);
}

TEST(AddPairForces, DoesWhatAllPairsDoWithMeanForces) {
  expect_the_same<LinearLaw>({"exact"});
  expect_the_same<LinearLaw>({"trapezoid"});
  expect_the_same<HertzLaw>({"rk4"});
}

TEST(AddPairForces, DoesWhatAllPairsDoWithMeanForcesFromTheTouchOn) {
  expect_the_same<LinearLaw>({"exact", 0.0, true});
  expect_the_same<LinearLaw>({"rk2", 0.0, true});
  expect_the_same<HertzLaw>({"rk4", 0.0, true});
}

TEST(AddPairForces, DoesWhatAllPairsDoWithImpulses) {
  expect_the_same<LinearLaw>({"impulse"});
  expect_the_same<LinearLaw>({"impulse", 0.5});
  expect_the_same<LinearLaw>({"impulse", 0.0, false});
}

TEST(AddPairForces, DoesWhatAllPairsDoWithImpulsesOfHertzContacts) { expect_the_same<HertzLaw>({"impulse", 0.5}); }

/// The loop alone, up to where spheres are in contact.
template <class Law> Loop<Law> after(const Options &options, int count) {
  Loop<Law> loop(cloud(), options);
  for (int n = 0; n < count; ++n) {
    loop.evaluate(step_before, step_before, true);
    loop.move(step_before);
  }
  return loop;
}

const std::vector<Options> both_methods = {{"exact"}, {"impulse", 0.5}};

/// Whatever the contacts do, their forces and shifts add up to nothing: every one is given to either body.
TEST(AddPairForces, ConservesMomentum) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> loop(cloud(), options);
    int acted = 0;
    for (int n = 0; n < 40; ++n) {
      loop.evaluate(step_before, step_before, true);
      for (const Rows *const rows : {&loop.f, &loop.shift}) {
        Vec3 sum{};
        double sizes = 0.0;
        for (int i = 0; i < size; ++i) {
          sum = sum + at(*rows, i);
          sizes += norm(at(*rows, i));
        }
        acted += sizes > 0.0;
        EXPECT_LE(norm(sum), size * 2.3e-16 * sizes) << options.predictor << " in step " << n; // a rounding per sum
      }
      loop.move(step_before);
    }
    EXPECT_GT(acted, 20);
  }
}

/// About any point, too: a contact's force acts where the bodies meet, on both.
TEST(AddPairForces, ConservesAngularMomentum) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> loop = after<LinearLaw>({options.predictor, options.split, false}, 14);
    loop.evaluate(step_before, step_before, true);
    Vec3 sum{};
    double sizes = 0.0;
    for (int i = 0; i < size; ++i) {
      sum = sum + at(loop.torque, i) + cross(at(loop.now.x, i), at(loop.f, i));
      sizes += norm(at(loop.torque, i)) + norm(at(loop.f, i)) * norm(at(loop.now.x, i));
    }
    ASSERT_GT(sizes, 0.0);
    // an impulse acts along the normal of the middle of an isolated contact, not of its beginning: its arm is off by
    // the way that the centres turn in half a step, and its lever by the overlap that changes in that time
    const double turning = std::string(options.predictor) == "impulse" ? 0.01 : 0.0;
    EXPECT_LE(norm(sum), (turning + size * 1e-15) * sizes) << options.predictor;
  }
}

/// What is tallied of a contact is what its bodies get, the first of the two along the way from the second.
TEST(AddPairForces, TalliesEveryContact) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> loop = after<LinearLaw>(options, 14);
    loop.evaluate(step_before, step_before, true);
    Rows sum(3 * size, 0.0);
    for (const auto &[pair, of] : loop.tally) {
      add(of.first, row(sum, pair.first));
      add(-of.first, row(sum, pair.second));
      EXPECT_GT(dot(of.second, at(loop.now.x, pair.first) - at(loop.now.x, pair.second)), 0.0);
    }
    EXPECT_GE(loop.tally.size(), 5U);
    for (int i = 0; i < size; ++i) EXPECT_LE(norm(at(sum, i) - at(loop.f, i)), 1e-14 * norm(at(loop.f, i)));
  }
}

/// Particles from "receiving" on belong to somebody else, who asks for the pair as well: they get nothing here, and
/// those below the same as ever.
TEST(AddPairForces, GivesNothingToParticlesOfOthers) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> whole = after<LinearLaw>(options, 14);
    Options half = options;
    half.receiving = 7;
    Loop<LinearLaw> part(whole.now, half);
    Loop<LinearLaw> all(whole.now, options);
    part.evaluate(step_before, step_before, true);
    all.evaluate(step_before, step_before, true);
    int acted = 0;
    for (int i = 0; i < size; ++i) {
      const bool own = i < half.receiving;
      for (const auto &[a, b] : {std::pair(&part.f, &all.f), {&part.torque, &all.torque}, {&part.shift, &all.shift}})
        EXPECT_EQ(at(*a, i), own ? at(*b, i) : Vec3{}) << options.predictor << ' ' << i;
      const auto k = static_cast<std::size_t>(i);
      EXPECT_EQ(part.contacts[k], own ? all.contacts[k] : 0.0) << options.predictor << ' ' << i;
      acted += !own && all.contacts[k] > 0.0;
    }
    EXPECT_GT(acted, 0);
  }
}

/// A host asks again where it writes output: to the last bit the same, and nothing is accumulated.
TEST(AddPairForces, AnsweringAgainChangesNothing) {
  for (const Options &options : both_methods) {
    Loop<LinearLaw> loop = after<LinearLaw>(options, 14);
    loop.evaluate(step_before, step_before, true);
    const auto f = loop.f;
    const auto torque = loop.torque;
    const auto shift = loop.shift;
    const auto contacts = loop.contacts;
    std::map<std::pair<int, int>, Vec3> springs;
    for (const auto &entry : loop.tally) springs[entry.first] = loop.spring(entry.first.first, entry.first.second);
    for (int again = 0; again < 3; ++again) {
      loop.evaluate(step_before, step_before, false);
      EXPECT_EQ(loop.f, f) << options.predictor;
      EXPECT_EQ(loop.torque, torque) << options.predictor;
      EXPECT_EQ(loop.shift, shift) << options.predictor;
      EXPECT_EQ(loop.contacts, contacts) << options.predictor;
      for (const auto &[pair, spring] : springs) EXPECT_EQ(loop.spring(pair.first, pair.second), spring);
    }
  }
}

/// Moves two spheres of the cloud together or apart, all others out of the way.
void put_pair(Cloud &c, double distance) {
  for (int i = 2; i < size; ++i) set({i * 1.0, 0.0, 0.0}, row(c.x, i));
  set({0.0, 0.0, 0.0}, row(c.x, 0));
  set({distance, 0.0, 0.0}, row(c.x, 1));
  for (int i = 0; i < 2; ++i) {
    set({0.0, i == 0 ? 0.05 : -0.05, 0.0}, row(c.v, i));
    set({}, row(c.omega, i));
  }
}

/// In either way that the end of a contact is noticed: by the loop that gives forces, or by the one that only ends.
TEST(AddPairForces, APairThatMeetsAgainFindsNoOldSpring) {
  for (const Options &options : both_methods)
    for (const bool by_forces : {true, false}) {
      Cloud touching_pair = cloud();
      put_pair(touching_pair, 0.0179);
      Loop<LinearLaw> loop(touching_pair, options);
      loop.evaluate(step_before, step_before, true);
      const auto first = loop.f;
      EXPECT_FALSE(loop.spring(0, 1) == Vec3{});
      EXPECT_TRUE(loop.touches(0, 1));
      for (int n = 0; n < 3; ++n) loop.evaluate(step_before, step_before, true); // the spring is stretched
      EXPECT_NE(loop.f, first);
      end_separated_contacts(loop.particles(), loop.pairs()); // still together: nothing ends
      EXPECT_FALSE(loop.spring(0, 1) == Vec3{});
      EXPECT_TRUE(loop.touches(0, 1));

      put_pair(loop.now, 0.0181);
      if (by_forces)
        loop.evaluate(step_before, step_before, true);
      else
        end_separated_contacts(loop.particles(), loop.pairs());
      EXPECT_EQ(loop.spring(0, 1), Vec3{}) << options.predictor;
      EXPECT_FALSE(loop.touches(0, 1)) << options.predictor;
      EXPECT_TRUE(loop.keeps_what_is_not_its_own());

      std::fill(loop.contacts.begin(), loop.contacts.end(), 0.0);
      put_pair(loop.now, 0.0179);
      loop.evaluate(step_before, step_before, true);
      EXPECT_EQ(loop.f, first) << options.predictor;
    }
}

} // namespace
} // namespace cfpm::testing
