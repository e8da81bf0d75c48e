// SPDX-License-Identifier: GPL-2.0-or-later
// The method written a second time, in the plain way: every pair of particles, a kind of contact made anew for each,
// and springs that are found by the numbers of the two.
#pragma once

#include "collapsing_cloud.h"

#include "core/contact/inertia.h"
#include "core/method/contact_solver.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <type_traits>
#include <utility>

namespace cfpm::testing {

/// The cloud moved by all pairs of particles.
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
    const Vec3 friction = part * predict_tangential<Friction::spring_and_dashpot>(step, s.value, g.slip_velocity,
                                                                                  normal.force, normal.predicted)
                                     .mean();
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

} // namespace cfpm::testing
