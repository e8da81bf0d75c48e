// SPDX-License-Identifier: GPL-2.0-or-later
#include "pair_gran_cfpm.h"

#include "companions.h"
#include "model_arguments.h"
#include "pair_loop.h"

#include <cstring>

namespace cfpm::liggghts {

namespace {
constexpr const char *style_name = "gran/cfpm";
constexpr int name_length = 16; // of a predictor in a restart file
} // namespace

void PairGranCfpm::settings(int narg, char **arg) {
  ModelArguments arguments(lmp, command(), narg, arg, 0);
  predictor_ = arguments.prediction().value_or(find_predictor("exact"));
  setting_without_prediction_ = arguments.setting_without_prediction();
  PairGranProxy::settings(arguments.count(), arguments.values());
}

void PairGranCfpm::init_style() {
  const auto fail = [this](const std::string &what) {
    error->all(FLERR, (std::string(command()) + ": " + what).c_str());
  };
  if (!atom->sphere_flag) fail("particles have no radius; expected 'atom_style sphere' (or granular)");
  if (history && force->newton_pair) fail("a contact model with history needs 'newton off' before the box is defined");
  if (predictor_ && !setting_without_prediction_.empty())
    fail("setting '" + setting_without_prediction_ + "' has no predicted form; switch it off or use 'predict none'");
  require_companions(*lmp, *this);
  // the host finds the owner of contact history by the exact name of its own style
  publish_style("gran");
  PairGranProxy::init_style();
}

void PairGranCfpm::init_list(int id, LAMMPS_NS::NeighList *list) {
  PairGranProxy::init_list(id, list);
  publish_style(style_name); // every fix is initialised by now; a restart file must name this style
}

void PairGranCfpm::publish_style(const char *name) {
  delete[] force->pair_style;
  force->pair_style = new char[std::strlen(name) + 1];
  std::strcpy(force->pair_style, name);
}

void PairGranCfpm::write_restart_settings(FILE *file) {
  PairGranProxy::write_restart_settings(file);
  char name[name_length] = {};
  std::strncpy(name, predictor_ ? predictor_->name : "none", name_length - 1);
  std::fwrite(name, 1, name_length, file);
}

void PairGranCfpm::read_restart_settings(FILE *file, int major, int minor) {
  PairGranProxy::read_restart_settings(file, major, minor);
  char name[name_length] = {};
  if (comm->me == 0 && std::fread(name, 1, name_length, file) != name_length)
    error->one(FLERR, "pair_style gran/cfpm: restart file ends before the name of the predictor");
  MPI_Bcast(name, name_length, MPI_CHAR, 0, world);
  predictor_ = find_predictor(name);
  if (!predictor_ && std::strcmp(name, "none") != 0)
    error->all(FLERR,
               (std::string("pair_style gran/cfpm: restart file names the unknown predictor '") + name + "'").c_str());
}

bool PairGranCfpm::host_loop_needed(int eflag, int vflag, int addflag) {
  return !predictor_ || !computeflag() || eflag || vflag || (addflag && cpl()) || law_source_->has_host_models() ||
         storeContactForces() || storeContactForcesStress() || storeSumDelta() || store_sum_normal_force() ||
         modify->n_fixes_style("relax_contacts") > 0 || modify->n_fixes_style("insert/stream/predefined") > 0;
}

void PairGranCfpm::compute_force(int eflag, int vflag, int addflag) {
  if (host_loop_needed(eflag, vflag, addflag)) {
    PairGranProxy::compute_force(eflag, vflag, addflag);
  } else {
    evflag = vflag_fdotr = 0;
    add_predicted_pair_forces(*this, *lmp);
  }
  if (computeflag()) predicted_step_ = update->dt;
}

} // namespace cfpm::liggghts
