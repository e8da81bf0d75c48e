// SPDX-License-Identifier: GPL-2.0-or-later
#include "predicted_contacts.h"

#include "../core/contact_kinds.h"
#include "../core/hertz_mindlin_law.h"

#include <cmath>
#include <limits>
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
    const auto kind_of = [&](const ContactPartners &p) -> const Kind & { return kind(p, dt); };
    const auto add = [&](const auto &step_of) {
      constexpr auto friction = Friction::spring_and_dashpot;
      if (tally)
        add_predicted_pair_forces<friction>(pairs, stored, kind_of, step_of, tally);
      else
        add_predicted_pair_forces<friction>(pairs, stored, kind_of, step_of,
                                            [](int, int, const Vec3 &, const Vec3 &) {});
    };
    kinds_.with_predictor(add);
    spring_step_ = dt;
  }

  void add_wall_forces(const std::vector<WallContact> &contacts, double dt, bool advance) override {
    StoredSpring stored = spring_of(dt, advance);
    kinds_.with_predictor([&](const auto &step_of) {
      for (const WallContact &c : contacts) {
        const ContactGeometry &g = c.geometry;
        const ContactStep contact = step_of(kind(at_wall(c.type, c.radius, c.mass), dt), g.overlap, g.closing_speed);
        const NormalAction normal = predict_normal(contact, g);
        stored.values = c.spring;
        const MeanForce mean = mean_force<Friction::spring_and_dashpot>(contact, g, normal, stored);
        add(mean.force, c.f);
        add(-g.lever_i * mean.moment, c.torque);
      }
    });
    spring_step_ = dt;
  }

  ContactForce force_of(const ContactPartners &partners, const ContactGeometry &g, const double *spring,
                        double dt) override {
    double copy[3] = {spring[0], spring[1], spring[2]};
    StoredSpring stored = spring_of(dt, false);
    stored.values = copy;
    ContactForce found{};
    kinds_.with_predictor([&](const auto &step_of) {
      const ContactStep contact = step_of(kind(partners, dt), g.overlap, g.closing_speed);
      const NormalAction normal = predict_normal(contact, g);
      const MeanForce mean = mean_force<Friction::spring_and_dashpot>(contact, g, normal, stored);
      found = {normal.mean(), mean.force - normal.mean() * g.normal};
    });
    return found;
  }

private:
  using Kind = typename ContactKinds<Law>::Kind;

  StoredSpring spring_of(double dt, bool advance) const {
    return {nullptr, spring_step_ > 0.0 ? spring_step_ : dt, advance};
  }

  const Kind &kind(const ContactPartners &partners, double dt) {
    return kinds_.get(partners, dt, [this](const ContactPartners &p) { return law_of<Law>(arguments_, p); });
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
