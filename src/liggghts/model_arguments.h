// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "../core/predictor.h"

#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace cfpm::liggghts {

/// The model part of a gran/cfpm command, checked, and rewritten so that the host's own parser
/// selects the contact models of this plugin: "predict X" is taken out and the normal model gets
/// its registered name.
class ModelArguments {
public:
  /// arg[first] is where "model" stands. Stops the run with a message on anything it does not know.
  ModelArguments(LAMMPS_NS::LAMMPS *lmp, const std::string &command, int narg, char **arg, int first);

  int count() const { return static_cast<int>(arguments_.size()); }
  /// A host parser may consume what it is given and look one argument too far: both are harmless here.
  char **values() { return pointers_.data(); }

  /// The choice made with "predict X": empty if none was made, nullptr inside for "predict none".
  std::optional<const Predictor *> prediction() const { return prediction_; }
  /// A setting that is switched on and has no meaning for a predicted force, or "".
  const std::string &setting_without_prediction() const { return setting_without_prediction_; }

private:
  std::vector<std::string> arguments_;
  std::vector<char *> pointers_;
  std::optional<const Predictor *> prediction_;
  std::string setting_without_prediction_;
};

} // namespace cfpm::liggghts
