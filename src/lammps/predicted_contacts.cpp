// SPDX-License-Identifier: GPL-2.0-or-later
#include "predicted_contacts.h"

#include "core/law/coulomb.h"
#include "core/law/hertz_mindlin_law.h"
#include "core/law/linear_law.h"
#include "core/law/pair_material.h"
#include "core/method/contact_solver.h"
#include "core/step/act.h"
#include "core/step/add_pair_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cfpm::lammps {

namespace {

/// Law of two bodies, see made_steps.h: the host's damping goes with the reduced mass, both coefficients of a Hertz
/// contact with the square root of the reduced radius.
template <class Law> struct LawOfHost {
  const ContactArguments &arguments;

  PairMaterial<double> material(int, int) const { return arguments.material(); }
  template <class R> [[gnu::always_inline]] auto law(const PairMaterial<R> &material, const PairSizes<R> &sizes) const {
    using std::sqrt;
    R area = 1.0;
    if constexpr (Law::law_kind != LawKind::linear)
      area = sqrt(R(1.0 / (1.0 / sizes.radius_i + 1.0 / sizes.radius_j))); // a wall is flat
    return material.template law<typename Law::template Over<R>>(area, area * sizes.reduced_mass);
  }
  Law operator()(const ContactPartners &p) const { return law(material(p.type_i, p.type_j), sizes_of(p)); }
};

template <class Law> class Contacts : public PredictedContacts {
public:
  explicit Contacts(ContactArguments arguments)
      : arguments_(std::move(arguments)), solver_(LawOfHost<Law>{arguments_}) {}

  void prepare(int dimension, bool begins_inside) override {
    solver_.reset(*arguments_.method, dimension, begins_inside);
  }

  void add_pair_forces(const Particles &particles, const PairList &pairs, const StepState &step, bool advance,
                       const Tally &tally) override {
    const StoredSpring spring = spring_of(step.dt, advance);
    with_method(step, [&](const auto &method) {
      if (tally)
        cfpm::add_pair_forces<friction>(particles, pairs, step, spring, method, tally);
      else
        cfpm::add_pair_forces<friction>(particles, pairs, step, spring, method, no_tally);
    });
    spring_step_ = step.dt;
  }

  void add_wall_forces(std::vector<WallContact> &contacts, const Particles &particles, StepState &step,
                       bool advance) override {
    const StoredSpring spring = spring_of(step.dt, advance);
    for (WallContact &c : contacts) {
      c.contact.spring.dt = spring.dt;
      c.contact.spring.advance = spring.advance;
    }
    with_method(step, [&](const auto &method) { cfpm::add_wall_forces<friction>(contacts, particles, step, method); });
    spring_step_ = step.dt;
  }

  ContactAction action_of(const ContactPartners &partners, Contact contact, const StepState &step) override {
    double copies[6];
    std::copy_n(contact.spring.values, 3, copies);
    if (contact.spring.now) std::copy_n(contact.spring.now, 3, copies + 3);
    contact.spring = spring_of(step.dt, false);
    contact.spring.values = copies;
    contact.spring.now = copies + 3;
    ContactAction action{};
    with_method(step, [&](const auto &method) {
      action = act<friction>(method, method.parameters(partners), contact, no_cohesion);
    });
    return action;
  }

private:
  static constexpr Friction friction = Friction::spring_and_dashpot;

  StoredSpring spring_of(double dt, bool advance) const {
    return {nullptr, spring_step_ > 0.0 ? spring_step_ : dt, advance};
  }

  template <class Use> void with_method(const StepState &step, const Use &use) {
    solver_.with_method(step.dt, step.crowd_dt, use);
  }

  ContactArguments arguments_;
  ContactSolver<Law, LawOfHost<Law>> solver_;
  double spring_step_ = 0.0; // 0 before the first evaluation: springs of a restart are read with the present step
};

} // namespace

ContactPartners at_wall(int type, double radius, double mass) {
  return {type, 0, radius, std::numeric_limits<double>::infinity(), mass};
}

Collision collision(const ContactArguments &arguments, const ContactPartners &partners, double impact_speed) {
  const double mass = partners.reduced_mass;
  if (arguments.hertz) {
    const HertzLaw law = LawOfHost<HertzLaw>{arguments}(partners);
    return {hertz_contact_time(law.normal_stiffness, mass, impact_speed), restitution(law, mass)};
  }
  const LinearLaw law = LawOfHost<LinearLaw>{arguments}(partners);
  return {contact_time(law.normal_stiffness, mass), restitution(law, mass)};
}

std::unique_ptr<PredictedContacts> make_predicted_contacts(const ContactArguments &arguments) {
  if (arguments.hertz) return std::make_unique<Contacts<HertzLaw>>(arguments);
  return std::make_unique<Contacts<LinearLaw>>(arguments);
}

} // namespace cfpm::lammps
