// SPDX-License-Identifier: GPL-2.0-or-later
// All loops over contacts for a law: to be included where they are compiled, which takes minutes.
#pragma once

#include "predicted_contacts.h"

#include "core/contact/wider_history.h"
#include "core/law/coulomb.h"
#include "core/method/contact_solver.h"
#include "core/method/conventional/normal_of_instant.h"
#include "core/step/act.h"
#include "core/step/add_pair_forces.h"
#include "core/step/contact_energy.h"
#include "core/step/energy_budget.h"
#include "core/step/turn_resistances.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace cfpm::lammps {

/// What a law has beside its forces that asks for a WiderHistory.
struct BesideForces {
  bool wider_history = false;
  std::optional<TurnResistances> turn_resistances;
};

/// With one law, solved by one method. LawOf, Among: see ContactSolver; the method is one of those.
template <class Law, class LawOf, class Among = Methods> class ContactsOfLaw : public PredictedContacts {
public:
  /// beside: asked for before each run.
  ContactsOfLaw(const Method &method, LawOf law_of, std::function<BesideForces()> beside = {})
      : method_(method), law_of_(law_of), solver_(std::move(law_of)), find_beside_(std::move(beside)) {}

  void prepare(int dimension, bool begins_inside) override {
    solver_.reset(method_, dimension, begins_inside);
    if (!find_beside_) return;
    beside_ = find_beside_();
    if (beside_.turn_resistances) beside_.turn_resistances->set_dimension(dimension);
  }

  void add_pair_forces(const Particles &particles, const PairList &pairs, const StepState &step, bool advance,
                       const Tally &tally) override {
    const StoredSpring spring = spring_of(step.dt, advance);
    with_method(step, [&](const auto &method) {
      const InstructionSet &instructions = instruction_set();
      if (tally)
        cfpm::add_pair_forces<friction>(particles, pairs, step, spring, method, tally, instructions, resistances());
      else
        cfpm::add_pair_forces<friction>(particles, pairs, step, spring, method, no_tally, instructions, resistances());
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
    with_method(step, [&](const auto &method) {
      cfpm::add_wall_forces<friction>(contacts, particles, step, method, instruction_set(), resistances());
    });
    spring_step_ = step.dt;
  }

  ContactAction action_of(const ContactPartners &partners, Contact contact, const StepState &step) override {
    double copies[WiderHistory::size];
    copy_spring(contact, step, copies);
    ContactAction action{};
    with_method(step, [&](const auto &method) {
      action = act<friction>(method, method.parameters(partners), contact, no_cohesion);
    });
    return action;
  }

  Vec3 couple_of(const Particles &particles, int i, int j, Contact contact, const Vec3 &force,
                 const StepState &step) override {
    if (!resistances()) return {};
    double copies[WiderHistory::size];
    copy_spring(contact, step, copies);
    return resistances()->couple(particles, i, j, contact, force, step.dt);
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
  static constexpr Friction friction = Friction::limited_together;

  const TurnResistances *resistances() const { return beside_.turn_resistances ? &*beside_.turn_resistances : nullptr; }

  /// What a contact keeps, which is not to change.
  void copy_spring(Contact &contact, const StepState &step, double *copies) const {
    const double *const now = contact.spring.now;
    std::copy_n(contact.spring.values, beside_.wider_history ? WiderHistory::size : 3, copies);
    if (now) std::copy_n(now, 3, copies + 3);
    contact.spring = spring_of(step.dt, false);
    contact.spring.values = copies;
    contact.spring.now = copies + 3;
  }

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
  std::function<BesideForces()> find_beside_;
  BesideForces beside_;
  double spring_step_ = 0.0; // 0 before the first evaluation: springs of a restart are read with the present step
};

} // namespace cfpm::lammps
