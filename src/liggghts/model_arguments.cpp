// SPDX-License-Identifier: GPL-2.0-or-later
#include "model_arguments.h"

#include "contact_styles.h"
#include "host.h"

#include <algorithm>
#include <array>

namespace cfpm::liggghts {

namespace {

/// Settings of the host's models that act on the force at one instant (energy accounts, heat, bonds)
/// or make the law depend on the impact speed.
constexpr std::array settings_without_prediction{"viscous",
                                                 "heating_normal_hooke",
                                                 "heating_tangential_history",
                                                 "heating_tracking",
                                                 "computeElasticPotential",
                                                 "computeDissipatedEnergy",
                                                 "disableNormalWhenBonded",
                                                 "disableTangentialWhenBonded"};

std::string quoted(const std::string &s) { return "'" + s + "'"; }

std::string joined(const std::vector<std::string> &names) {
  std::string list;
  for (const std::string &name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

} // namespace

ModelArguments::ModelArguments(LAMMPS_NS::LAMMPS *lmp, const std::string &command, int narg, char **arg, int first)
    : arguments_(arg, arg + narg) {
  const auto fail = [&](const std::string &what) { lmp->error->all(FLERR, (command + ": " + what).c_str()); };
  const auto begin = arguments_.begin() + std::min(first, narg);

  const auto predict = std::find(begin, arguments_.end(), "predict");
  if (predict != arguments_.end()) {
    const std::string expected = "; expected one of " + predictor_names() + ", none";
    if (predict + 1 == arguments_.end()) fail("missing value after 'predict'" + expected);
    const Predictor *predictor = find_predictor(predict[1]);
    if (!predictor && predict[1] != "none") fail("unknown predictor " + quoted(predict[1]) + expected);
    prediction_ = predictor;
    if (std::find(predict + 1, arguments_.end(), "predict") != arguments_.end()) fail("'predict' given twice");
    arguments_.erase(predict, predict + 2);
  }

  // the host reads these keywords in this order, each of them optional but the first
  struct Keyword {
    const char *name;
    std::vector<std::string> choices;
  };
  const std::array keywords{Keyword{"model", normal_model_names()}, Keyword{"tangential", tangential_model_names()},
                            Keyword{"cohesion", cohesion_model_names()},
                            Keyword{"rolling_friction", rolling_model_names()}, Keyword{"surface", {"default"}}};
  auto at = arguments_.begin() + std::min<std::ptrdiff_t>(first, count());
  if (at == arguments_.end() || *at != "model")
    fail("expected 'model " + joined(keywords[0].choices) + "' first" +
         (at == arguments_.end() ? std::string() : ", found " + quoted(*at)));
  for (const Keyword &keyword : keywords) {
    if (at == arguments_.end() || *at != keyword.name) continue;
    const std::string expected = "; expected one of " + joined(keyword.choices);
    if (at + 1 == arguments_.end()) fail("missing value after " + quoted(*at) + expected);
    if (std::find(keyword.choices.begin(), keyword.choices.end(), at[1]) == keyword.choices.end())
      fail("unknown " + *at + " " + quoted(at[1]) + expected);
    if (keyword.name == keywords[0].name) at[1] = registered_name(at[1]);
    at += 2;
  }
  for (; at != arguments_.end(); ++at) {
    for (const Keyword &keyword : keywords)
      if (*at == keyword.name)
        fail("keyword " + quoted(*at) +
             " out of place; the order is model, tangential, cohesion, rolling_friction, "
             "surface, then the settings");
    const bool unpredictable = std::find(settings_without_prediction.begin(), settings_without_prediction.end(), *at) !=
                               settings_without_prediction.end();
    if (unpredictable && at + 1 != arguments_.end() && at[1] == "on") setting_without_prediction_ = *at;
  }

  for (std::string &argument : arguments_) pointers_.push_back(argument.data());
  static char nothing[] = "";
  pointers_.resize(pointers_.size() + 4, nothing);
}

} // namespace cfpm::liggghts
