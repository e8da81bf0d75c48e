// SPDX-License-Identifier: GPL-2.0-or-later
#include "fix_wall_gran_cfpm.h"

#include "companions.h"
#include "pair_gran_cfpm.h"
#include "wider_contact_distance.h"

#include "tri_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace cfpm::liggghts {

namespace {

/// The host's own constructor crashes while a fix of the same id is being replaced.
LAMMPS_NS::LAMMPS *require_new_id(LAMMPS_NS::LAMMPS *lmp, const char *id) {
  const LAMMPS_NS::Modify &modify = *lmp->modify;
  if (std::any_of(modify.fix, modify.fix + modify.nfix, [](const LAMMPS_NS::Fix *fix) { return !fix; }))
    lmp->error->all(FLERR, (std::string("fix wall/gran/cfpm (id ") + id +
                            "): there is a fix with this id; expected 'unfix " + id + "' first")
                               .c_str());
  return lmp;
}

} // namespace

FixWallGranCfpm::FixWallGranCfpm(LAMMPS_NS::LAMMPS *lmp, int narg, char **arg)
    : ModelArguments(lmp, std::string("fix wall/gran/cfpm (id ") + arg[0] + ")", narg, arg, 3, this),
      FixWallGran(require_new_id(lmp, arg[0]), ModelArguments::count(), ModelArguments::values()) {}

void FixWallGranCfpm::init() {
  require_cfpm_pair(*lmp, command());
  if (method().predicted && !setting_without_prediction().empty())
    error->fix_error(
        FLERR, this,
        ("setting '" + setting_without_prediction() + "' has no predicted form; switch it off or use 'predict none'")
            .c_str());
  FixWallGran::init();
}

void FixWallGranCfpm::post_force(int vflag) {
  const auto &pair = static_cast<const PairGranCfpm &>(*force->pair);
  const double of_particle = 0.5 * pair.step().ahead; // half of what two of them come together by
  const double of_meshes = of_particle > 0.0 && is_mesh_wall() ? update->dt * largest_mesh_speed() : 0.0;
  const WiderContactDistance wider(*neighbor, 1.0 + (of_particle + of_meshes) / pair.smallest_radius());
  EnergyBudget *const budget = step().budget.get();
  const Particles particles = particles_of(*atom, 0, false);
  if (budget) budget->before_contacts(particles, atom->nlocal);
  contacts_.clear();
  contact_model_->collect_wall_contacts(budget || forces_are_read() ? nullptr : &contacts_);
  FixWallGran::post_force(vflag);
  contact_model_->collect_wall_contacts(nullptr);
  if (!contacts_.empty()) contact_model_->add_wall_forces(contacts_);
  if (budget) budget->after_contacts(particles, atom->nlocal);
  contact_model_->all_evaluated();
}

std::string FixWallGranCfpm::reason_against_energy() const {
  if (!setting_without_prediction().empty())
    return "setting '" + setting_without_prediction() + "' is on; expected it off";
  return contact_model_->has_host_models() ? "cohesion or rolling friction, whose energy is not told; expected neither"
                                           : "";
}

/// Whether the host reads the force of each contact when it has found it. At meshes it does, and at the end of its loop
/// moves the springs that contacts keep.
bool FixWallGranCfpm::forces_are_read() const {
  return is_mesh_wall() || contact_model_->has_host_models() || heattransfer_flag() || store_force() ||
         store_force_contact() || store_force_contact_stress() || store_sum_normal_force();
}

const Method &FixWallGranCfpm::method() const {
  if (given_method()) return *given_method();
  const auto *pair = dynamic_cast<const PairGranCfpm *>(force->pair);
  return pair ? method_at_wall(pair->method(), law()) : Verlet::method;
}

bool FixWallGranCfpm::onset() const {
  const auto *pair = dynamic_cast<const PairGranCfpm *>(force->pair);
  return pair && pair->onset_of(method());
}

double FixWallGranCfpm::largest_mesh_speed() const {
  double squared = 0.0;
  for (int m = 0; m < n_meshes(); ++m) {
    LAMMPS_NS::TriMesh &mesh = *mesh_list()[m]->triMesh();
    auto *const velocities = mesh.prop().getElementProperty<LAMMPS_NS::MultiVectorContainer<double, 3, 3>>("v");
    if (!mesh.isMoving() || !velocities) continue; // one that stays may have a velocity too, as a conveyor belt
    for (int i = 0; i < mesh.sizeLocal() + mesh.sizeGhost(); ++i)
      for (int node = 0; node < 3; ++node) {
        const Vec3 velocity = vec3(velocities->begin()[i][node]);
        squared = std::max(squared, dot(velocity, velocity));
      }
  }
  return std::sqrt(squared);
}

StepState &FixWallGranCfpm::step() { return static_cast<PairGranCfpm *>(force->pair)->step(); }

} // namespace cfpm::liggghts
