// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../core/impulse_options.h"
#include "../core/keyword_options.h"
#include "../core/predictor.h"

#include <optional>
#include <string>
#include <vector>

class Settings;

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

/// The model part of a gran/cfpm command, checked, and rewritten so that the host's own parser
/// selects the contact models of this plugin: "predict X" is taken out and the normal model gets
/// its registered name.
class ModelArguments {
public:
  /// arg[first] is where "model" stands: 0 for a pair style, behind "ID group style" for a wall. Stops
  /// the run with a message on anything it does not know, but leaves the settings to check_settings().
  ModelArguments(LAMMPS_NS::LAMMPS *lmp, std::string command, int narg, char **arg, int first);
  ModelArguments(const ModelArguments &) = delete;
  ModelArguments &operator=(const ModelArguments &) = delete;
  ~ModelArguments();

  /// For the contact model, which is created while the host parses the arguments last constructed and
  /// knows which settings its parts have: stops the run on a setting that is not among them. At a wall,
  /// parsed_by_host is how many arguments the host's wall has taken before the settings begin.
  static void check_settings(::Settings &known, std::optional<int> parsed_by_host);

  /// For the contact model too, when it is made: whether it may come to give impulses.
  static bool impulses_wanted();

  int count() const { return static_cast<int>(arguments_.size()); }
  /// A host parser may consume what it is given and look one argument too far: both are harmless here.
  char **values() { return pointers_.data(); }

  /// The choice made with "predict X": empty if none was made, nullptr inside for "predict none".
  std::optional<const Predictor *> prediction() const { return prediction_; }
  /// Given with "split c" and "onset on|off", by a pair style only.
  const ImpulseOptions &impulse_options() const { return impulse_options_; }
  /// Of the normal model.
  LawKind law() const { return law_; }
  /// A setting that is switched on and has no meaning for a predicted force, or "".
  const std::string &setting_without_prediction() const { return setting_without_prediction_; }

private:
  using Iterator = std::vector<std::string>::iterator;

  [[noreturn]] void fail(const std::string &what) const;
  void read_predict(KeywordOptions &words);
  Iterator read_models(Iterator first);
  void check_prediction(const std::string &normal_model) const;
  void check_primitive_wall() const;
  void require_finite(const std::string &name, const std::string &word) const;
  bool surely_predicted() const;

  LAMMPS_NS::LAMMPS &lmp_;
  std::string command_;
  bool is_wall_;
  std::vector<std::string> arguments_;
  std::vector<std::string>::const_iterator tail_; ///< behind the models: the keywords of a wall, the settings
  std::vector<char *> pointers_;
  std::optional<const Predictor *> prediction_;
  ImpulseOptions impulse_options_;
  LawKind law_ = LawKind::linear;
  std::string setting_without_prediction_;
};

} // namespace cfpm::liggghts
