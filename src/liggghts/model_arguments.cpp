// SPDX-License-Identifier: GPL-2.0-or-later
#include "model_arguments.h"

#include "contact_styles.h"
#include "host_contact_models.h"
#include "pair_gran_cfpm.h"

#include "core/deck/finite_number.h"

#include "primitive_wall_definitions.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <sstream>
#include <utility>

namespace cfpm::liggghts {

namespace {

/// Settings of the host's models that act on the force at one instant (energy accounts, heat, bonds)
/// or make the law depend on the impact speed.
const std::vector<std::string> settings_without_prediction{"viscous",
                                                           "heating_normal_hooke",
                                                           "heating_normal_hertz",
                                                           "heating_tangential_history",
                                                           "heating_tracking",
                                                           "computeElasticPotential",
                                                           "computeDissipatedEnergy",
                                                           "disableNormalWhenBonded",
                                                           "disableTangentialWhenBonded"};

/// Of the walls there are. A wall's contact model is made while the wall itself is no more than the host's part of it.
std::map<const LAMMPS_NS::FixWallGran *, const ModelArguments *> &arguments_of_walls() {
  static std::map<const LAMMPS_NS::FixWallGran *, const ModelArguments *> all;
  return all;
}

std::string quoted(const std::string &s) { return "'" + s + "'"; }

std::string joined(const std::vector<std::string> &names) {
  std::string list;
  for (const std::string &name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

bool contains(const std::vector<std::string> &names, const std::string &name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The host's list of settings is private, but it prints it: one line " name = value" each.
std::vector<std::string> names_of(::Settings &settings) {
  char *text = nullptr;
  std::size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  settings.print_all(out);
  std::fclose(out);
  std::istringstream lines(text);
  std::free(text);
  std::vector<std::string> names;
  for (std::string name, equals, value; lines >> name >> equals >> value;) names.push_back(name);
  return names;
}

} // namespace

ModelArguments::ModelArguments(LAMMPS_NS::LAMMPS *lmp, std::string command, int narg, char **arg, int first,
                               const LAMMPS_NS::FixWallGran *wall, Command made)
    : lmp_(*lmp), command_(std::move(command)), wall_(wall), arguments_(arg, arg + narg) {
  first = std::min(first, narg);
  KeywordOptions words(arguments_, static_cast<std::size_t>(first), [this](const std::string &what) { fail(what); });
  const std::string predictor = read_predict(words, made);
  const Method *const named = find_method(predictor);
  options_ = take_method_options(words, wall_, named ? named->wants_crowd : predictor == AutoMethod::name,
                                 !named || named->predicted);
  std::string model; // as the deck calls it
  tail_ = read_models(arguments_.begin() + first, model);
  if (!wall_ || !predictor.empty()) given_method_ = method_of(predictor, !wall_, law_, "model " + quoted(model), words);
  check_primitive_wall();
  for (auto at = tail_; at != arguments_.end() && at + 1 != arguments_.end(); ++at)
    if (contains(settings_without_prediction, at[0]) && at[1] == "on") setting_without_prediction_ = at[0];
  if (!setting_without_prediction_.empty() && surely_predicted())
    fail("setting " + quoted(setting_without_prediction_) +
         " has no predicted form; switch it off or use 'predict none'");

  for (std::string &argument : arguments_) pointers_.push_back(argument.data());
  static char nothing[] = "";
  pointers_.resize(pointers_.size() + 4, nothing);
  if (wall_) arguments_of_walls()[wall_] = this;
}

ModelArguments::~ModelArguments() {
  if (wall_) arguments_of_walls().erase(wall_);
}

const ModelArguments *ModelArguments::of(LIGGGHTS::IContactHistorySetup *owner) {
  if (const auto *pair = dynamic_cast<const PairGranCfpm *>(owner)) return pair->arguments();
  const auto found = arguments_of_walls().find(dynamic_cast<const LAMMPS_NS::FixWallGran *>(owner));
  return found == arguments_of_walls().end() ? nullptr : found->second;
}

void ModelArguments::fail(const std::string &what) const {
  lmp_.error->all(FLERR, (command_ + ": " + what).c_str());
  std::abort(); // not reached: error->all ends the process
}

std::string ModelArguments::read_predict(KeywordOptions &words, Command made) const {
  const std::optional<std::string> name = words.take("predict", expected_names(!wall_));
  return wall_ ? name.value_or("") : chosen_name(name, made);
}

/// Gives the normal model its registered name; returns where the models end.
ModelArguments::Iterator ModelArguments::read_models(Iterator first, std::string &normal_model) {
  // the host reads these keywords in this order, each of them optional but the first
  struct Keyword {
    const char *name;
    std::vector<std::string> choices;
  };
  const std::array keywords{Keyword{"model", normal_model_names()}, Keyword{"tangential", tangential_model_names()},
                            Keyword{"cohesion", cohesion_model_names()},
                            Keyword{"rolling_friction", rolling_model_names()}, Keyword{"surface", {"default"}}};
  const auto end = arguments_.end();
  if (first == end || *first != "model")
    fail("expected 'model' first, with one of " + joined(keywords[0].choices) +
         (first == end ? std::string() : "; found " + quoted(*first)));
  auto at = first;
  for (const Keyword &keyword : keywords) {
    if (at == end || *at != keyword.name) continue;
    const std::string expected = "; expected one of " + joined(keyword.choices);
    if (at + 1 == end) fail("missing value after " + quoted(*at) + expected);
    if (!contains(keyword.choices, at[1])) fail("unknown " + *at + " " + quoted(at[1]) + expected);
    at += 2;
  }
  for (const Keyword &keyword : keywords)
    if (std::find(at, end, keyword.name) != end)
      fail("keyword " + quoted(keyword.name) +
           " out of place; the order is model, tangential, cohesion, rolling_friction, "
           "surface, then the settings");
  law_ = law_kind(first[1]);
  normal_model = std::exchange(first[1], registered_name(first[1]));
  return at;
}

/// The host's messages would not say which walls there are, nor which number is wrong.
void ModelArguments::check_primitive_wall() const {
  const auto primitive = std::find(tail_, arguments_.end(), "primitive");
  if (arguments_.end() - primitive < 4) return;
  const std::vector<std::string> shapes(std::begin(LAMMPS_NS::PRIMITIVE_WALL_DEFINITIONS::wallString),
                                        std::end(LAMMPS_NS::PRIMITIVE_WALL_DEFINITIONS::wallString));
  if (!contains(shapes, primitive[3]))
    fail("unknown primitive wall " + quoted(primitive[3]) + "; expected one of " + joined(shapes));

  const bool is_plane = primitive[3].find("plane") != std::string::npos;
  const std::vector<std::string> names =
      is_plane ? std::vector<std::string>{"position"} : std::vector<std::string>{"radius", "centre1", "centre2"};
  auto number = primitive + 4;
  for (auto name = names.begin(); name != names.end() && number != arguments_.end(); ++name, ++number)
    require_finite(*name + " of primitive wall " + quoted(primitive[3]), *number);
  const auto shear = std::find(primitive, arguments_.end(), "shear");
  if (arguments_.end() - shear > 2) require_finite("velocity of 'shear'", shear[2]);
}

/// The host would take a number too large for a double as infinity, and run without that wall.
void ModelArguments::require_finite(const std::string &name, const std::string &word) const {
  if (!finite_number(word)) fail(name + " is " + quoted(word) + "; expected a finite number");
}

/// A wall without "predict" follows the pair style, which may come later or choose for itself.
bool ModelArguments::surely_predicted() const {
  if (given_method_) return given_method_->predicted;
  if (!wall_) return false;
  const auto *pair = dynamic_cast<const PairGranCfpm *>(lmp_.force->pair);
  return pair && pair->arguments()->surely_predicted();
}

bool ModelArguments::may_want_crowd() const {
  if (given_method_) return given_method_->wants_crowd;
  if (!wall_) return AutoMethod::at_few_steps(law_).wants_crowd;
  // it follows the pair style, which may come later
  const auto *pair = dynamic_cast<const PairGranCfpm *>(lmp_.force->pair);
  return !pair || pair->arguments()->may_want_crowd();
}

void ModelArguments::check_settings(::Settings &known, std::optional<int> parsed_by_host) const {
  const std::vector<std::string> names = names_of(known);
  const auto end = arguments_.end();
  for (auto at = parsed_by_host ? arguments_.begin() + *parsed_by_host : tail_; at != end; at += 2) {
    if (!contains(names, *at))
      fail("unknown setting " + quoted(*at) + "; expected one of " + joined(names) + " with on or off" +
           (wall_ ? ", and settings last" : ""));
    if (at + 1 == end) fail("missing value after setting " + quoted(*at) + "; expected on or off");
    if (at[1] != "on" && at[1] != "off")
      fail("setting " + quoted(*at) + " is " + quoted(at[1]) + "; expected on or off");
  }
}

} // namespace cfpm::liggghts
