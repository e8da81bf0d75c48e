// SPDX-License-Identifier: GPL-2.0-or-later
// All loops over contacts for a law: to be included where they are compiled, which takes minutes.
#pragma once

#include "predicted_contacts.h"

#include "core/law/coulomb.h"
#include "core/method/contact_solver.h"
#include "core/method/conventional/normal_of_instant.h"
#include "core/step/act.h"
#include "core/step/add_pair_forces.h"
#include "core/step/contact_energy.h"
#include "core/step/energy_budget.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace cfpm::lammps {

/// With one law, solved by one method. LawOf, Among: see ContactSolver; the method is one of those.
template <class Law, class LawOf, class Among = Methods> class ContactsOfLaw : public PredictedContacts {
public:
  ContactsOfLaw(const Method &method, LawOf law_of) : method_(method), law_of_(law_of), solver_(std::move(law_of)) {}

  void prepare(int dimension, bool begins_inside) override { solver_.reset(method_, dimension, begins_inside); }

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

  void add_pair_energies(const Particles &particles, const PairList &pairs, const StepState &step,
                         EnergyBudget &budget) override {
    with_any_method(step, [&](const auto &method) {
      cfpm::add_pair_energies<friction>(particles, pairs, step, spring_of(step.dt, false), method, budget);
    });
  }

  ContactEnergy energy_of(const ContactPartners &partners, Contact contact, bool touched,
                          const StepState &step) override {
    contact.spring.dt = spring_of(step.dt, false).dt;
    ContactEnergy energy{};
    with_any_method(step, [&](const auto &method) {
      energy = cfpm::energy_of<friction>(method, method.parameters(partners), contact, touched);
    });
    return energy;
  }

private:
  static constexpr Friction friction = Friction::spring_and_dashpot;

  StoredSpring spring_of(double dt, bool advance) const {
    return {nullptr, spring_step_ > 0.0 ? spring_step_ : dt, advance};
  }

  template <class Use> void with_method(const StepState &step, const Use &use) {
    solver_.with_method(step.dt, step.crowd_dt, use);
  }

  /// Or with what the host has done.
  template <class Use> void with_any_method(const StepState &step, const Use &use) {
    if (method_.predicted)
      with_method(step, use);
    else
      use(NormalOfInstant(law_of_));
  }

  const Method &method_;
  LawOf law_of_;
  ContactSolver<Law, LawOf, Among> solver_;
  double spring_step_ = 0.0; // 0 before the first evaluation: springs of a restart are read with the present step
};

} // namespace cfpm::lammps
