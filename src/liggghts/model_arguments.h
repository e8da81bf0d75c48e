// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "core/deck/keyword_options.h"
#include "core/deck/method_choice.h"
#include "core/deck/method_options.h"
#include "core/method/method.h"

#include <optional>
#include <string>
#include <vector>

class Settings;

namespace LAMMPS_NS {
class FixWallGran;
class LAMMPS;
} // namespace LAMMPS_NS

namespace LIGGGHTS {
class IContactHistorySetup;
}

namespace cfpm::liggghts {

/// The model part of a gran/cfpm command, checked, and rewritten so that the host's own parser
/// selects the contact models of this plugin: "predict X" is taken out and the normal model gets
/// its registered name.
class ModelArguments {
public:
  /// arg[first] is where "model" stands: 0 for a pair style, behind "ID group style" for a wall; wall: the part of it
  /// that is the host's, null for a pair style. Stops the run with a message on anything it does not know, but leaves
  /// the settings to check_settings().
  /// made: how the command of a pair style came about.
  ModelArguments(LAMMPS_NS::LAMMPS *lmp, std::string command, int narg, char **arg, int first,
                 const LAMMPS_NS::FixWallGran *wall, Command made = Command::named);
  ModelArguments(const ModelArguments &) = delete;
  ModelArguments &operator=(const ModelArguments &) = delete;
  ~ModelArguments();

  /// For a contact model, which the host makes while it parses the arguments and which is told no more than whom it is
  /// made for: those of its owner, or nullptr if that is a style of the host.
  static const ModelArguments *of(LIGGGHTS::IContactHistorySetup *owner);

  /// For the contact model too, which knows the settings of its parts: stops the run on a setting that is not among
  /// them. At a wall, parsed_by_host is how many arguments the host's wall has taken before the settings begin.
  void check_settings(::Settings &known, std::optional<int> parsed_by_host) const;

  /// Whether the contacts may come to be solved by a method with more history than the host's.
  bool may_want_crowd() const;

  int count() const { return static_cast<int>(arguments_.size()); }
  /// A host parser may consume what it is given and look one argument too far: both are harmless here.
  char **values() { return pointers_.data(); }

  /// Of a pair style, null for auto; of a wall the one chosen with "predict X", null if none was.
  const Method *given_method() const { return given_method_; }
  /// Given with "split c" and "onset on|off", by a pair style only.
  const MethodOptions &options() const { return options_; }
  /// Of the normal model.
  LawKind law() const { return law_; }
  /// A setting that is switched on and has no meaning for a predicted force, or "".
  const std::string &setting_without_prediction() const { return setting_without_prediction_; }

private:
  using Iterator = std::vector<std::string>::iterator;

  [[noreturn]] void fail(const std::string &what) const;
  std::string read_predict(KeywordOptions &words, Command made) const;
  Iterator read_models(Iterator first, std::string &normal_model);
  void check_primitive_wall() const;
  void require_finite(const std::string &name, const std::string &word) const;
  bool surely_predicted() const;

  LAMMPS_NS::LAMMPS &lmp_;
  std::string command_;
  const LAMMPS_NS::FixWallGran *wall_; ///< null for a pair style
  std::vector<std::string> arguments_;
  std::vector<std::string>::const_iterator tail_; ///< behind the models: the keywords of a wall, the settings
  std::vector<char *> pointers_;
  const Method *given_method_ = nullptr;
  MethodOptions options_;
  LawKind law_ = LawKind::linear;
  std::string setting_without_prediction_;
};

} // namespace cfpm::liggghts
