// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact_model_interface.h"
#include "host_contact_models.h"
#include "model_arguments.h"

#include "core/step/wall_contact.h"

#include <string>
#include <vector>

namespace cfpm::liggghts {

/// fix wall/gran/cfpm: the host's primitive and mesh walls around this plugin's contact models.
/// The arguments are a base so that they are rewritten before the host's constructor parses them.
class FixWallGranCfpm : private ModelArguments, public LAMMPS_NS::FixWallGran, public ContactModelOwner {
public:
  FixWallGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg);

  void init() override;
  void post_force(int vflag) override;

  /// Without "predict" in its own command a wall follows the pair style, see method_at_wall().
  const Method &method() const override;
  bool onset() const override;
  void connect(ContactModelInterface &model) override { contact_model_ = &model; }
  StepState &step() override;
  const char *command() const override { return "fix wall/gran/cfpm"; }

  /// See PairGranCfpm.
  std::string reason_against_energy() const;
  ContactModelInterface &contact_model() const { return *contact_model_; }
  /// Of the meshes that move, near the particles of this rank [m/s].
  double largest_mesh_speed() const;

private:
  bool forces_are_read() const;

  std::vector<WallContact> contacts_; ///< of this evaluation, as far as they are computed together
  ContactModelInterface *contact_model_ = nullptr;
};

} // namespace cfpm::liggghts
