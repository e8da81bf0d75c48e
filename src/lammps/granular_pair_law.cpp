// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_pair_law.h"

#include "granular_contacts.h"
#include "host_versions.h"
#include "instant_forces.h"

#include "core/contact/wider_history.h"
#include "core/deck/finite_number.h"

#include <algorithm>
#include <cmath>

namespace cfpm::lammps {

namespace {

constexpr const char *predictors = "exact|trapezoid|rk2|rk4|impulse|verlet";

const char *description(LawKind kind) {
  switch (kind) {
  case LawKind::linear:
    return "linear";
  case LawKind::self_similar:
    return "as in Tsuji's law";
  case LawKind::viscoelastic:
    return "viscoelastic";
  default:
    return "none of these";
  }
}

/// Of the laws of all pairs of types, if it is one.
LawKind common_kind(const GranularPairs &all) {
  if (all.empty()) return LawKind::any;
  const LawKind first = kind_of(all.begin()->second);
  const bool one = std::all_of(all.begin(), all.end(), [&](const auto &p) { return kind_of(p.second) == first; });
  return one ? first : LawKind::any;
}

/// What stands in the way of a method that wants one kind of law for all pairs of types, as text up to what else is
/// expected.
std::string kinds_of(const GranularPairs &all, const Method &method) {
  const auto name = [](const auto &pair) {
    return std::to_string(pair.first.first) + " and " + std::to_string(pair.first.second) + " are " +
           description(kind_of(pair.second));
  };
  const auto other = std::find_if(
      all.begin(), all.end(), [&](const auto &pair) { return kind_of(pair.second) != kind_of(all.begin()->second); });
  std::string text = ": types " + name(*all.begin());
  if (other != all.end()) text += ", types " + name(*other);
  text += "; expected for all types hooke with another damping than viscoelastic and without mindlin, or ";
  if (method.predicts(LawKind::self_similar))
    text += "for all hertz or hertz/material with tsuji or coeff_restitution and mindlin, or ";
  if (method.predicts(LawKind::viscoelastic)) text += "for all these with viscoelastic and mindlin, or ";
  return text;
}

} // namespace

WithoutForm without_form(const GranularCoefficients &c, const Method &method) {
  if (method.wants_crowd && c.resists_turns()) return {c.resistance(), "exact, trapezoid, rk2, rk4"};
  if (method.most_general == LawKind::any || !(c.follows_area() || c.adheres)) return {};
  if (c.adheres) return {"dmt", names_of_granular_methods(LawKind::any)};
  const char *const spring = !c.keeps_force ? "mindlin_rescale"
                             : c.rescales   ? "mindlin_rescale/force"
                                            : "mindlin/force";
  return {std::string("tangential ") + spring, names_of_granular_methods(LawKind::any)};
}

MethodArguments take_granular_method(LAMMPS_NS::LAMMPS &lmp, const std::string &command, ContactOwner owner,
                                     std::vector<std::string> &words) {
  KeywordOptions options(words, 0, [&](const std::string &what) { lmp.error->all(FLERR, command + ": " + what); });
  // any name is known here, as the sub-models are not yet; "-suffix cfpm" makes the same name of granular
  MethodArguments taken = take_method_arguments(options, owner, LawKind::linear, "", Command::suffixed);
  if (taken.automatic) taken.method = &AutoMethod::at_few_steps(LawKind::any);
  if (!taken.method->predicted && (taken.options.onset || taken.options.split != 0.0))
    options.fail("'onset' and 'split' go with predicted contacts, not with 'predict verlet'");
  return taken;
}

MethodArguments GranularPairLaw::read(LAMMPS_NS::LAMMPS &lmp, const std::vector<std::string> &words, Command) {
  cutoff_ = words;
  const MethodArguments taken = take_granular_method(lmp, command(), ContactOwner::pairs, cutoff_);
  if (cutoff_.size() > 1 || (cutoff_.size() == 1 && !finite_number(cutoff_[0])))
    lmp.error->all(FLERR, std::string(command()) + ": unknown argument '" + cutoff_.back() +
                              "'; expected [cutoff] [predict " + predictors +
                              "|auto] [split c] [onset on|off], and sub-models in pair_coeff");
  return taken;
}

int GranularPairLaw::history_size(const Method &method) const {
  return keeps_more(method) ? WiderHistory::size : PairLaw::history_size(method);
}

/// The host of 2021 has a place for the area before for each type, one for the twist and three for rolling; later ones
/// have one and three.
int GranularPairLaw::host_history_size(const Method &method, int types) const {
  if (!keeps_more(method)) return history_size(method);
  return granular_order == GranularOrder::of_2021 ? 3 + types + 3 + 1 : 3 + 1 + 3 + 3;
}

bool GranularPairLaw::enlarges_history(const std::vector<std::string> &coefficients) const {
  return !read_granular_coefficients(coefficients, 2).unpredicted.empty();
}

void GranularPairLaw::take_coefficients(const std::vector<std::string> &words, const TypePairs &pairs) {
  const GranularCoefficients read = read_granular_coefficients(words, 2);
  for (const auto &pair : pairs) coefficients_[pair] = read;
  given_.push_back(read);
}

void GranularPairLaw::find_reason_for_host_style(int types) {
  left_to_host_.clear();
  const auto in_force = [this](const auto &has) {
    return std::any_of(coefficients_.begin(), coefficients_.end(), [&](const auto &pair) { return has(pair.second); });
  };
  const auto no_longer = [&](const auto &has) {
    return std::any_of(given_.begin(), given_.end(), has) && !in_force(has);
  };
  const auto unknown = std::find_if(given_.begin(), given_.end(), [](const auto &c) { return !c.unknown.empty(); });
  const auto springs = [](const GranularCoefficients &c) { return c.has_spring; };
  const auto turns = [](const GranularCoefficients &c) { return c.resists_turns(); };
  if (!knows_granular_order)
    left_to_host_ = "its order of operations is known of LAMMPS 29 Sep 2021, 4 Feb 2025 and 4 Jul 2026 alone";
  else if (unknown != given_.end())
    left_to_host_ = "'" + unknown->unknown + "' is computed there alone";
  else if (no_longer(springs) || no_longer([](const GranularCoefficients &c) { return c.rolls; }) ||
           no_longer([](const GranularCoefficients &c) { return c.resists_twisting(); }) ||
           no_longer([](const GranularCoefficients &c) { return c.rescales; }))
    left_to_host_ = "a pair_coeff that is in force no longer asked for a larger history";
  else if (in_force(turns) && !in_force(springs))
    left_to_host_ = "rolling or twisting without a tangential spring is computed there alone";
  else if (coefficients_.size() < static_cast<std::size_t>(types) * static_cast<std::size_t>(types + 1) / 2)
    left_to_host_ = "it mixes types without a pair_coeff of their own";
}

std::string GranularPairLaw::complete(int types, const Method &method) {
  if (std::any_of(given_.begin(), given_.end(), [](const auto &c) { return c.unknown == "mdr"; }))
    return "'mdr' has a fix of the host that looks for the host's own pair_style granular; expected another normal "
           "model, or 'suffix off' in front of the styles";
  find_reason_for_host_style(types);
  if (left_to_host_.empty()) instant_ = {granular_history(coefficients_), instant_loop(coefficients_)};
  *complete_ = coefficients_;
  for (int i = 1; i <= types; ++i)
    for (int j = i + 1; j <= types; ++j) {
      const auto of_i = coefficients_.find({i, i});
      const auto of_j = coefficients_.find({j, j});
      if (!coefficients_.count({i, j}) && of_i != coefficients_.end() && of_j != coefficients_.end())
        (*complete_)[{i, j}] = mixed(of_i->second, of_j->second);
    }
  damped_friction_ = false;
  std::string unpredicted;
  for (const auto &[pair, c] : *complete_) {
    damped_friction_ = damped_friction_ || c.tangential_damping > 0.0;
    if (unpredicted.empty() && !c.unpredicted.empty())
      unpredicted = "'" + c.unpredicted + "' of types " + std::to_string(pair.first) + " and " +
                    std::to_string(pair.second) + " has no predicted form; expected ";
  }
  kind_ = common_kind(*complete_);
  if (!method.predicted) return "";
  if (!unpredicted.empty()) return unpredicted + "'predict verlet', or " + predicted_sub_models;
  for (const auto &[pair, c] : *complete_) {
    const WithoutForm without = without_form(c, method);
    if (!without.sub_model.empty())
      return "'" + without.sub_model + "' of types " + std::to_string(pair.first) + " and " +
             std::to_string(pair.second) + " has no form with 'predict " + method.name + "'; expected one of " +
             without.methods + ", verlet, auto";
  }
  if (predicts_granular(method, kind_)) return "";
  return std::string("predictor '") + method.name + "' has no form for these sub-models" +
         kinds_of(*complete_, method) + "one of " + method_names(LawKind::any) + ", auto";
}

/// A spring of stiffness 0 in place of none, so that there is a history; rolling and twisting friction without a force,
/// and a spring that keeps the area before, where it has to hold more than one spring, on every host as much for all
/// types.
std::vector<std::string> GranularPairLaw::for_host_style(const std::vector<std::string> &coefficients,
                                                         const Method &method) const {
  std::vector<std::string> words = coefficients;
  if (!method.predicted) return words;
  const auto found = std::find(words.begin(), words.end(), "linear_nohistory");
  if (found != words.end()) {
    *found = "linear_history";
    words.insert(found + 1, "0");
  }
  const bool more = keeps_more(method);
  if (more)
    for (std::size_t k = 1; k < words.size(); ++k)
      if (words[k - 1] == "tangential") words[k] = "mindlin_rescale";
  if (more || method.spring_values > Verlet::method.spring_values)
    words.insert(words.end(), {"rolling", "sds", "0", "0", "0"});
  if (more) words.insert(words.end(), {"twisting", "sds", "0", "0", "0"});
  return words;
}

std::string GranularPairLaw::reason_against_energy(const Method &method) const {
  return cfpm::lammps::reason_against_energy(*complete_, method);
}

std::vector<Collision> GranularPairLaw::collisions(const ContactPartners &partners, double impact_speed) const {
  std::vector<Collision> found;
  for (const auto &[pair, coefficients] : *complete_)
    if (coefficients.unpredicted.empty()) found.push_back(collision(coefficients, partners, impact_speed));
  return found;
}

std::unique_ptr<PredictedContacts> GranularPairLaw::predicted_contacts(const Method &method) const {
  return make_granular_contacts(method, kind_, complete_);
}

void GranularPairLaw::add_instant_forces(const Particles &particles, const PairList &pairs, double dt,
                                         const Tally &tally) const {
  cfpm::lammps::add_instant_forces(*complete_, instant_.loop, particles, pairs, dt, tally);
}

} // namespace cfpm::lammps
