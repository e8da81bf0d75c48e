// SPDX-License-Identifier: GPL-2.0-or-later
// What a host says of the time step at the start of a run.
#pragma once

#include "core/deck/facts.h"
#include "core/deck/method_and_step.h"
#include "core/law/hertz_mindlin_law.h"
#include "core/method/auto_method.h"
#include "core/method/method.h"
#include "core/motion/restitution.h"
#include "core/numbers/instruction_set.h"
#include "core/step/packed_methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace cfpm {

struct ParticleSize {
  double radius; ///< [m]
  double mass;   ///< [kg]
};

struct SizeRange {
  ParticleSize smallest;
  ParticleSize largest;
  bool present() const { return largest.radius > 0.0; }
};
/// Of the particles of both.
inline SizeRange joined(const SizeRange &a, const SizeRange &b) {
  if (!a.present() || !b.present()) return a.present() ? a : b;
  return {{std::min(a.smallest.radius, b.smallest.radius), std::min(a.smallest.mass, b.smallest.mass)},
          {std::max(a.largest.radius, b.largest.radius), std::max(a.largest.mass, b.largest.mass)}};
}

/// Of contacts of some sizes of particle.
struct ContactTimes {
  double shortest = std::numeric_limits<double>::infinity(); ///< [s]
  double longest = 0.0;                                      ///< [s]
  Restitution restitution;                                   ///< of the last contact for which it is known
  double largest_restitution = 0.0;                          ///< of those, as the contact ends by its law
  std::vector<TimedCollision> collisions;                    ///< as far as a host has told of them, for facts()

  void add(double tc, const Restitution &e = {}) {
    shortest = std::min(shortest, tc);
    longest = std::max(longest, tc);
    if (std::isnan(e.found)) return;
    restitution = e;
    largest_restitution = std::max(largest_restitution, e.found);
  }
};

/// What a surface wave takes around a sphere, by which the time step of a Hertz contact is commonly chosen [s].
/// young [Pa], poisson: of the material.
inline double rayleigh_time(const ParticleSize &size, double young, double poisson) {
  const double density = size.mass / (4.0 / 3.0 * pi * size.radius * size.radius * size.radius);
  const double shear_modulus = 0.5 * young / (1.0 + poisson);
  return pi * size.radius * std::sqrt(density / shear_modulus) / (0.1631 * poisson + 0.8766);
}

/// The method's limit on dt/tc for one undamped contact of that law.
inline double limit_on_one_contact(const Method &method, LawKind law) {
  return law == LawKind::linear ? method.stable_below : method.stable_below * stiffest_hertz_contact_time();
}

/// The durations tc of the contacts of a run and the steps per contact nt = tc/dt, with the method's limit, and for
/// each use of grains the step up to which the methods were measured to be right.
class TimeStepReport {
public:
  /// method, law, begins_inside: of the pair style; impact_speed: at which contacts of another law are timed.
  TimeStepReport(const Method &method, LawKind law, bool begins_inside, double dt, double impact_speed)
      : method_(&method), law_(law), begins_inside_(begins_inside), limit_(limit_on_one_contact(method, law)), dt_(dt),
        impact_speed_(impact_speed) {}

  /// begins_inside, damped_friction: see right_from(); of times there may be none
  void add(const std::string &who, const ContactTimes &times, const Method &method, LawKind law, bool begins_inside,
           bool damped_friction = false) {
    facts_.push_back(facts_of_contact(who, law, damped_friction, times.largest_restitution, times.collisions));
    if (times.longest == 0.0) {
      rows_ += format("  %-18s tc not known\n", who.c_str());
      return;
    }
    const double limit = limit_on_one_contact(method, law);
    nonlinear_ = nonlinear_ || law != LawKind::linear;
    rows_ += format("  %-18s tc = %.4g to %.4g, nt = tc/dt = %.4g to %.4g", who.c_str(), times.shortest, times.longest,
                    times.shortest / dt_, times.longest / dt_);
    shortest_ = std::min(shortest_, times.shortest);
    for (Use &use : uses_) use.add(times.shortest, right_from(method, damped_friction, begins_inside));
    if (&method == &PredictedImpulse::method) energy_.add(times);
    if (&method != method_ || limit != limit_) rows_ += format("; predict %s, ", method.name) + about(limit);
    // what the damping was chosen for, most likely
    if (const Restitution &e = times.restitution; std::fabs(e.found - e.with_tension) > 5e-4)
      rows_ += format("; restitution %.3g, as the force never pulls (else %.3g)", e.found, e.with_tension);
    rows_ += "\n";
    too_large_ = too_large_ || times.shortest / dt_ * limit <= 1.0;
  }

  /// Of the particles for which it is least, see rayleigh_time(); without it nothing is said.
  void set_rayleigh_time(double time) { rayleigh_time_ = time; }
  /// What computes contacts of pairs where they can be computed in packs; to be told before text().
  void set_instructions(const InstructionSet &instructions) { instructions_ = &instructions; }
  /// Why forces of one instant are left to the host's own style; empty where they are not; to be told before text().
  void set_left_to_host(const std::string &reason) { left_to_host_ = reason; }
  /// Of the pair style, which says "predict auto"; to be told before text().
  void set_auto(const AutoMethod &choice) { auto_ = &choice; }

  /// Of the run before; to be told before warnings().
  void set_before(const MethodAndStep &before) { before_ = before; }

  bool has_particles() const { return !rows_.empty(); }
  /// Whether one undamped contact is unstable with its method.
  bool too_large() const { return too_large_; }
  /// Of the contact times [s], infinite without particles.
  double shortest() const { return shortest_; }

  /// For add_facts().
  std::string facts() const {
    return "\"dt\": " + json::number(dt_) + ", \"predict\": " + json::string(name()) +
           ", \"impact_speed\": " + json::number(impact_speed_) + ", \"contacts\": " + json::list(facts_);
  }

  std::string text() const {
    std::string text = format("gran/cfpm: predict %s, dt = %.4g; ", name().c_str(), dt_) + about(limit_);
    if (nonlinear_) text += format("; Hertz: tc of an impact at speed %.4g, tc ~ speed^(-1/5)", impact_speed_);
    text += "\n" + (has_particles() ? rows_ : "  no particles yet\n");
    if (auto_) text += "  auto: " + auto_->reason(shortest_) + "\n";
    for (const Use &use : uses_)
      if (use.measured() && !use.exceeded(dt_)) text += "  " + advice(use) + "\n";
    if (std::isfinite(rayleigh_time_))
      text += format("  Rayleigh time of the smallest particle %.4g\n", rayleigh_time_);
    if (!method_->predicted && !left_to_host_.empty())
      text += "  contacts of pairs are left to the host's own style, as " + left_to_host_ + "\n";
    else if (instructions_ && instructions_->lanes > 1 && is_packed(*method_, law_, begins_inside_))
      text += format("  contacts of pairs are computed %d at a time (%s)\n", instructions_->lanes, instructions_->name);
    return text;
  }

  /// Of the uses for which the step is larger than was measured to be right (what is right is in text()), of energy
  /// from nowhere, and of a bed at rest that the change from the run before would shake.
  std::vector<std::string> warnings() const {
    std::vector<std::string> texts;
    for (const Use &use : uses_)
      if (use.exceeded(dt_))
        texts.push_back(advice(use) + format("; found dt = %.4g, nt = %.4g", dt_, use.shortest / dt_));
    if (energy_.gained(dt_)) texts.push_back(energy_.text(dt_));
    if (shakes_beds())
      texts.push_back(format("a bed at rest will move, as below nt = %g with predict impulse its overlaps are those of "
                             "the step: the run before had predict %s, nt = %.4g, this one has predict %s, nt = %.4g",
                             overlaps_at_rest_from, before_.method->name, shortest_ / before_.dt, method_->name,
                             shortest_ / dt_));
    return texts;
  }

private:
  /// From which nt on overlaps at rest under impulses depend so little on it that a bed of 20 layers which goes on with
  /// another step gets less than 1e-3 m g d of kinetic energy per sphere.
  static constexpr double overlaps_at_rest_from = 6.0;

  bool shakes_beds() const {
    const auto depends = [this](const MethodAndStep &run) {
      return run.method == &PredictedImpulse::method && !reaches(shortest_ / run.dt, overlaps_at_rest_from);
    };
    const MethodAndStep now{method_, dt_};
    return before_.method && has_particles() && !(before_ == now) && !crowds_soften(before_, now) &&
           (depends(before_) || depends(now));
  }

  /// What grains are put to, and the row that allows it the smallest step.
  struct Use {
    const char *name;
    double RightFrom::*from;
    double largest_step = std::numeric_limits<double>::infinity(); ///< [s]
    double shortest = 0.0;                                         ///< contact time of that row [s]
    double nt = 0.0;                                               ///< of that row

    void add(double tc, const RightFrom &measured) {
      const double right_from = measured.*from;
      if (right_from == RightFrom::unmeasured || tc / right_from >= largest_step) return;
      largest_step = tc / right_from;
      shortest = tc;
      nt = right_from;
    }
    bool measured() const { return std::isfinite(largest_step); }
    bool exceeded(double dt) const { return measured() && !reaches(shortest / dt, nt); }
  };

  /// Whether impacts that meet keep their energy under impulses, and the row that allows it the smallest step.
  struct Energy {
    double largest_step = std::numeric_limits<double>::infinity(); ///< [s]
    double shortest = 0.0;                                         ///< contact time of that row [s]
    double restitution = 0.0;                                      ///< of that row

    void add(const ContactTimes &times) {
      const double step = times.shortest / PredictedImpulse::keeps_energy_from(times.largest_restitution);
      if (step >= largest_step) return;
      largest_step = step;
      shortest = times.shortest;
      restitution = times.largest_restitution;
    }
    double nt() const { return PredictedImpulse::keeps_energy_from(restitution); }
    bool gained(double dt) const { return std::isfinite(largest_step) && !reaches(shortest / dt, nt()); }
    std::string text(double dt) const {
      const std::string where = std::isinf(nt()) ? "at any nt" : format("below nt = %.3g", nt());
      return "a blow on spheres that touch may gain energy " + where +
             format(" with a restitution of %.3g; found nt = %.4g", restitution, shortest / dt);
    }
  };

  /// With the pair style's choice behind it where it says "auto", and onset where that is not as by default.
  std::string name() const {
    const std::string onset = begins_inside_ == method_->onset ? "" : begins_inside_ ? " onset on" : " onset off";
    return (auto_ ? std::string(AutoMethod::name) + " (" + method_->name + ")" : method_->name) + onset;
  }

  std::string advice(const Use &use) const {
    return format("%s right up to dt = %.4g, nt = %g", use.name, use.largest_step, use.nt) +
           (nonlinear_ ? ", as measured with linear contacts" : "");
  }

  [[gnu::format(printf, 1, 2)]] static std::string format(const char *pattern, ...) {
    char line[256];
    va_list values;
    va_start(values, pattern);
    std::vsnprintf(line, sizeof line, pattern, values);
    va_end(values);
    return line;
  }
  static std::string about(double limit) {
    return std::isinf(limit) ? "no stability limit on one contact"
                             : format("one contact is stable for nt > %.4g", 1.0 / limit);
  }

  const Method *method_;
  LawKind law_;
  bool begins_inside_;
  double limit_;
  double dt_;
  double impact_speed_;
  const AutoMethod *auto_ = nullptr;
  MethodAndStep before_;
  const InstructionSet *instructions_ = nullptr;
  std::string left_to_host_;
  std::array<Use, 3> uses_{Use{"dense beds at rest come out", &RightFrom::beds}, Use{"flows are", &RightFrom::flows},
                           Use{"agitated grains are", &RightFrom::agitated}};
  Energy energy_;
  double shortest_ = std::numeric_limits<double>::infinity();      ///< [s]
  double rayleigh_time_ = std::numeric_limits<double>::infinity(); ///< [s]
  bool nonlinear_ = false;
  bool too_large_ = false;
  std::string rows_;
  std::vector<std::string> facts_; ///< a JSON object for each row
};

} // namespace cfpm
