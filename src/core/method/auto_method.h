// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/method/method.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace cfpm {

/// "predict auto": of the methods that were measured to be right at the step of a run, whatever the deck is for, the
/// cheapest. That is the host's own step at many steps per contact and impulses at few; never one of the paper's
/// predictors, with which, without onset, agitated matter needs more steps than with the host's own. A law whose beds
/// were not measured with impulses has the host's step at any.
class AutoMethod {
public:
  static constexpr const char *name = "auto"; ///< as written in a deck after the keyword "predict"

  /// damped_friction: see right_from()
  AutoMethod(LawKind law, bool damped_friction)
      : law_(law), damped_friction_(damped_friction), method_(&at_few_steps(law)) {}

  /// Impulses, if the law has them and beds of it were measured with them.
  static const Method &at_few_steps(LawKind law) {
    return law <= LawKind::self_similar ? PredictedImpulse::method : Verlet::method;
  }

  /// Before anything is known of the particles the one that is right at most steps, and needs most history.
  const Method &method() const { return *method_; }

  /// Before each run of a step dt [s]. shortest: of the contact times [s], infinite without particles. A choice stays
  /// while the step is the same and it is right: with another method friction begins anew.
  void choose(double shortest, double dt) {
    const bool verlet_is_right = std::isfinite(shortest) && reaches(shortest / dt, verlet_from());
    if (dt == dt_ && (method_->predicted || verlet_is_right)) return;
    dt_ = dt;
    method_ = verlet_is_right ? &Verlet::method : &at_few_steps(law_);
  }

  /// Why it was chosen, and where the choice changes. shortest: as in choose().
  std::string reason(double shortest) const {
    const std::string verlet = std::string(Verlet::method.name) + ", the host's own step, is ";
    const std::string from = "nt = " + number("%g", verlet_from());
    if (!at_few_steps(law_).predicted)
      return verlet + "all that was measured for this law; right for any use from " + from + " on";
    const std::string where = std::isfinite(shortest)
                                  ? "up to dt = " + number("%.4g", shortest / verlet_from()) + ", " + from
                                  : "from " + from + " on, looked at when a run begins with particles";
    return verlet + "right for any use and cheapest " + where + "; " + at_few_steps(law_).name + " at fewer steps";
  }

  /// What a restart file holds of the choice.
  std::vector<std::string> words() const { return {method_->name, number("%a", dt_)}; }
  /// From words(); anything else is no choice.
  void restore(const std::vector<std::string> &words) {
    const Method *method = words.size() == 2 ? find_method(words[0]) : nullptr;
    if (!method) return;
    method_ = method;
    dt_ = std::strtod(words[1].c_str(), nullptr);
  }

private:
  double verlet_from() const { return right_from(Verlet::method, damped_friction_, false).for_any(); }
  static std::string number(const char *pattern, double value) {
    char text[40];
    std::snprintf(text, sizeof text, pattern, value);
    return text;
  }

  LawKind law_;
  bool damped_friction_;
  const Method *method_;
  double dt_ = 0.0; ///< for which it was chosen, 0 before that [s]
};

} // namespace cfpm
