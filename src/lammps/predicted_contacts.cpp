// SPDX-License-Identifier: GPL-2.0-or-later
#include "predicted_contacts.h"

#include "../core/contact_kinds.h"
#include "../core/hertz_mindlin_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace cfpm::lammps {

namespace {

using HertzLaw = HertzMindlinLaw<DampingExponent::half>;

/// Law of two bodies: the host's damping goes with the reduced mass, the stiffness of a Hertz contact with
/// the square root of the reduced radius.
template <class Law> Law law_of(const ContactArguments &a, const ContactPartners &p) {
  const double per_radius = 1.0 / p.radius_i + 1.0 / p.radius_j; // a wall is flat
  const double area = a.hertz ? std::sqrt(1.0 / per_radius) : 1.0;
  const double damping = area * p.reduced_mass;
  return {area * a.kn, damping * a.gamma_n, area * a.kt, damping * a.gamma_t, a.xmu};
}

template <class Law> class Contacts : public PredictedContacts {
public:
  explicit Contacts(ContactArguments arguments) : arguments_(std::move(arguments)) {}

  void prepare(int dimension) override { kinds_.reset(arguments_.predictor, dimension); }

  void add_pair_forces(const ListedPairs &pairs, double dt, bool advance, const Tally &tally) override {
    const StoredSpring stored = spring_of(dt, advance);
    with_method(dt, [&](const auto &method) {
      constexpr auto friction = Friction::spring_and_dashpot;
      if (tally)
        add_predicted_pair_forces<friction>(pairs, stored, method, dt, tally);
      else
        add_predicted_pair_forces<friction>(pairs, stored, method, dt, [](int, int, const Vec3 &, const Vec3 &) {});
    });
    spring_step_ = dt;
  }

  void add_wall_forces(const std::vector<WallContact> &contacts, double dt, bool advance) override {
    StoredSpring stored = spring_of(dt, advance);
    with_method(dt, [&](const auto &method) {
      for (const WallContact &c : contacts) {
        const ContactGeometry &g = c.geometry;
        const auto &kind = method.kind(at_wall(c.type, c.radius, c.mass));
        const auto normal = method.normal(kind, g, c.span, c.others);
        stored.values = c.spring;
        stored.now = c.spring_now;
        const MeanForce mean =
            method.template mean_force<Friction::spring_and_dashpot>(kind, normal, g, c.span, stored);
        add(mean.force, c.f);
        add(-g.lever_i * mean.moment, c.torque);
        if constexpr (std::decay_t<decltype(method)>::gives_impulses) add(mean.shift, c.shift);
        if (c.contacts && normal.in_contact()) ++*c.contacts;
      }
    });
    spring_step_ = dt;
  }

  ContactForce force_of(const ContactPartners &partners, const ContactGeometry &g, const double *spring,
                        const double *spring_now, double others, double dt) override {
    double copies[6] = {spring[0], spring[1], spring[2]};
    if (spring_now) std::copy_n(spring_now, 3, copies + 3);
    StoredSpring stored = spring_of(dt, false);
    stored.values = copies;
    stored.now = copies + 3;
    ContactForce found{};
    with_method(dt, [&](const auto &method) {
      const auto &kind = method.kind(partners);
      const auto normal = method.normal(kind, g, dt, others);
      const MeanForce mean = method.template mean_force<Friction::spring_and_dashpot>(kind, normal, g, dt, stored);
      found = {normal.mean(), mean.force - normal.mean() * g.normal};
    });
    return found;
  }

private:
  StoredSpring spring_of(double dt, bool advance) const {
    return {nullptr, spring_step_ > 0.0 ? spring_step_ : dt, advance};
  }

  template <class Use> void with_method(double dt, const Use &use) {
    kinds_.with_method(
        dt, [this](const ContactPartners &p) { return law_of<Law>(arguments_, p); }, use);
  }

  ContactArguments arguments_;
  ContactKinds<Law> kinds_;
  double spring_step_ = 0.0; // 0 before the first evaluation: springs of a restart are read with the present step
};

} // namespace

ContactPartners at_wall(int type, double radius, double mass) {
  return {type, 0, radius, std::numeric_limits<double>::infinity(), mass};
}

double contact_time(const ContactArguments &arguments, const ContactPartners &partners, double impact_speed) {
  const double mass = partners.reduced_mass;
  if (!arguments.hertz) return cfpm::contact_time(law_of<LinearLaw>(arguments, partners).normal_stiffness, mass);
  const auto law = law_of<HertzLaw>(arguments, partners);
  return hertz_contact_time(law.normal_stiffness, mass, impact_speed);
}

std::unique_ptr<PredictedContacts> make_predicted_contacts(const ContactArguments &arguments) {
  if (arguments.hertz) return std::make_unique<Contacts<HertzLaw>>(arguments);
  return std::make_unique<Contacts<LinearLaw>>(arguments);
}

} // namespace cfpm::lammps
